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
1 3.283 3.224
2 1.895 1.893
4 1.308 1.207
8 0.845 0.777
16 0.563 0.504
64 0.263 0.254
EOD
$braunschweig << EOD
1 2.562 1.128
2 1.620 0.688
4 1.102 0.631
8 0.679 0.266
16 0.533 0.215
64 0.251 0.147
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
