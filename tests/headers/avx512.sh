#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# g++ 12.2 makes wrong code of copies of short arrays for AVX-512. With the flags that this project uses, the copies are right; with those
# flags that make them wrong, runtime and headers warn.
#     avx512.sh FLAGS...   each a set of flags, as one word
set -euo pipefail
compiler=${CXX:-c++}
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cat >"$here/copies.cpp" <<'CODE'
#include <algorithm>
#include <array>
#include <cstdio>
using Four = std::array<double, 4>;
using Five = std::array<double, 5>;
__attribute__((noinline)) void show(const Four& a, const Five& b) {
    std::printf("%g %g %g %g %g %g %g %g %g\n", a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], b[4]);
}
int main() {
    Four x = {1, 1, 0, 0};
    Five e{};
    std::copy_n(x.begin(), 4, e.begin());
    Four y;
    std::copy_n(e.begin(), 4, y.begin());
    show(y, e);
    show(x, e);
}
CODE
right="1 1 0 0 1 1 0 0 0"

are_right() {
  "$compiler" -std=c++17 $1 "$here/copies.cpp" -o "$here/copies"
  [ "$("$here/copies" | sort -u)" = "$right" ]
}
[ $# -gt 0 ] || { echo "which flags?"; exit 1; }
for flags in "$@"; do
  are_right "$flags" || { echo "wrong code with $compiler $flags"; exit 1; }
done
echo "right with $# sets of flags"

# What warns: headers in C++ and C, and each part of the runtime that is included alone. Only where the compiler can be told of AVX-512.
"$compiler" -mavx512f -E -x c++ /dev/null >/dev/null 2>&1 || { echo "no AVX-512 here"; exit 0; }
"$PROGRAM" generate "$SOURCE/systems/mechanics/pendulum.toml" -o "$here" >/dev/null
"$PROGRAM" generate "$SOURCE/systems/mechanics/pendulum.toml" --language c -o "$here" >/dev/null
echo '#include "pendulum_full.hpp"' >"$here/header.cpp"
echo '#include "pendulum_full.h"' >"$here/header_in_c.cpp"
for part in simulate simulate_switching equilibrium modal matrices; do echo "#include \"dalembert/$part.hpp\"" >"$here/$part.cpp"; done
is_12=$("$compiler" -E -dM -x c++ /dev/null | grep -c '__GNUC__ 12$' || true)
for file in header header_in_c simulate simulate_switching equilibrium modal matrices; do
  compile() { "$compiler" -std=c++17 -E -o /dev/null -I"$SOURCE/runtime" -isystem /usr/include/eigen3 "$@" "$here/$file.cpp" 2>&1 | grep -c 'warning: .*wrong code for AVX-512' || true; }
  warned=$(compile -O2 -mavx512f)
  [ "$warned" -eq "$is_12" ] || { echo "$file: $warned warnings with -O2 -mavx512f, $is_12 expected"; exit 1; }
  for flags in "-O2" "-O2 -mavx512f -mno-avx512f" "-O0 -mavx512f" "-O2 -mavx512f -DDALEMBERT_TRUST_AVX512"; do
    [ "$(compile $flags)" -eq 0 ] || { echo "$file warns with $flags"; exit 1; }
  done
done
echo "and what compiles for AVX-512 warns: $is_12"
