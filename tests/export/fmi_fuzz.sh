#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# So many calls of an FMU in any order, under sanitizers, in both versions of FMI; and the importer under valgrind, where that is installed.
# Needs the program (PROGRAM), the sources (SOURCE) and the importer (IMPORTER). Arguments: number of calls, names of models of systems/.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}" "${IMPORTER:?the importer}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
calls=$1
shift
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)
for name in "$@"; do
  model=$(machines "$name")
  for version in 2 3; do
    folder=$here/$name$version
    "$PROGRAM" export "$model" --to fmi$version -o "$folder" >/dev/null 2>&1
    unzip -q "$folder"/*.fmu 'sources/*' -d "$folder"
    for compiler in ${COMPILERS:-"${CC:-cc}"}; do
      "$compiler" -std=c99 -fsyntax-only "${warnings[@]}" "$folder/sources/fmi$version.c"
    done
    "${CC:-cc}" -std=c99 -g -O1 "${warnings[@]}" -DFMI_VERSION=$version -fsanitize=address,undefined \
      -fno-sanitize-recover=undefined -I "$folder/sources" \
      -I "$SOURCE/tests/export" "$SOURCE/tests/export/fmi_fuzz.c" "$folder/sources/fmi$version.c" -o "$folder/fuzz" -lm
    "$folder/fuzz" "$calls" 1
  done
  if command -v valgrind >/dev/null; then
    # The importer asks for what a reference run needs, and makes the calls that are wrong.
    "$PROGRAM" compile "$model" -o "$here/plant" >/dev/null 2>&1
    plant=$(ls "$here"/plant/*.so)
    until=$("$IMPORTER" "$folder"/*.fmu | cut -d ' ' -f 1)
    for run in fine rough; do
      "$PROGRAM" simulate "$plant" --until "$until" --tolerance 1e-10 --samples 50 --no-plot -o "$here/$run" >/dev/null 2>&1
      mv "$(ls "$here/$run"/*.csv | grep -v _events)" "$here/$run.csv"
      ! ls "$here/$run"/*_events.csv >/dev/null 2>&1 || mv "$here/$run"/*_events.csv "$here/${run}_events.csv"
    done
    valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite "$IMPORTER" "$folder"/*.fmu "$here" "$plant" ||
      [ $? -ne 9 ]
    rm -rf "$here/plant" "$here/fine" "$here/rough" "$here"/*.csv
  fi
done
