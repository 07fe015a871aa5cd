#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A controller that samples, in C99 and float on the board, beside the simulation that computes it in float: the same bits, sample by sample.
# Needs the program (PROGRAM). 1: a bit differs.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/../tools.sh"
require_tools
work=$(realpath -m "${BUILD:-build}")/embedded/sampled
rm -rf "$work"
mkdir -p "$work"
"$PROGRAM" generate "$here/servo_control.toml" --language c -o "$work" >/dev/null
"$PROGRAM" simulate "$here/servo.toml" --no-plot -o "$work" >/dev/null

# What was measured, and what was set: a row a sample, for the board as floats and for the comparison as their bits.
python3 - "$work" <<'PYTHON'
import csv, struct, sys
work = sys.argv[1]
rows = list(csv.reader(open(work + "/servo_full.csv")))
names = [name.split(" [")[0] for name in rows[0]]
place = [names.index(name) for name in ("control_phi", "control_w", "u")]
samples = [[float(row[i]) for i in place] for row in rows[1:-1]]  # at the end no sample is taken
with open(work + "/measured.hpp", "w") as out:
    out.write("const float measurements[][2] = {\n")
    for phi, w, u in samples:
        out.write("    {%sF, %sF},\n" % tuple(struct.unpack("f", struct.pack("f", value))[0].hex() for value in (phi, w)))
    out.write("};\n")
with open(work + "/expected.txt", "w") as out:
    for phi, w, u in samples:
        out.write("%x\n" % struct.unpack("I", struct.pack("f", u))[0])
PYTHON
compile_c -O2 -ffp-contract=off -I"$work" -c "$here/controller.c" -o "$work/controller.o"
compile -O2 -I"$work" "$here/board.cpp" "$work/controller.o" "$board/startup.cpp" "${link[@]}" -o "$work/board.elf"
run_board "$work/board.elf" >"$work/board.txt" || { echo "the board stopped: $(tail -1 "$work/board.txt")" >&2; exit 1; }
diff <(tr 'A-F' 'a-f' <"$work/board.txt" | sed 's/^0*\(.\)/\1/') "$work/expected.txt" >"$work/differences.txt" ||
  { echo "the board sets other values than the simulation:" >&2; head -6 "$work/differences.txt" >&2; exit 1; }
echo "$(wc -l <"$work/expected.txt") samples, the same bits"
