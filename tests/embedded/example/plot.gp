# SPDX-License-Identifier: BSL-1.0
# gnuplot -e "csv='balance.csv'; svg='balance.svg'" plot.gp
set datafile separator ","
set terminal svg size 800,900 font "DejaVu Sans,13" background "white"
set output svg
set multiplot layout 3,1 margins 0.11,0.97,0.07,0.97 spacing 0.04
set grid lc rgb "#dddddd"
set key top right
set xrange [0:3]
set format x ""
set ylabel "rod, angle from upright in rad"
plot csv using 1:($3-pi) with lines lw 2 title "rod", csv using 1:($7-pi) with lines lw 2 dt 2 title "as the observer knows it"
set ylabel "cart, position in m"
plot csv using 1:2 with lines lw 2 title "cart", csv using 1:6 with lines lw 2 dt 2 title "as the observer knows it"
set format x "%g"
set xlabel "time in s"
set ylabel "force on the cart in N"
plot csv using 1:10 with steps lw 2 title "force"
unset multiplot
