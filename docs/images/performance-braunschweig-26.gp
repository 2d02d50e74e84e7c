# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-braunschweig-26.gp in this folder draws both pictures again.
# slices (number per column), 2499 m: ms, error with noise, error noise-free, label
$view0_method0 << END
8.69 2.299 2.869 "1"
14.90 1.134 1.524 ""
21.86 0.756 0.966 ""
30.83 0.596 0.811 ""
36.22 0.481 0.598 ""
57.10 0.310 0.397 "8"
83.02 0.225 0.289 ""
102.99 0.234 0.265 ""
147.81 0.111 0.131 ""
200.14 0.088 0.108 ""
383.94 0.056 0.074 "64"
END
$view0_method0_labels << END
8.69 2.299 2.869 "1"
57.10 0.310 0.397 "8"
383.94 0.056 0.074 "64"
END
$view0_method0_default << END
57.10 0.310 0.397 "8"
END
# rays (number per cell and column), 2499 m: ms, error with noise, error noise-free, label
$view0_method1 << END
11.77 3.725 4.762 "0.5"
15.41 2.658 3.157 ""
25.16 1.976 2.403 ""
37.37 1.391 1.631 "4"
55.35 0.826 1.012 ""
85.26 0.536 0.647 ""
182.56 0.385 0.486 ""
279.77 0.266 0.358 "64"
END
$view0_method1_labels << END
11.77 3.725 4.762 "0.5"
37.37 1.391 1.631 "4"
279.77 0.266 0.358 "64"
END
$view0_method1_default << END
37.37 1.391 1.631 "4"
END
# naive, dithered, 2499 m: ms, error with noise, error noise-free, label
$view0_method2 << END
20.30 62.576 82.120 ""
36.32 49.919 69.139 ""
72.91 28.590 45.963 ""
142.04 16.557 28.422 ""
283.31 3.159 4.882 ""
699.99 1.079 1.264 ""
1342.68 0.512 0.639 ""
END
# naive, plain, 2499 m: ms, error with noise, error noise-free, label
$view0_method3 << END
18.95 33.883 52.747 ""
33.51 21.114 35.500 ""
66.46 4.646 6.750 ""
128.71 2.972 3.731 ""
266.11 2.601 3.204 ""
668.73 2.522 3.121 ""
END
# slices (number per column), 1001 m: ms, error with noise, error noise-free, label
$view1_method0 << END
12.07 1.903 2.319 "1"
19.45 0.922 1.103 ""
26.83 0.523 0.648 ""
36.53 0.366 0.469 ""
47.98 0.293 0.356 ""
67.22 0.175 0.239 "8"
90.54 0.139 0.172 ""
119.98 0.121 0.151 ""
184.51 0.083 0.111 ""
215.63 0.069 0.094 ""
436.23 0.048 0.066 "64"
END
$view1_method0_default << END
67.22 0.175 0.239 "8"
END
# rays (number per cell and column), 1001 m: ms, error with noise, error noise-free, label
$view1_method1 << END
11.82 3.100 3.918 "0.5"
19.91 2.349 2.824 ""
28.11 1.531 1.891 ""
42.95 1.171 1.385 "4"
68.23 0.648 0.796 ""
100.28 0.539 0.634 ""
204.92 0.307 0.388 ""
338.96 0.247 0.349 "64"
END
$view1_method1_default << END
42.95 1.171 1.385 "4"
END
# naive, dithered, 1001 m: ms, error with noise, error noise-free, label
$view1_method2 << END
23.20 63.588 81.625 ""
38.91 54.959 73.709 ""
75.55 41.254 59.879 ""
164.32 27.197 43.589 ""
288.10 12.740 22.982 ""
791.58 1.814 2.444 ""
1412.02 0.807 1.052 ""
END
# naive, plain, 1001 m: ms, error with noise, error noise-free, label
$view1_method3 << END
19.07 45.509 64.681 ""
36.63 32.994 50.733 ""
76.87 13.391 23.900 ""
142.69 4.396 7.055 ""
285.85 2.731 3.311 ""
681.07 2.388 2.772 ""
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
set xrange [1:2259.23]
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
