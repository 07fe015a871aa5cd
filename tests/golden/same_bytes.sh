#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The same model gives the same bytes on every run, with addresses of memory randomised by the system. Argument: how many runs.
set -euo pipefail
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
runs=$1
for ((run = 1; run <= runs; ++run)); do
  for model in $(machines_and_parts) "$SOURCE"/systems/controllers/*.toml; do
    "$PROGRAM" generate "$model" --every-scene -o "$here/$run" >/dev/null
    "$PROGRAM" derive "$model" --format latex >"$here/$run/$(basename "$model").tex"
  done
  "$PROGRAM" generate "$SOURCE/systems/mechanics/n_pendulum.toml" --size N=7 -o "$here/$run" >/dev/null
  "$PROGRAM" derive "$SOURCE/systems/mechanics/n_pendulum.toml" --size N=4 >"$here/$run/n_pendulum.txt"
  diff -r "$here/1" "$here/$run" >/dev/null || { echo "run $run differs from run 1:"; diff -rq "$here/1" "$here/$run"; exit 1; }
done
echo "$runs runs, $(find "$here/1" -type f | wc -l) files, all the same; randomize_va_space is $(cat /proc/sys/kernel/randomize_va_space 2>/dev/null || echo unknown)"
