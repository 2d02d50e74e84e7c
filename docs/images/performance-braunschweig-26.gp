# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-braunschweig-26.gp in this folder draws both pictures again.
# slices (number per column), 2499 m: ms, error with noise, error noise-free, label
$view0_method0 << END
5.35 2.110 2.695 "1"
8.98 1.019 1.402 ""
12.81 0.624 0.842 ""
16.45 0.483 0.703 ""
23.62 0.333 0.460 ""
31.06 0.212 0.314 "8"
43.25 0.156 0.230 ""
56.88 0.103 0.134 ""
82.29 0.077 0.099 ""
108.60 0.065 0.086 ""
210.25 0.053 0.071 "64"
END
$view0_method0_labels << END
5.35 2.110 2.695 "1"
31.06 0.212 0.314 "8"
210.25 0.053 0.071 "64"
END
$view0_method0_default << END
31.06 0.212 0.314 "8"
END
# rays (number per cell and column), 2499 m: ms, error with noise, error noise-free, label
$view0_method1 << END
5.46 3.165 4.093 "0.5"
8.38 2.132 2.673 ""
11.07 1.645 2.077 ""
17.90 1.018 1.270 "4"
24.90 0.730 0.928 ""
41.41 0.462 0.617 ""
71.18 0.300 0.387 ""
124.77 0.211 0.291 "64"
END
$view0_method1_labels << END
5.46 3.165 4.093 "0.5"
17.90 1.018 1.270 "4"
124.77 0.211 0.291 "64"
END
$view0_method1_default << END
17.90 1.018 1.270 "4"
END
# naive, dithered, 2499 m: ms, error with noise, error noise-free, label
$view0_method2 << END
14.24 62.647 82.194 ""
24.38 49.966 69.218 ""
53.57 28.563 45.888 ""
102.30 16.504 28.379 ""
199.27 3.303 5.111 ""
485.50 1.098 1.309 ""
985.08 0.499 0.605 ""
END
# naive, plain, 2499 m: ms, error with noise, error noise-free, label
$view0_method3 << END
12.71 33.961 52.791 ""
21.03 21.232 35.683 ""
46.75 4.547 6.410 ""
90.17 2.979 3.716 ""
175.21 2.619 3.240 ""
429.89 2.519 3.118 ""
END
# slices (number per column), 1001 m: ms, error with noise, error noise-free, label
$view1_method0 << END
6.06 1.674 2.089 "1"
10.31 0.847 1.027 ""
14.32 0.436 0.577 ""
17.90 0.317 0.421 ""
26.39 0.202 0.278 ""
34.28 0.129 0.175 "8"
47.72 0.096 0.132 ""
62.17 0.082 0.120 ""
88.65 0.062 0.088 ""
116.27 0.054 0.078 ""
224.54 0.044 0.063 "64"
END
$view1_method0_default << END
34.28 0.129 0.175 "8"
END
# rays (number per cell and column), 1001 m: ms, error with noise, error noise-free, label
$view1_method1 << END
6.09 2.855 3.640 "0.5"
9.00 1.863 2.303 ""
12.54 1.256 1.625 ""
20.30 0.875 1.119 "4"
27.77 0.564 0.723 ""
45.84 0.346 0.455 ""
79.04 0.216 0.288 ""
139.05 0.147 0.204 "64"
END
$view1_method1_default << END
20.30 0.875 1.119 "4"
END
# naive, dithered, 1001 m: ms, error with noise, error noise-free, label
$view1_method2 << END
15.29 63.642 81.644 ""
26.13 54.837 73.602 ""
59.66 41.297 60.001 ""
110.63 27.271 43.692 ""
215.96 12.790 23.025 ""
520.87 1.818 2.456 ""
1055.70 0.809 1.078 ""
END
# naive, plain, 1001 m: ms, error with noise, error noise-free, label
$view1_method3 << END
13.23 45.601 64.799 ""
22.43 33.057 50.688 ""
49.46 13.494 24.102 ""
95.65 4.485 7.251 ""
187.57 2.750 3.358 ""
448.76 2.385 2.782 ""
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
set xrange [1:1689.12]
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
