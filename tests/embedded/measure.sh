#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# measure.sh HEADER OPTIMISATION...: builds the functions of a generated header for the board, looks at what is in the object files,
# lets the board run them, and prints a row for each optimisation. 1: a gate failed, and is named. 2: bad input. 3: a tool is missing.
# C_HEADER: the same plant as a C header, whose functions are measured in place of those of HEADER.
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
rm -f "$work/host"

# The row of a system: templates with its header and namespace.
name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$header" | head -1)
mode=$(grep -q '^enum class Mode' "$header" && echo "$name_space::Mode, " || true)
c_header=${C_HEADER:+$(realpath "$C_HEADER")}
[ -z "$mode" ] && c_mode= c_pass= || c_mode="${name}_mode mode, " c_pass="mode, "
fill() {
  sed "s|@C_HEADER@|$c_header|g; s|@HEADER@|$(realpath "$header")|; s|@NAME_SPACE@|$name_space|g; s|@MODE@|$mode|; s|@PREFIX@|$name|g; s|@C_MODE@|$c_mode|g; s|@C_PASS@|$c_pass|g" "$here/$1" >"$work/$2"
}
fill host.cpp.in host.cpp
if [ -z "$c_header" ]; then
  fill functions.cpp.in functions.cpp
  fill measure.cpp.in measure.cpp
else
  fill functions.c.in functions.c
  fill measure_c.cpp.in measure.cpp
fi
build_function() {  # OPTIMISATION FUNCTION OBJECT
  if [ -z "$c_header" ]; then compile "-$1" -DFUNCTION_"$2" -c "$work/functions.cpp" -o "$3"
  else compile_c "-$1" -DFUNCTION_"$2" -c "$work/functions.c" -o "$3"; fi
}

# The table of points, and the judge of the answers: compiled when the first object files have passed.
prepare_host() {
  [ -x "$work/host" ] && return
  ${CXX:-c++} -std=c++17 -O0 -I"$here" -I"$here/../../runtime" -isystem /usr/include/eigen3 "$work/host.cpp" -o "$work/host" || exit 3
  "$work/host" >"$work/table.hpp"
}

# instructions FUNCTION FILE: mean over the points.
instructions() { awk -v what="$1" '$1 == what { sum += $3; count++ } END { printf "%.1f", sum/count }' "$2"; }

# measure OPTIMISATION: a row, or 1 and what failed.
measure() {
  local row="$name -$1" function object elf=$work/measure.$1.elf answer=$work/answer.$1.txt objects=() stand_ins degrees stack stack_jacobian error limit error_jacobian pivots
  for function in rhs rhs_and_jacobian set_up; do
    object=$work/$function.$1.o
    build_function "$1" "$function" "$object" || { echo "$row: $function does not compile for the board" >&2; return 1; }
    check_object "$row: $function" "$object" || return 1
    objects+=("$object")
  done
  check_divisions "$row" "$header" "${objects[0]}" || return 1

  prepare_host
  compile "-$1" -I"$work" -c "$work/measure.cpp" -o "$work/measure.o"
  compile "-$1" -c "$board/startup.cpp" -o "$work/startup.o"
  local program=("$work/measure.o" "$work/startup.o" "${objects[@]}" "${link[@]}")
  compile "${program[@]}" -o "$elf" || { echo "$row: does not link" >&2; return 1; }
  check_linked "$row" "$elf" || return 1
  run_board "$elf" >"$answer" || { echo "$row: the board stopped: $(tail -1 "$answer")" >&2; return 1; }
  "$work/host" "$answer" "$row" >"$work/judgement" || return 1
  read -r degrees stack stack_jacobian error limit error_jacobian pivots <"$work/judgement"
  check_pivots "$row" "$header" "$pivots" || return 1

  # The same with functions of the library that only return: what is left is the generated code, whatever the angles are.
  mapfile -t stand_ins < <(arm-none-eabi-nm -u "${objects[@]}" | awk '$1 == "U" && $2 !~ /^mem/ { print "-Wl,--defsym=" $2 "=library_function" }' | sort -u)
  compile "${program[@]}" "${stand_ins[@]}" -o "$work/own.elf"
  run_board "$work/own.elf" >"$work/own.txt" || { echo "$row: the board stopped without the library: $(tail -1 "$work/own.txt")" >&2; return 1; }

  echo "$name" "$1" "$degrees" "$(instructions rhs "$answer")" "$(instructions jacobian "$answer")" "$(instructions rhs "$work/own.txt")" "$(instructions jacobian "$work/own.txt")" \
    "$(own_bytes "${objects[0]}")" "$(own_bytes "${objects[1]}")" "$(own_bytes "${objects[2]}")" "$stack" "$stack_jacobian" "$error" "$limit" "$error_jacobian"
}

failed=0
for optimisation in "$@"; do measure "$optimisation" || failed=1; done
exit $failed
