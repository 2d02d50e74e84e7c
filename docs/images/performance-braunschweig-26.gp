# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-braunschweig-26.gp in this folder draws both pictures again.
# slices (number per column), 2499 m: ms, error with noise, error noise-free, label
$view0_method0 << END
6.02 1.878 2.471 "1"
9.21 0.846 1.163 ""
12.77 0.512 0.724 ""
16.33 0.359 0.533 ""
23.78 0.219 0.332 ""
31.42 0.148 0.227 "8"
44.11 0.119 0.192 ""
58.16 0.073 0.103 ""
83.97 0.059 0.079 ""
109.93 0.054 0.074 ""
212.33 0.050 0.067 "64"
END
$view0_method0_labels << END
6.02 1.878 2.471 "1"
31.42 0.148 0.227 "8"
212.33 0.050 0.067 "64"
END
$view0_method0_default << END
31.42 0.148 0.227 "8"
END
# rays (number per cell and column), 2499 m: ms, error with noise, error noise-free, label
$view0_method1 << END
5.51 3.165 4.093 "0.5"
8.14 2.132 2.673 ""
10.89 1.645 2.077 ""
17.76 1.018 1.270 "4"
24.66 0.730 0.928 ""
40.64 0.462 0.617 ""
70.60 0.300 0.387 ""
123.54 0.211 0.291 "64"
END
$view0_method1_labels << END
5.51 3.165 4.093 "0.5"
17.76 1.018 1.270 "4"
123.54 0.211 0.291 "64"
END
$view0_method1_default << END
17.76 1.018 1.270 "4"
END
# naive, dithered, 2499 m: ms, error with noise, error noise-free, label
$view0_method2 << END
13.46 62.647 82.194 ""
23.53 49.966 69.218 ""
52.20 28.563 45.888 ""
100.07 16.504 28.379 ""
196.97 3.303 5.111 ""
475.42 1.098 1.309 ""
934.64 0.499 0.605 ""
END
# naive, plain, 2499 m: ms, error with noise, error noise-free, label
$view0_method3 << END
12.40 33.961 52.791 ""
20.86 21.232 35.683 ""
46.49 4.547 6.410 ""
88.04 2.979 3.716 ""
170.61 2.619 3.240 ""
421.28 2.519 3.118 ""
END
# slices (number per column), 1001 m: ms, error with noise, error noise-free, label
$view1_method0 << END
6.03 1.531 1.888 "1"
10.18 0.786 0.918 ""
14.63 0.381 0.494 ""
19.33 0.266 0.340 ""
26.16 0.155 0.200 ""
34.72 0.115 0.150 "8"
50.68 0.084 0.111 ""
62.89 0.064 0.093 ""
89.71 0.051 0.071 ""
117.61 0.046 0.065 ""
226.17 0.042 0.060 "64"
END
$view1_method0_default << END
34.72 0.115 0.150 "8"
END
# rays (number per cell and column), 1001 m: ms, error with noise, error noise-free, label
$view1_method1 << END
6.06 2.855 3.640 "0.5"
8.86 1.863 2.303 ""
12.18 1.256 1.625 ""
20.11 0.875 1.119 "4"
29.05 0.564 0.723 ""
47.85 0.346 0.455 ""
82.08 0.216 0.288 ""
144.23 0.147 0.204 "64"
END
$view1_method1_default << END
20.11 0.875 1.119 "4"
END
# naive, dithered, 1001 m: ms, error with noise, error noise-free, label
$view1_method2 << END
14.62 63.642 81.644 ""
24.82 54.837 73.602 ""
54.13 41.297 60.001 ""
104.62 27.271 43.692 ""
204.26 12.790 23.025 ""
504.06 1.818 2.456 ""
1030.21 0.809 1.078 ""
END
# naive, plain, 1001 m: ms, error with noise, error noise-free, label
$view1_method3 << END
13.19 45.601 64.799 ""
22.06 33.057 50.688 ""
49.16 13.494 24.102 ""
91.43 4.485 7.251 ""
179.32 2.750 3.358 ""
439.51 2.385 2.782 ""
END
do for [format in 'svg png'] {
reset
if (format eq 'svg') {
  set terminal svg size 1200,660 font 'sans,13' background rgb 'white'
} else {
  set terminal pngcairo size 1200,660 font 'sans,11' background rgb 'white'
}
set output 'performance-braunschweig-26.'.format
set multiplot title 'braunschweig-26: error over frame time (low and left is good)' font ',15' noenhanced
set tmargin at screen 0.88
set bmargin at screen 0.2
unset key
set logscale xy
set xrange [1:1648.33]
set yrange [0.01:106.852]
set xtics (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
set xlabel 'frame time, ms (from the pose to both displays)'
set ylabel 'B-scope error, grey levels RMS (of 255)'
set grid xtics ytics lt 1 lc rgb '#d8d8d8'
set arrow from 62.500, graph 0 to 62.500, graph 1 nohead lw 1.5 dt 3 lc rgb 'black' back
set label '16 Hz: 62.5 ms' at 62.500, graph 0.02 rotate by 90 left offset -1.2, 0
set arrow from 11.111, graph 0 to 11.111, graph 1 nohead lw 1.5 dt 3 lc rgb 'black' back
set label '90 Hz: 11.1 ms' at 11.111, graph 0.02 rotate by 90 left offset -1.2, 0
set lmargin at screen 0.06
set rmargin at screen 0.485
set title 'as displayed, with the noise of the receiver'
picture = 2
plot \
    $view0_method0 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#0072b2' notitle, \
    $view0_method0_labels using 1:picture:4 with labels offset 0.6, 0.7 left font ',9' textcolor rgb '#0072b2' notitle, \
    $view0_method0_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#0072b2' notitle, \
    $view0_method1 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#d55e00' notitle, \
    $view0_method1_labels using 1:picture:4 with labels offset 0.6, 0.7 left font ',9' textcolor rgb '#d55e00' notitle, \
    $view0_method1_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#d55e00' notitle, \
    $view0_method2 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#009e73' notitle, \
    $view0_method3 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#8c8c8c' notitle, \
    $view1_method0 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#0072b2' notitle, \
    $view1_method0_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#0072b2' notitle, \
    $view1_method1 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#d55e00' notitle, \
    $view1_method1_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#d55e00' notitle, \
    $view1_method2 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#009e73' notitle, \
    $view1_method3 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#8c8c8c' notitle, \
    NaN notitle
set lmargin at screen 0.555
set rmargin at screen 0.985
set title 'noise-free'
picture = 3
plot \
    $view0_method0 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#0072b2' notitle, \
    $view0_method0_labels using 1:picture:4 with labels offset 0.6, 0.7 left font ',9' textcolor rgb '#0072b2' notitle, \
    $view0_method0_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#0072b2' notitle, \
    $view0_method1 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#d55e00' notitle, \
    $view0_method1_labels using 1:picture:4 with labels offset 0.6, 0.7 left font ',9' textcolor rgb '#d55e00' notitle, \
    $view0_method1_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#d55e00' notitle, \
    $view0_method2 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#009e73' notitle, \
    $view0_method3 using 1:picture with linespoints lw 2 dt 1 pt 7 ps 0.5 lc rgb '#8c8c8c' notitle, \
    $view1_method0 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#0072b2' notitle, \
    $view1_method0_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#0072b2' notitle, \
    $view1_method1 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#d55e00' notitle, \
    $view1_method1_default using 1:picture with points pt 6 ps 1.8 lw 2 lc rgb '#d55e00' notitle, \
    $view1_method2 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#009e73' notitle, \
    $view1_method3 using 1:picture with linespoints lw 2 dt 2 pt 7 ps 0.5 lc rgb '#8c8c8c' notitle, \
    NaN notitle
set lmargin at screen 0.02
set rmargin at screen 0.98
set tmargin at screen 0.115
set bmargin at screen 0.005
unset title
unset xlabel
unset ylabel
unset tics
unset border
unset arrow
unset label
set key center center vertical maxrows 4 samplen 3 width 4
plot \
    NaN notitle, \
    keyentry with lines lw 3 lc rgb '#0072b2' title 'slices (number per column)', \
    keyentry with lines lw 3 lc rgb '#d55e00' title 'rays (number per cell and column)', \
    keyentry with lines lw 3 lc rgb '#009e73' title 'naive, dithered', \
    keyentry with lines lw 3 lc rgb '#8c8c8c' title 'naive, plain', \
    keyentry with lines lw 2 dt 1 lc rgb 'black' title '2499 m before the threshold', \
    keyentry with lines lw 2 dt 2 lc rgb 'black' title '1001 m before the threshold', \
    keyentry with points pt 6 ps 1.8 lw 2 lc rgb 'black' title 'default sampling'
unset multiplot
set output
}
