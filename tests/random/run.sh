#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Models of elements drawn at random, seeds FIRST to LAST. Of each: the derivation is proven; a run keeps the energy to 1e-8, or the
# program says in a sentence why not; at three points of the run rates and outputs are those that the symbolic derivation gives in 50
# digits, in each form of emission: as simulated, without passes, with loops or without, all at once, and in float.
set -uo pipefail
first=${1:-1} last=${2:-6}
folder=$(cd "$(dirname "$0")" && pwd)
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here" || exit 1
compiler=${CXX:-c++}
"$compiler" -std=c++20 -O1 "$folder/models.cpp" -o random_models || exit 3
failed=0 ran=0 refused=0

# points HEADER SCALAR FLAG...: a program that prints rates and outputs
points() {
  local header=$1 scalar=$2 name_space flags=()
  shift 2
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$header" | tail -1)
  ! grep -q 'mode_count = ' "$header" || flags+=(-DHAS_MODES)
  "$compiler" -std=c++17 -O0 -I. -DHEADER="\"$header\"" -DNAME_SPACE="$name_space" -DSCALAR="$scalar" "${flags[@]}" "$@" "$folder/points.cpp" -o "points_$scalar" || return 1
}

# compare FILE KINDS RELATIVE: printed values against those of `expected`; the scale of an output is its largest value in the run.
# What the last digits of the states change is allowed besides.
compare() {
  awk -v kinds="$2" -v relative="$3" '
    FILENAME == "scales" { scale[$1] = $2; next }
    FILENAME == "expected" { want[$1 " " $2] = $3; next }
    index(kinds, $1) {
      key = $1 " " $2
      if (!(key in want)) { print "no expected value: " key; bad = 1; next }
      e = want[key] + 0; d = $3 - e; if (d < 0) d = -d
      size = e < 0 ? -e : e; if ($1 == "output" && scale[$2] > size) size = scale[$2]
      if ($1 == "rate" && size < 1) size = 1
      seen++
      if ($3 !~ /^[-+0-9.e]+$/ || d > relative*size + $4) { print key ": " $3 ", expected " want[key]; bad = 1 }
    }
    END { if (!seen) { print "nothing compared"; bad = 1 } exit bad }' scales expected "$1"
}

