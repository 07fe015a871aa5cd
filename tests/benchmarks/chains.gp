# SPDX-License-Identifier: GPL-3.0-or-later
# gnuplot -e "csv='chains.csv'; svg='chains.svg'" chains.gp
set datafile separator ','
set terminal svg size 900,420 font 'DejaVu Sans,12' background 'white'
set output svg
set multiplot layout 1,2
set logscale xy
set grid
set key top left
set xlabel 'links'
set ylabel 'ns a call'
set xtics (1, 2, 3, 5, 8, 12, 20, 30)
set xrange [0.9:34]
only(name, column) = strcol(2) eq name ? column : NaN
do for [function in 'rhs both'] {
  c = function eq 'rhs' ? 3 : 5
  set title function eq 'rhs' ? 'right-hand side' : 'right-hand side with Jacobian'
  plot csv using 1:(only('by hand', column(c + 1))) with linespoints pt 7 ps 0.6 lw 1.5 lc rgb '#888888' title 'loops by hand', \
       csv using 1:(only('SymPy', column(c + 1))) with linespoints pt 7 ps 0.6 lw 1.5 lc rgb '#d95f02' title "SymPy's C code", \
       csv using 1:(only('by hand', column(c))) with linespoints pt 7 ps 0.6 lw 2 lc rgb '#1b5e9e' title 'generated'
}
unset multiplot
