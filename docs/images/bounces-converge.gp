# Error of the whole picture over slices per column, before bounces followed the sampling and since: the figures of
# docs/physics/double-bounce.md. gnuplot bounces-converge.gp
set terminal svg size 760,420 font "sans,13" background "white"
set output "bounces-converge.svg"
set logscale xy 2
set logscale y 10
set xlabel "azimuth slices per column"
set ylabel "error of the whole picture, grey levels RMS"
set xtics (1, 2, 4, 8, 16, 32, 64)
set yrange [0.05:5]
set grid
set xrange [0.9:80]
set key outside right
$innsbruck << EOD
1 2.709 2.173
2 1.516 1.285
3 1.069 0.928
4 0.899 0.799
8 0.570 0.508
16 0.369 0.347
64 0.181 0.151
EOD
$braunschweig << EOD
1 2.409 0.961
2 1.355 0.688
3 0.842 0.502
4 0.722 0.295
8 0.539 0.217
16 0.378 0.157
64 0.192 0.079
EOD
$before << EOD
8 2.277 3.432
16 2.275 3.430
EOD
plot $innsbruck using 1:2 with linespoints lw 2 pt 7 lc "#c44e52" title "innsbruck-26, B-scope", \
  $innsbruck using 1:3 with linespoints lw 2 pt 6 dt 2 lc "#c44e52" title "C-scope", \
  $before using 1:2 with linespoints lw 2 pt 5 lc "#777777" title "innsbruck-26 before, B-scope", \
  $before using 1:3 with linespoints lw 2 pt 4 dt 2 lc "#777777" title "C-scope", \
  $braunschweig using 1:2 with linespoints lw 2 pt 7 lc "#4c72b0" title "braunschweig-26, B-scope", \
  $braunschweig using 1:3 with linespoints lw 2 pt 6 dt 2 lc "#4c72b0" title "C-scope"
