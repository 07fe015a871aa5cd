#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# MEX functions in Octave: their values, runs, handles and errors, see octave.m. The values are those of the package for Python. Needs the program (PROGRAM)
# and the sources (SOURCE). Arguments: MODEL or MODEL:SCENE of systems/; every scene of all of them if there are none. Exit code 77 without Octave or numpy.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
skip() { echo "skipped: $*"; exit 77; }
command -v octave-cli >/dev/null || skip "there is no Octave (on Debian: apt-get install octave octave-dev)"
command -v mkoctfile >/dev/null || skip "there is no mkoctfile (on Debian: apt-get install octave-dev)"
python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c 'import numpy' 2>/dev/null && { python=$candidate; break; }
done
[ -n "$python" ] || skip "no Python has numpy (on Debian: apt-get install python3-numpy)"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
export PYTHONDONTWRITEBYTECODE=1
failed() { echo "FAILED: $*"; exit 1; }
octave() { octave-cli --no-history --no-init-file --quiet "$@" 2>&1; }
scenes=()
for model in "$@"; do scenes+=("$(machines "${model%%:*}"):${model#*:}"); done
[ $# -gt 0 ] || while read -r model; do scenes+=("$model:"); done < <(machines)
count=0 bad=0
for entry in "${scenes[@]}"; do
  model=${entry%%:*} wanted=${entry#*:} size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  for scene in $("$PROGRAM" scenes "$model" --format json | sed -n 's/^ *"scene": "\(.*\)",*$/\1/p'); do
    [ -z "$wanted" ] || [ "$wanted" = "$(basename "$model" .toml)" ] || [ "$wanted" = "$scene" ] || continue
    rm -rf "$here/python" "$here/octave"
    "$PROGRAM" export "$model" --to python --scene "$scene" "${size[@]}" -o "$here/python" >"$here/said" 2>&1 || {
      grep -q 'nothing-left' "$here/said" || failed "$(basename "$model") $scene is not exported: $(cat "$here/said")"
      continue
    }
    "$PROGRAM" export "$model" --to octave --scene "$scene" "${size[@]}" -o "$here/octave" >"$here/said" 2>&1 || failed "$(cat "$here/said")"
    folder=$(echo "$here"/octave/*) name=$(basename "$here"/octave/*)
    [ -e "$folder/${name}_mex.mex" ] || failed "$name is not compiled: $(grep note "$here/said")"
    "$python" "$SOURCE/tests/export/octave.py" "$here"/python/* "$PROGRAM" "$here" || failed "$name: nothing to compare with"
    octave "$SOURCE/tests/export/octave.m" "$folder" "$here/points.mat" "$here/run.mat" >"$here/said" || {
      bad=$((bad + 1))
      sed "s/^/$name: /" "$here/said" | cut -c1-300 | head -20
    }
    count=$((count + 1))
  done
done
[ "$count" -gt 0 ] || failed "nothing was exported"
[ "$bad" -eq 0 ] || failed "$bad of $count functions"

for compiler in gcc clang; do
  command -v "$compiler" >/dev/null || continue
  "$compiler" -std=c99 -O2 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror -fPIC -shared \
    -isystem "$(mkoctfile -p OCTINCLUDEDIR)" "$folder/c/plant.c" -o "$here/warned.so" -lm || failed "$compiler warns"
done

# Without its MEX file the function is compiled at the first call; the example runs; the help is there.
rm "$folder/${name}_mex.mex"
cd "$here"
octave --eval "addpath('$folder'); ${name}_example; help $name" >"$here/said" || failed "the example: $(tail -3 "$here/said")"
grep -q "Equations" "$here/said" && [ -e "$folder/${name}_mex.mex" ] || failed "the help, or no compiled function"
echo "$count functions"
