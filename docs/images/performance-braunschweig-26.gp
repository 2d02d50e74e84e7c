# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-braunschweig-26.gp in this folder draws both pictures again.
# slices (number per column), 2499 m: ms, error with noise, error noise-free, label
$view0_method0 << END
10.80 2.299 2.869 "1"
18.44 1.134 1.524 ""
27.02 0.756 0.966 ""
31.97 0.596 0.811 ""
46.90 0.481 0.598 ""
61.44 0.310 0.397 ""
76.67 0.225 0.289 ""
100.21 0.234 0.265 "16"
130.90 0.111 0.131 ""
230.83 0.088 0.108 ""
336.37 0.056 0.074 "64"
END
$view0_method0_labels << END
10.80 2.299 2.869 "1"
100.21 0.234 0.265 "16"
336.37 0.056 0.074 "64"
END
$view0_method0_default << END
100.21 0.234 0.265 "16"
END
# rays (number per cell and column), 2499 m: ms, error with noise, error noise-free, label
$view0_method1 << END
13.28 3.725 4.762 "0.5"
16.86 2.658 3.157 ""
24.68 1.976 2.403 ""
34.19 1.391 1.631 "4"
48.21 0.826 1.012 ""
78.91 0.536 0.647 ""
169.17 0.385 0.486 ""
294.03 0.266 0.358 "64"
END
$view0_method1_labels << END
13.28 3.725 4.762 "0.5"
34.19 1.391 1.631 "4"
294.03 0.266 0.358 "64"
END
$view0_method1_default << END
34.19 1.391 1.631 "4"
END
# naive, dithered, 2499 m: ms, error with noise, error noise-free, label
$view0_method2 << END
24.86 62.576 82.120 ""
36.67 49.919 69.139 ""
75.65 28.590 45.963 ""
137.93 16.557 28.422 ""
282.16 3.159 4.882 ""
705.34 1.079 1.264 ""
1341.97 0.512 0.639 ""
END
# naive, plain, 2499 m: ms, error with noise, error noise-free, label
$view0_method3 << END
20.26 33.495 52.237 ""
32.15 20.974 35.324 ""
81.71 4.451 6.391 ""
142.57 2.943 3.653 ""
245.86 2.627 3.258 ""
609.71 2.519 3.117 ""
END
# slices (number per column), 1001 m: ms, error with noise, error noise-free, label
$view1_method0 << END
13.52 1.902 2.319 "1"
21.40 0.923 1.104 ""
29.88 0.523 0.648 ""
32.30 0.365 0.468 ""
49.24 0.293 0.356 ""
67.63 0.176 0.239 ""
82.65 0.139 0.172 ""
101.09 0.122 0.152 "16"
144.59 0.084 0.112 ""
227.41 0.070 0.096 ""
438.47 0.049 0.067 "64"
END
$view1_method0_default << END
101.09 0.122 0.152 "16"
END
# rays (number per cell and column), 1001 m: ms, error with noise, error noise-free, label
$view1_method1 << END
10.42 3.100 3.918 "0.5"
17.17 2.349 2.824 ""
24.53 1.532 1.891 ""
44.02 1.170 1.384 "4"
56.11 0.646 0.795 ""
92.36 0.539 0.635 ""
149.98 0.307 0.388 ""
307.03 0.247 0.349 "64"
END
$view1_method1_default << END
44.02 1.170 1.384 "4"
END
# naive, dithered, 1001 m: ms, error with noise, error noise-free, label
$view1_method2 << END
24.32 63.588 81.625 ""
39.19 54.959 73.709 ""
83.98 41.254 59.879 ""
146.99 27.197 43.589 ""
294.94 12.740 22.982 ""
738.52 1.814 2.444 ""
1468.91 0.807 1.052 ""
END
# naive, plain, 1001 m: ms, error with noise, error noise-free, label
$view1_method3 << END
23.33 45.190 64.339 ""
33.46 32.755 50.368 ""
71.15 13.210 23.623 ""
152.56 4.321 6.919 ""
295.30 2.731 3.300 ""
671.14 2.384 2.767 ""
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
set xrange [5:2350.26]
set yrange [0.01:106.757]
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
