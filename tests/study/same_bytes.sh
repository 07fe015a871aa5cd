#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A study gives the same bytes whatever the number of threads and shards, and when it is killed and started again. Argument: how many
# kills.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
kills=$1
fail() { echo "$*"; exit 1; }
name=cart_pendulum_lab_study
arguments=(study "$SOURCE/systems/mechanics/cart_pendulum.toml" --vary "m_W=normal(1, 5 %), d_R=uniform(0.1, 1)" --vary "phi=0.1:0.5:2"
  --runs 600 --until 5 --observe "max(phi), s, end(tip)^2" --no-plot)
study() {
  local folder=$1
  shift
  "$PROGRAM" "${arguments[@]}" -o "$here/$folder" "$@"
}
study whole >"$here/whole.txt"
for jobs in 1 2 4; do
  study "jobs$jobs" --jobs $jobs >/dev/null
  cmp "$here/whole/$name.csv" "$here/jobs$jobs/$name.csv" || fail "$jobs threads give other bytes"
done
for shard in 1 2 3; do study shards --shard $shard/3 >/dev/null; done
SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=6 SLURM_ARRAY_TASK_COUNT=3 study slurm >/dev/null
cmp "$here/shards/${name}_2_of_3.csv" "$here/slurm/${name}_2_of_3.csv" || fail "the variables of SLURM give another shard"
"$PROGRAM" study --merge "$here"/shards/${name}_{3,1,2}_of_3.csv --no-plot -o "$here/merged" >/dev/null
cmp "$here/whole/$name.csv" "$here/merged/$name.csv" || fail "three shards give other bytes"
if "$PROGRAM" study --merge "$here"/shards/${name}_{1,2}_of_3.csv -o "$here/part" 2>"$here/error.txt"; then
  fail "two of three are a whole"
fi
grep -q "shard 3 of 3 is missing" "$here/error.txt" || fail "$(cat "$here/error.txt")"

# Killed at random moments, some of them in the middle of a line.
RANDOM=1
caught=0
for ((kill = 1; caught < kills && kill <= 20 * kills; ++kill)); do
  "$PROGRAM" "${arguments[@]}" --jobs 1 -o "$here/killed" >/dev/null 2>&1 &
  started=$!
  sleep "0.$((RANDOM % 25 + 5))"
  if kill -9 $started 2>/dev/null; then
    caught=$((caught + 1))
  fi
  wait $started 2>/dev/null || true
  if [[ -s $here/killed/$name.csv && $((kill % 2)) == 0 ]]; then  # a torn line
    truncate -s -$((RANDOM % 40 + 1)) "$here/killed/$name.csv"
  fi
  if [[ $(wc -l <"$here/killed/$name.csv" 2>/dev/null || echo 0) -gt 590 ]]; then  # begin anew
    study killed >/dev/null
    cmp "$here/whole/$name.csv" "$here/killed/$name.csv" || fail "a killed study gives other bytes"
    rm "$here/killed/$name.csv"
  fi
done
[[ $caught == "$kills" ]] || fail "only $caught studies could be killed"
study killed >"$here/killed.txt"
cmp "$here/whole/$name.csv" "$here/killed/$name.csv" || fail "a killed study gives other bytes"
diff <(sed '1s/;.*//; /\.csv$/d' "$here/whole.txt") <(sed '1s/;.*//; /\.csv$/d' "$here/killed.txt") || fail "and other statistics"

# Another study does not write into the file, and a run that is made again has the values of its row.
if study killed --seed 2 2>"$here/error.txt"; then fail "another study is written into the file"; fi
grep -q "belongs to another study: its 'seed' is 1, not 2" "$here/error.txt" || fail "$(cat "$here/error.txt")"
study again --only 17 >/dev/null
last=$(tail -1 "$here/again/cart_pendulum_lab_run_17.csv" | cut -d, -f2)
row=$(grep '^17,' "$here/whole/$name.csv" | cut -d, -f8)
[[ $last == "$row" ]] || fail "run 17 ends with s = $last, but its row says $row"
echo "1, 2 and 4 threads, 3 shards and $caught kills give the same bytes"
