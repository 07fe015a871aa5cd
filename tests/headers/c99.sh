#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# C headers: every scene of a machine of systems/ compiles without a warning as C99 and as C++, in double and in float, and computes the same as its C++ header.
# Needs the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/, or model files; all of systems/ if there are none.
# COMPILERS: of C, more than one in quotes. OPTIONS: of generate. What has series is compared with them.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wfloat-conversion -Werror)
# The same roundings on both sides, and nothing beyond an array.
checked=(-O1 -ffp-contract=off -fsanitize=address,undefined -fno-sanitize-recover=all)
failed() { echo "FAILED: $*"; exit 1; }
count=0
values=0

# compare C CPP: a C header with its C++ header.
compare() {
  local c=$1 cpp=$2 name real compiler has=() space letter compared
  name=$(basename "$c" .h)
  echo "#include \"$c\"" >"$here/all.c"
  for real in double float; do
    for compiler in ${COMPILERS:-gcc}; do
      "$compiler" -std=c99 -fsyntax-only "${warnings[@]}" -D"${name}_real=$real" "$here/all.c" || failed "$name.h in $real with $compiler"
    done
    "${CXX:-g++}" -x c++ -std=c++17 -fsyntax-only "${warnings[@]}" -D"${name}_real=$real" "$here/all.c" || failed "$name.h in $real as C++"
  done
  ! grep -q "^    ${name}_mode_count" "$c" || has+=(-DMODES)
  ! grep -q "^    ${name}_constraint_count" "$c" || has+=(-DCONSTRAINTS)
  ! grep -q "^    ${name}_constraint_rank" "$c" || has+=(-DCHOICE)
  ! grep -q "^    ${name}_series_rows" "$c" || has+=(-DSERIES)
  for letter in x u p; do
    ! grep -q " ${name}_jacobian_${letter}_column_starts(void)" "$c" || has+=("-DPATTERN_${letter^^}")
  done
  space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$cpp" | tail -1)
  "${CC:-gcc}" -std=c99 "${checked[@]}" -DHEADER="\"$c\"" -DNAME="$name" "${has[@]}" -c "$SOURCE/tests/headers/c_side.c" -o "$here/c.o" || failed "$name.h"
  "${CXX:-g++}" -std=c++17 "${checked[@]}" "${has[@]}" -DHEADER="\"$cpp\"" -DSPACE="$space" "$SOURCE/tests/headers/c_and_cpp.cpp" "$here/c.o" -o "$here/both" || failed "$name"
  compared=$("$here/both") || failed "$name: $compared"
  values=$((values + $(tail -1 <<<"$compared")))
  [ "$(wc -l <<<"$compared")" -eq 1 ] || echo "$name: $(head -1 <<<"$compared")"
  count=$((count + 1))
}

mapfile -t models < <(machines "$@")
for path in "${models[@]}"; do
  [ -f "$path" ] || failed "there is no model $path"
  read -r -a options <<<"${OPTIONS:-}"
  [ "$(basename "$path")" != n_pendulum.toml ] || options+=(--size N=3)
  generated=$SOURCE/generated/$(basename "$(dirname "$path")")
  rm -rf "$here/c" "$here/cpp"
  "$PROGRAM" generate "$path" --every-scene "${options[@]}" --language c -o "$here/c" >/dev/null
  if [ -n "${OPTIONS:-}" ] || [ ! -d "$generated" ] || [[ $path != "$SOURCE"/systems/* ]]; then
    generated=$here/cpp
    "$PROGRAM" generate "$path" --every-scene "${options[@]}" -o "$generated" >/dev/null
  fi
  for c in "$here"/c/*.h; do
    cpp=$generated/$(basename "$c" .h).hpp
    [ -f "$cpp" ] || failed "there is no C++ header beside $(basename "$c")"
    compare "$c" "$cpp"
  done
done
[ "$count" -gt 0 ] || failed "no C header found"
echo "$count C headers are clean, and equal to C++ in $values values"
