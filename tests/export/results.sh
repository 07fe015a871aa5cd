#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# simulate --write mat,mat73,npz: the numbers, names and units of the CSV, read by numpy and Octave (which cannot read 7.3: tests/generator/run does); the same bytes in every
# run. Needs the program (PROGRAM) and the sources (SOURCE). Exit code 77 without numpy or Octave.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
skip() { echo "skipped: $*"; exit 77; }
command -v octave-cli >/dev/null || skip "there is no Octave (on Debian: apt-get install octave)"
python=
for candidate in python3 /usr/bin/python3; do
  "$candidate" -c 'import numpy' 2>/dev/null && { python=$candidate; break; }
done
[ -n "$python" ] || skip "no Python has numpy (on Debian: apt-get install python3-numpy)"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
simulate() { "$PROGRAM" simulate "$@" --write mat,mat73,npz --no-plot >"$here/said" 2>&1 || failed "$(cat "$here/said")"; }
for model in mechanics/stick_slip mechanics/kepler heat/transient_bar; do
  name=$(basename "$model")
  simulate "$SOURCE/systems/$model.toml" -o "$here/$name"
  sleep 1
  simulate "$SOURCE/systems/$model.toml" -o "$here/again"
  for file in "$here/$name"/*.mat "$here/$name"/*.npz; do cmp -s "$file" "$here/again/$(basename "$file")" || failed "$(basename "$file") is not the same in every run"; done
  csv=$(ls "$here/$name"/*.csv | grep -v _events)
  "$python" - "$csv" "${csv%.csv}.npz" <<'CODE' || failed "$name: npz"
import csv, re, sys
import numpy as np
rows = list(csv.reader(open(sys.argv[1])))
table, arrays = np.array(rows[1:], dtype=float), np.load(sys.argv[2])
titles = [f"{n} [{u}]" if u else n for n, u in zip(arrays["names"], arrays["units"])]
assert titles == rows[0], titles
for i, name in enumerate(arrays["names"]):
    assert np.array_equal(arrays[name], table[:, i]), name
if "modes" in arrays:
    events = list(csv.reader(open(sys.argv[1].replace(".csv", "_events.csv"))))[1:]
    assert len(events) > 0 and arrays["event_times"].tolist() == [float(e[0]) for e in events]
    assert [list(e) for e in zip(arrays["event_names"], arrays["event_from"], arrays["event_to"])] == [e[1:] for e in events]
    assert set(arrays["event_from"]) <= set(arrays["modes"])
CODE
  cat >"$here/read.m" <<'CODE'
paths = argv();
table = csvread(paths{1}, 1, 0);
load(paths{2});
assert(numel(names) == columns(table) && numel(units) == columns(table) && isequal(fieldnames(run), fields));
for i = 1:columns(table)
  assert(run.(fields{i}), table(:, i), -1e-15);
end
file = fopen(paths{1});
title = fgetl(file);
for i = 1:numel(names)
  expected = names{i};
  if ~isempty(units{i}), expected = [expected ' [' units{i} ']']; end
  assert(~isempty(strfind([',' title ','], [',' expected ','])) || ~isempty(strfind(title, ['"' expected '"'])));
end
if exist('events', 'var')
  assert(numel(events.t) == numel(events.name) && numel(events.t) > 0 && all(ismember(events.from, modes)));
end
CODE
  octave-cli --no-history --no-init-file --quiet "$here/read.m" "$csv" "${csv%.csv}.mat" >"$here/said" 2>&1 || failed "$name: mat: $(cat "$here/said")"
  head -c 19 "${csv%.csv}_v73.mat" | grep -q 'MATLAB 7.3 MAT-file' || failed "$name: the header of version 7.3"
  if command -v h5dump >/dev/null; then h5dump -d /run/t "${csv%.csv}_v73.mat" >/dev/null || failed "$name: HDF5"; fi
done
echo "results are those of the CSV"
