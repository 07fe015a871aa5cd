#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The C99 integrators of exports: no warning of any compiler, nothing that sanitizers or valgrind object to, and the same numbers each time.
# Needs the program (PROGRAM) and the sources (SOURCE). COMPILERS names compilers, gcc if it is not set; VALGRIND=1 asks valgrind, too.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
cp "$SOURCE/runtime/dalembert/plant.h" "$here/dalembert_plant.h"
warnings=(-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)
warnings+=(-I "$here" -I "$SOURCE/runtime/export" -I "$SOURCE/tests")
for header in dalembert_modes dalembert_run; do
  printf '#include "%s.h"\nint main(void) { return dalembert_status_text(dalembert_good)[0] == 0; }\n' $header >"$here/alone.c"
  for compiler in ${COMPILERS:-gcc}; do
    "$compiler" "${warnings[@]}" -O2 "$here/alone.c" -o "$here/alone" -lm || failed "$header.h with $compiler"
  done
done
plants=()
plant() { # model, scene, time
  "$PROGRAM" compile "$SOURCE/systems/$1.toml" ${2:+--scene "$2"} -o "$here" >/dev/null
  plants+=("$(ls "$here/$(basename "$1")"*"_${2:-full}.so")" "$3")
}
plant mechanics/bouncing_ball "" 30
plant mechanics/stick_slip exact 10
plant mechanics/four_bar "" 2
plant mechanics/heavy_top attitude 1
plant hydraulics/hydraulic_cylinder real 0.05
plant heat/heat_conduction plate 100
run_all() { # file of output, command
  local out=$1 i
  shift
  : >"$out"
  for ((i = 0; i < ${#plants[@]}; i += 2)); do
    [ -e "${plants[i]}" ] || failed "no plant ${plants[i]}"
    echo "${plants[i]##*/}" >>"$out"
    "$@" "${plants[i]}" "${plants[i + 1]}" >>"$out" || failed "$* ${plants[i]##*/} $?"
  done
}
sources=("$SOURCE/tests/export/run.c" "$SOURCE/tests/export/run_in_c.c")
for compiler in ${COMPILERS:-gcc}; do
  "$compiler" "${warnings[@]}" -Wno-pedantic -O2 -ffp-contract=off "${sources[@]}" -o "$here/run" -lm -ldl
  run_all "$here/$compiler.txt" "$here/run"
  cmp "$here/$compiler.txt" "$here/${first:=$compiler}.txt" || failed "$compiler gives other numbers"
  "$compiler" "${warnings[@]}" -Wno-pedantic -O1 -g -ffp-contract=off -fsanitize=address,undefined -fno-sanitize-recover=all \
    "${sources[@]}" -o "$here/checked" -lm -ldl
  run_all "$here/checked.txt" "$here/checked"
  cmp "$here/checked.txt" "$here/$first.txt" || failed "sanitized it gives other numbers"
done
cat "$here/$first.txt"
! grep -q 'wrong' "$here/$first.txt" || failed "dense output"
! grep -q 'status [^0]' "$here/$first.txt" || failed "a run stopped"
if [ -n "${VALGRIND:-}" ] && command -v valgrind >/dev/null; then
  gcc "${warnings[@]}" -Wno-pedantic -O1 -g "${sources[@]}" -o "$here/run" -lm -ldl
  plants=("${plants[@]:0:6}")
  run_all "$here/valgrind.txt" valgrind -q --error-exitcode=9 --leak-check=full "$here/run"
fi
echo "runs in C are clean"
