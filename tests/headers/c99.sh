#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# C headers: every scene of systems/ compiles without a warning as C99 and as C++, in double and in float, and computes the same as its C++ header.
# Needs the program (PROGRAM) and the sources (SOURCE). Arguments: models, by name; all if there are none. COMPILERS: of C, more than one in quotes.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wfloat-conversion -Werror)
failed() { echo "FAILED: $*"; exit 1; }
count=0
values=0
for model in "${@:-}"; do
  while read -r path; do
    folder=$(basename "$(dirname "$path")")
    sizes=()
    [ "$(basename "$path")" != n_pendulum.toml ] || sizes=(--size N=3)
    rm -rf "$here/headers"
    "$PROGRAM" generate "$path" --every-scene "${sizes[@]}" --language c -o "$here/headers" >/dev/null
    for c in "$here"/headers/*.h; do
      name=$(basename "$c" .h)
      cpp=$SOURCE/generated/$folder/$name.hpp
      [ -f "$cpp" ] || failed "there is no C++ header beside $name.h"
      echo "#include \"$c\"" >"$here/all.c"
      for real in double float; do
        for compiler in ${COMPILERS:-gcc}; do
          "$compiler" -std=c99 -fsyntax-only "${warnings[@]}" -D"${name}_real=$real" "$here/all.c" || failed "$name.h in $real with $compiler"
        done
        "${CXX:-g++}" -x c++ -std=c++17 -fsyntax-only "${warnings[@]}" -D"${name}_real=$real" "$here/all.c" || failed "$name.h in $real as C++"
      done
      has=()
      ! grep -q "^    ${name}_mode_count" "$c" || has+=(-DMODES)
      ! grep -q "^    ${name}_constraint_count" "$c" || has+=(-DCONSTRAINTS)
      ! grep -q "^    ${name}_constraint_rank" "$c" || has+=(-DCHOICE)
      space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$cpp" | tail -1)
      "${CC:-gcc}" -std=c99 -O1 -ffp-contract=off -DHEADER="\"$c\"" -DNAME="$name" "${has[@]}" -c "$SOURCE/tests/headers/c_side.c" -o "$here/c.o" || failed "$name.h"
      "${CXX:-g++}" -std=c++17 -O1 -ffp-contract=off -DHEADER="\"$cpp\"" -DSPACE="$space" "$SOURCE/tests/headers/c_and_cpp.cpp" "$here/c.o" -o "$here/both" || failed "$name"
      compared=$("$here/both") || failed "$name: $compared"
      values=$((values + $(tail -1 <<<"$compared")))
      [ "$(wc -l <<<"$compared")" -eq 1 ] || echo "$name: $(head -1 <<<"$compared")"
      count=$((count + 1))
    done
  done < <(find "$SOURCE/systems" -name "${model:-*}.toml" -not -path '*/book/*' -not -path '*/parts/*' | sort)
done
[ "$count" -gt 0 ] || failed "no C header found"
echo "$count C headers are clean, and equal to C++ in $values values"
