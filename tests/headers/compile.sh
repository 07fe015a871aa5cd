#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every generated header, every function of it, in float, double and long double, without a warning, exceptions or type information.
# "each": of each model one header.
set -euo pipefail
compiler=$1
command -v "$compiler" >/dev/null || { echo "$compiler is missing"; exit 1; }
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
flags=(-std=c++17 -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wfloat-conversion -Werror -fno-exceptions -fno-rtti)
count=0
last=
while read -r header; do
  model=$(sed -n 's/^namespace \(.*\)::.* {$/\1/p' "$header" | head -1)
  [ "${2:-all}" = all ] || [ "$model" != "$last" ] || continue
  last=$model
  name_space=$(sed -n 's/^namespace \(.*::.*\) {$/\1/p' "$header" | head -1)
  {
    echo "#include \"$header\""
    class=$(sed -n 's/^class \(System\|Controller\)\b.*/\1/p' "$header" | head -1)
    for scalar in float double "long double"; do echo "template class $name_space::$class<$scalar>;"; done
  } >"$here/all.cpp"
  "$compiler" "${flags[@]}" "$here/all.cpp" || { echo "$header fails with $compiler"; exit 1; }
  included=$(grep -c '^#include' "$header")
  [ "$included" -eq 4 ] || { echo "$header includes more than <array>, <cmath>, <cstddef>, <limits>"; exit 1; }
  count=$((count + 1))
done < <(find "$SOURCE/generated" -name '*.hpp' | sort)
[ "$count" -gt 10 ] || { echo "only $count headers found"; exit 1; }
echo "$count headers are clean with $compiler"
