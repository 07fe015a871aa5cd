#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A study under mpirun gives the same bytes as without, also where a process is killed.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
fail() { echo "$*"; exit 1; }
name=cart_pendulum_lab_study
study=("$PROGRAM" study "$SOURCE/systems/mechanics/cart_pendulum.toml" --vary "m_W=normal(1, 5 %), phi=0.1:0.5:2" --runs 2000 --until 3
  --observe "max(phi), s" --no-plot)
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
ranks() { timeout 120 mpirun --oversubscribe "$@"; }
"${study[@]}" -o "$here/whole" >/dev/null
ranks -n 4 "${study[@]}" -o "$here/ranks" >/dev/null
cmp "$here/whole/$name.csv" "$here/ranks/$name.csv" || fail "4 processes give other bytes"

# A process of these, once there are rows.
kill_one() {
  for ((i = 0; i < 200; ++i)); do
    [[ ! -f $1/$name.csv || $(wc -l <"$1/$name.csv") -lt 50 ]] || break
    sleep 0.02
  done
  local victim
  victim=$(pgrep -f "^$PROGRAM study .* -o $1\$" | tail -1)
  kill -9 "$victim" 2>/dev/null || fail "no process was there to be killed"
}
ranks -n 4 "${study[@]}" -o "$here/killed" >/dev/null 2>&1 &
kill_one "$here/killed"
wait $! || true
ranks -n 4 "${study[@]}" -o "$here/killed" >/dev/null
cmp "$here/whole/$name.csv" "$here/killed/$name.csv" || fail "after a kill the bytes are others"
ranks --enable-recovery -n 4 "${study[@]}" -o "$here/taken" >/dev/null 2>&1 &
kill_one "$here/taken"
wait $! || true
cmp "$here/whole/$name.csv" "$here/taken/$name.csv" || fail "the runs of a lost process are not taken up"
if ranks -n 2 "${study[@]}" --vary "q=0:1:2" -o "$here/refused" >/dev/null 2>"$here/error.txt"; then fail "'q' is varied"; fi
told=$(grep -c "has no parameter, coordinate, velocity, state or input 'q'" "$here/error.txt" || true)
[[ $told == 1 ]] || fail "not told once: $(cat "$here/error.txt")"
echo "4 processes, and those that are left of them, give the same bytes"
