#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A program built by another compiler, whose order of evaluation is its own, generates the same bytes.
set -euo pipefail
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cmake -S "$SOURCE" -B "$here/build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DDALEMBERT_TESTS=OFF >/dev/null
cmake --build "$here/build" --target dalembert >"$here/log" || { cat "$here/log"; exit 1; }
for program in "$PROGRAM" "$here/build/dalembert"; do
  output=$here/$([ "$program" = "$PROGRAM" ] && echo one || echo other)
  for model in $(machines_and_parts); do "$program" generate "$model" --every-scene -o "$output" >/dev/null; done
  "$program" generate "$SOURCE/systems/mechanics/n_pendulum.toml" --size N=20 -o "$output" >/dev/null
done
diff -rq "$here/one" "$here/other"
echo "$(find "$here/one" -name '*.hpp' | wc -l) headers are the same from g++ and clang++"
