#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The table that exports are made of, in C99, is that of `dalembert compile`, in C++: every text and number, and every function bit by bit.
# Needs the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/, or model files; all of systems/ if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)
"${CC:-cc}" -std=gnu99 -O1 "${warnings[@]}" -Wno-pedantic -I "$SOURCE/runtime" "$SOURCE/tests/export/tables.c" -o "$here/tables" -ldl -lm
mapfile -t models < <(machines "$@")
count=0
for model in "${models[@]}"; do
  size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  for scene in $("$PROGRAM" scenes "$model" --format json | sed -n 's/^ *"scene": "\(.*\)",*$/\1/p'); do
    rm -rf "$here/c"
    "$PROGRAM" export "$model" --to c --scene "$scene" "${size[@]}" -o "$here/c" >/dev/null 2>&1 || {
      "$PROGRAM" export "$model" --to c --scene "$scene" "${size[@]}" -o "$here/c" 2>&1 | grep -q 'nothing-left' || failed "$model $scene is not exported"
      continue
    }
    "$PROGRAM" compile "$model" --scene "$scene" "${size[@]}" -o "$here/c" >/dev/null 2>&1 || failed "$model $scene is not compiled"
    for compiler in ${COMPILERS:-"${CC:-cc}"}; do
      "$compiler" -std=c99 -O2 "${warnings[@]}" -fPIC -shared "$here"/c/*_plant.c -o "$here/c/in_c.so" -lm || failed "$model $scene with $compiler"
    done
    in_cpp=$(ls "$here"/c/*.so | grep -v in_c.so)
    compared=$("$here/tables" "$here/c/in_c.so" "$in_cpp") || failed "$(basename "$model") $scene: $compared"
    count=$((count + 1))
  done
done
[ "$count" -gt 0 ] || failed "nothing was compared"
echo "$count tables are equal"