# one SEED: prints what is wrong
one() {
  local seed=$1 name=random_$1 status=0
  ./random_models "$seed" >model.toml
  if ! timeout 300 "$PROGRAM" check model.toml >printed 2>&1; then
    grep -q 'error\[' printed && { refused=$((refused + 1)); echo "seed $seed, refused: $(grep -m1 'error\[' printed)"; return 0; }
    echo "check fails"; tail -30 printed; return 1
  fi
  timeout 600 "$PROGRAM" simulate model.toml --no-plot >printed 2>&1 || status=$?
  case $status in
    0) awk '/^note: near equal pressures/ { told = 1 } /energy error/ { seen = 1; bad = !($NF + 0 < 1e-8) } END { exit seen && !told ? bad : 0 }' printed || { echo "energy is lost, exit code 0"; cat printed; return 1; } ;;
    1) grep -q '^dalembert: warning' printed || { echo "exit code 1 without a warning"; cat printed; return 1; }; echo "seed $seed, warned: $(grep -m1 '^dalembert: warning' printed)" ;;
    2 | 4) grep -qE 'error\[|stopped|warning' printed || { echo "exit code $status without a sentence"; cat printed; return 1; }
           refused=$((refused + 1)); echo "seed $seed, exit code $status: $(grep -m1 -E 'error\[|stopped' printed)"; [ -s "${name}_full.csv" ] || return 0 ;;
    *) echo "exit code $status"; cat printed; return 1 ;;
  esac
  local header=${name}_full.hpp csv=${name}_full.csv
  ran=$((ran + 1))
  mkdir -p plain together
  "$PROGRAM" generate model.toml -o plain --without chain,constants,factoring,angles,reciprocals,loops >/dev/null 2>&1
  "$PROGRAM" generate model.toml -o together --together >together.txt 2>&1 || grep -q 'loops' together.txt || { cat together.txt; return 1; }
  local forms=("$header:double:") form
  forms+=("plain/$header:double:" "$header:float:")
  [ -s "together/$header" ] && forms+=("together/$header:double:-DTOGETHER")
  awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { sub(/ \[.*/, "", $i); name[i] = $i } next } { for (i = 1; i <= NF; i++) { v = $i < 0 ? -$i : $i; if (v > top[i]) top[i] = v } } END { for (i in name) print name[i], top[i] + 0 }' "$csv" >scales
  local rows row states inputs
  rows=$(($(wc -l <"$csv") - 1))
  for form in "${forms[@]}"; do
    IFS=: read -r file scalar flag <<<"$form"
    # shellcheck disable=SC2086  # no flag or one
    points "$file" "$scalar" $flag || { echo "$file does not compile"; return 1; }
    states=$("./points_$scalar" | sed -n 's/^state //p')
    inputs=$("./points_$scalar" | sed -n 's/^input //p')
    for row in $((rows / 4 + 1)) $((rows / 2 + 1)) $rows; do
      # Of cells in loops a CSV has the first and the last; those between are given their mean: any point will do.
      # shellcheck disable=SC2016
      values() { awk -F, -v wanted="$1" -v row="$row" 'NR == 1 { base = wanted; sub(/\[[0-9]+\]$/, "[", base); for (i = 1; i <= NF; i++) { sub(/ \[.*/, "", $i); at[$i] = i; if (index($i, base) == 1) { member[++members] = i } } next }
        NR == row + 1 { if (wanted in at) print $(at[wanted]); else printf "%.15g\n", ($(member[1]) + $(member[members]))/2 }' "$csv"; }
      local t mode=0 x=() u=() state=() input=() name_of
      # a CSV is in SI, numbers without a unit on the command line are not
      unit_of() { head -1 "$csv" | tr ',' '\n' | awk -v wanted="$1" '{ unit = $2; sub(/ \[.*/, "") } $0 == wanted { gsub(/[][]/, "", unit); print unit == "1" ? "" : " " unit }'; }
      t=$(values t)
      head -1 "$csv" | grep -q ',mode$' && mode=$(values mode)
      for name_of in $states; do x+=("$(values "$name_of")"); state+=("$name_of=${x[-1]}$(unit_of "$name_of")"); done
      for name_of in $inputs; do u+=("$(values "$name_of")"); input+=("$name_of=${u[-1]}$(unit_of "$name_of")"); done
      "./points_$scalar" "$mode" "$t" "${x[@]}" "${u[@]}" >got || { echo "$file: no values"; return 1; }
      local arguments=(--time "$t" --digits 50 --format json --state "$(IFS=,; echo "${state[*]}")")
      [ ${#input[@]} -eq 0 ] || arguments+=(--input "$(IFS=,; echo "${input[*]}")")
      ! grep -q '^mode ' got || arguments+=(--mode "$(sed -n 's/^mode //p' got)")
      # a run may leave declared ranges before it stops; there nothing is evaluated
      ./evaluated "${arguments[@]}" >evaluated.json 2>evaluated.txt || { grep -q value-out-of-range evaluated.txt && continue; echo "evaluate fails: $(grep -m1 error evaluated.txt)"; return 1; }
      awk -F'"' '/^  "state_derivative"/ { kind = "rate" } /^  "output"/ { kind = "output" } /^  }/ { kind = "" }
        kind && /^    / { print kind, ($2), ($4) }' evaluated.json >rates_and_outputs
      # the rates of a header stand in the order of its states; evaluate names them dot(...)
      awk '$1 == "rate" { $2 = $2 ~ /^ddot/ ? substr($2, 2) : substr($2, 5, length($2) - 5) } { print }' rates_and_outputs >expected
      if [ "$scalar" = float ]; then compare got "output" 2e-3 >wrong || { echo "$form, row $row:"; cat wrong; return 1; }
      else compare got "rate output" 1e-8 >wrong || { echo "$form, row $row:"; cat wrong; return 1; }; fi
    done
  done
}

for seed in $(seq "$first" "$last"); do
  rm -rf -- *.hpp *.csv plain together
  # rods are evaluated without loops, which are a form of emission only
  cat >evaluated <<EVALUATED
#!/usr/bin/env bash
sed 's/, loops = true//' model.toml >unrolled.toml
exec "$PROGRAM" evaluate unrolled.toml "\$@"
EVALUATED
  chmod +x evaluated
  if ! one "$seed"; then
    echo "FAILED: seed $seed"
    failed=$((failed + 1))
    [ -z "${KEEP:-}" ] || cp model.toml "$KEEP/random_$seed.toml"
  fi
done
echo "random models $first to $last: $ran ran, $refused refused with a sentence, $failed failed"
exit $((failed > 0))
