#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The functions of runtime/c: each compiles with what it says it needs, all of them are clean for every compiler there is, for two headers
# in one file, as C99 and as C++, and in float nothing on a Cortex-M4 calls arithmetic in double.
set -euo pipefail
: "${SOURCE:?}"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
# In the order in which the generator takes them.
mapfile -t files < <(sed -n 's|.*HelperFile{"\([a-z_]*\)", [a-z]*, true}.*|\1|p' "$SOURCE/generator/program/helper_files.hpp")
files=("${files[@]/#/$SOURCE/runtime/c/}")
files=("${files[@]/%/.h.in}")
[ "${#files[@]}" -eq "$(find "$SOURCE/runtime/c" -type f | wc -l)" ] ||
  { echo "runtime/c has a file that the generator does not know"; exit 1; }
flags=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wfloat-conversion -Werror)
includes='#include <float.h>\n#include <math.h>\n#include <stdbool.h>\n#include <stddef.h>\n'

# text NAME SIZE: all functions.
text() { sed "s/NAME/$1/g; s/SIZE/$2/g" "${files[@]}"; }
printf "$includes" >"$here/all.h"
for size in 1 3 13; do text "a$size" $size; done >>"$here/all.h"
text b 2 | sed '1i #define b_real float' >>"$here/all.h"
echo '#include "all.h"' | tee "$here/all.c" >"$here/all.cpp"
for compiler in gcc clang arm-none-eabi-gcc; do
  command -v $compiler >/dev/null || { [ $compiler = gcc ] && exit 1; echo "$compiler is missing"; continue; }
  for level in 0 2; do "$compiler" -std=c99 -O$level "${flags[@]}" -c "$here/all.c" -o "$here/all.o"; done
done
for compiler in g++ clang++; do
  command -v $compiler >/dev/null || continue
  "$compiler" -std=c++17 "${flags[@]}" -fsyntax-only "$here/all.cpp"
done

# section NAME: it and what it needs, in the order of the files. The functions stay without `static`, so that nothing is left out.
section() {
  awk -v wanted="$1" '
    /^\/\/ begin / { name = $3; sub(":", "", name); order[++count] = name; list = $0; sub("^[^:]*:", "", list); needs[name] = list; next }
    /^\/\/ end / { name = ""; next }
    name != "" { body[name] = body[name] $0 "\n" }
    END {
      take[wanted] = 1
      for (i = count; i > 0; --i)
        if (take[order[i]]) { n = split(needs[order[i]], each, "[, ]+"); for (k = 1; k <= n; ++k) if (each[k] != "") take[each[k]] = 1 }
      for (i = 1; i <= count; ++i) if (take[order[i]]) { printf "%s", body[order[i]]; delete take[order[i]] }
      for (left in take) if (take[left]) { print "#error nothing is called " left; exit }
    }' "${files[@]}" | sed 's/NAME/c/g; s/SIZE/3/g; s/^static inline //'
}
sections=0
for name in $(sed -n 's|^// begin \(.*\):.*|\1|p' "${files[@]}"); do
  { printf "$includes"; section "$name"; } >"$here/one.c"
  gcc -std=c99 -Wall -Wextra -Werror -fsyntax-only "$here/one.c" || { echo "$name needs more than it says"; exit 1; }
  sections=$((sections + 1))
done
[ "$sections" -gt 50 ] || { echo "only $sections sections found"; exit 1; }

if command -v arm-none-eabi-gcc >/dev/null; then
  { printf "#define c_real float\n$includes"; text c 3 | sed 's/^static inline //'; } >"$here/float.c"
  for level in 0 s 2; do
    arm-none-eabi-gcc -std=c99 -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard "${flags[@]}" \
      -O$level -c "$here/float.c" -o "$here/float.o"
    called=$(arm-none-eabi-nm -u "$here/float.o" | awk '{ print $2 }')
    wide=$(grep -vE '^([a-z0-9]+f|memcpy|memset|__aeabi_u?l.*|__aeabi_f2.*|__errno)$' <<<"$called" || true)
    [ -z "$wide" ] || { echo "in float, at -O$level, this is called:" $wide; exit 1; }
  done
fi
echo "$sections sections are clean"
