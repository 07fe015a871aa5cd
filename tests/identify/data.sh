#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The data in systems/data are those that this script makes: runs with hidden values, and noise from a seed.
#     data.sh [FOLDER]: writes them there; without a folder it compares
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
out=${1:-$here/data}
mkdir -p "$out"

# noisy SEED COLUMN=NOISE...: time, columns with noise, and the input
noisy() {
  awk -F, -v seed="$1" -v wanted="${*:2}" '
    function uniform() { seed = (seed * 16807) % 2147483647; return seed / 2147483647 }
    function normal(  r) { r = sqrt(-2 * log(uniform())); return r * cos(6.283185307179586 * uniform()) }
    NR == 1 {
      count = split(wanted, part, " ")
      for (k = 1; k <= count; ++k) { split(part[k], pair, "="); name[k] = pair[1]; noise[k] = pair[2] }
      for (i = 1; i <= NF; ++i) { title = $i; sub(/ \[.*/, "", title); place[title] = i; full[title] = $i }
      line = full["t"]
      for (k = 1; k <= count; ++k) line = line "," full[name[k]]
      print line
      next
    }
    {
      line = sprintf("%.2f", $(place["t"]))
      for (k = 1; k <= count; ++k) line = line sprintf(",%.5f", $(place[name[k]]) + (noise[k] > 0 ? noise[k] * normal() : 0))
      print line
    }'
}

model=$SOURCE/systems/mechanics/cart_pendulum.toml
hidden="d_R=0.83,c_W=46.5,m_W=1.15"
for run in 1 2; do
  input=$([ $run = 1 ] && echo "2*sin(4*t)" || echo "1.5*sin(6*t)*sin(t)")
  start=$([ $run = 1 ] && echo "s=0.1,phi=0.5" || echo "s=0,phi=-0.3")
  "$PROGRAM" simulate "$model" --parameter "$hidden" --state "$start" --input "f_e=$input" --until 8 --samples 400 --tolerance 1e-10 --no-plot -o "$here" >/dev/null
  noisy "20$run" s=0.002 phi=0.01 f_e=0 <"$here/cart_pendulum_lab.csv" >"$out/cart_pendulum_$run.csv"
done
[ $# -gt 0 ] && exit 0
diff -r "$out" "$SOURCE/systems/data" && echo "the data are those of their seeds"
