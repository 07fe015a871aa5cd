#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Packages for Python: their values, Jacobians, runs and errors, see python.py. Needs the program (PROGRAM) and the sources (SOURCE). Arguments: MODEL or
# MODEL:SCENE of systems/; every scene of all of them if there are none. Exit code 77 where no Python has numpy.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c 'import numpy' 2>/dev/null && { python=$candidate; break; }
done
[ -n "$python" ] || { echo "skipped: no Python has numpy (on Debian: apt-get install python3-numpy)"; exit 77; }
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
export PYTHONDONTWRITEBYTECODE=1
failed() { echo "FAILED: $*"; exit 1; }
scenes=()
for model in "$@"; do scenes+=("$(machines "${model%%:*}"):${model#*:}"); done
[ $# -gt 0 ] || while read -r model; do scenes+=("$model:"); done < <(machines)
count=0 bad=0
for entry in "${scenes[@]}"; do
  model=${entry%%:*} wanted=${entry#*:} size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  for scene in $("$PROGRAM" scenes "$model" --format json | sed -n 's/^ *"scene": "\(.*\)",*$/\1/p'); do
    [ -z "$wanted" ] || [ "$wanted" = "$(basename "$model" .toml)" ] || [ "$wanted" = "$scene" ] || continue
    rm -rf "$here/out"
    "$PROGRAM" export "$model" --to python --scene "$scene" "${size[@]}" -o "$here/out" >"$here/said" 2>&1 || {
      grep -q 'nothing-left' "$here/said" || failed "$(basename "$model") $scene is not exported: $(cat "$here/said")"
      continue
    }
    package=$(echo "$here"/out/*)
    "$python" "$SOURCE/tests/export/python.py" "$package" "$PROGRAM" "$SOURCE" || bad=$((bad + 1))
    count=$((count + 1))
  done
done
[ "$count" -gt 0 ] || failed "nothing was exported"
[ "$bad" -eq 0 ] || failed "$bad of $count packages"

# The C files, with all warnings; and with sanitizers, where gcc has them.
for compiler in gcc clang; do
  command -v "$compiler" >/dev/null || continue
  "$compiler" -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -fPIC -shared "$package/c/plant.c" -o "$here/warned.so" -lm ||
    failed "$compiler warns"
done
asan=$(gcc -print-file-name=libasan.so 2>/dev/null || true)
if [ -e "$asan" ]; then
  cp -r "$here/out" "$here/checked"
  rm "$here/checked"/*/c/*.so
  CC="gcc -g -fsanitize=address,undefined -fno-sanitize-recover=all" LD_PRELOAD=$asan ASAN_OPTIONS=detect_leaks=0 PYTHONMALLOC=malloc \
    "$python" -W ignore "$here"/checked/*/example.py >"$here/said" 2>&1 || failed "the example with sanitizers: $(tail -20 "$here/said")"
fi

# The package alone: without its library it is compiled again, also where its folder cannot be written, and a library of other texts is not taken.
cd "$here/out"
name=$(basename "$package")
run() { XDG_CACHE_HOME=$here/cache "$python" -c "import sys; sys.path.insert(0, '$here/out'); import $name as p; print(p.Plant().rhs(p.Plant().x0))"; }
expected=$(run)
rm "$name"/c/*.so
[ "$(run)" = "$expected" ] && [ -e "$name"/c/plant-*.so ] || failed "a missing library is not compiled"
rm "$name"/c/*.so
echo "/* other */" >>"$name/c/plant.c"
[ "$(run)" = "$expected" ] || failed "changed texts are not compiled"
if CC=no-such-compiler run >/dev/null 2>&1; then :; else failed "a library that is there needs a compiler"; fi
echo "/* and other */" >>"$name/c/plant.c"
if CC=no-such-compiler run >"$here/said" 2>&1; then failed "a library of other texts is taken"; fi
grep -q "no-such-compiler' cannot be started" "$here/said" || failed "the missing compiler is not told: $(tail -1 "$here/said")"
rm "$name"/c/*.so
chmod -w "$name/c"
if ! [ -w "$name/c" ]; then [ "$(run)" = "$expected" ] && ls "$here"/cache/dalembert/python/*/plant-*.so >/dev/null || failed "no use of the cache"; fi
chmod +w "$name/c"
echo "$count packages"
