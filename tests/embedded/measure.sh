#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# measure.sh HEADER OPTIMISATION...: builds the functions of a generated header for the board, looks at what is in the object files,
# lets the board run them, and prints a row for each optimisation. 1: a gate failed, and is named. 2: bad input. 3: a tool is missing.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
source "$here/gates.sh"
header=$1
shift
require_tools
check_header "$header"
name=$(basename "$header" .hpp)
work=${BUILD:-build}/embedded/$name
mkdir -p "$work"

# The row of a system: templates with its header and namespace.
name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$header" | head -1)
mode=$(grep -q '^enum class Mode' "$header" && echo "$name_space::Mode, " || true)
for file in functions measure host; do
  sed "s|@HEADER@|$(realpath "$header")|; s|@NAME_SPACE@|$name_space|g; s|@MODE@|$mode|" "$here/$file.cpp.in" >"$work/$file.cpp"
done

${CXX:-c++} -std=c++17 -O0 -I"$here" -I"$here/../../runtime" -isystem /usr/include/eigen3 "$work/host.cpp" -o "$work/host" || exit 3
"$work/host" >"$work/table.hpp"

failed=0
for optimisation in "$@"; do
  row="$name -$optimisation"
  objects=()
  for function in rhs rhs_and_jacobian set_up; do
    object=$work/$function.$optimisation.o
    compile "-$optimisation" -DFUNCTION_"$function" -c "$work/functions.cpp" -o "$object" || { echo "$row: $function does not compile for the board" >&2; exit 1; }
    check_object "$row: $function" "$object" || failed=1
    objects+=("$object")
  done
  check_divisions "$row" "$header" "${objects[0]}" || failed=1
  elf=$work/measure.$optimisation.elf
  compile "-$optimisation" -I"$work" "$work/measure.cpp" "$here/board/startup.cpp" "${objects[@]}" "${link[@]}" -o "$elf" || { echo "$row: does not link" >&2; exit 1; }
  check_linked "$row" "$elf" || failed=1
  run_board "$elf" >"$work/answer.$optimisation.txt" || { echo "$row: the board stopped: $(tail -1 "$work/answer.$optimisation.txt")" >&2; exit 1; }
  read -r degrees rhs jacobian stack stack_jacobian error limit error_jacobian pivots < <("$work/host" "$work/answer.$optimisation.txt" "$row" || echo) || true
  [ -n "$pivots" ] || { failed=1; continue; }
  check_pivots "$row" "$header" "$pivots" || failed=1
  # The same with functions of the library that only return: what is left is the generated code, whatever the angles are.
  mapfile -t stand_ins < <(arm-none-eabi-nm -u "${objects[@]}" | awk '$1 == "U" && $2 !~ /^mem/ { print "-Wl,--defsym=" $2 "=library_function" }' | sort -u)
  compile "-$optimisation" -I"$work" "$work/measure.cpp" "$here/board/startup.cpp" "${objects[@]}" "${stand_ins[@]}" "${link[@]}" -o "$work/own.elf"
  run_board "$work/own.elf" >"$work/own.txt" || true
  own() { awk -v what="$1" '$1 == what { sum += $3; count++ } END { printf "%.1f", sum/count }' "$work/own.txt"; }
  printf '%s ' "$name" "$optimisation" "$degrees" "$rhs" "$jacobian" "$(own rhs)" "$(own jacobian)" "$(own_bytes "${objects[0]}")" "$(own_bytes "${objects[1]}")" \
    "$(own_bytes "${objects[2]}")" "$stack" "$stack_jacobian" "$error" "$limit" "$error_jacobian"
  echo
done
exit $failed
