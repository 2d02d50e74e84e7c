# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-innsbruck-26.gp in this folder draws both pictures again.
# slices (number per column), 2498 m: ms, error with noise, error noise-free, label
$view0_method0 << END
42.05 3.310 4.251 "1"
74.51 1.998 2.526 ""
97.11 1.479 1.856 ""
109.50 1.327 1.628 "4"
165.54 0.993 1.237 ""
191.54 0.807 1.008 ""
258.97 0.616 0.779 ""
337.68 0.558 0.718 ""
448.25 0.420 0.569 ""
583.87 0.364 0.473 ""
1074.41 0.242 0.350 "64"
END
$view0_method0_labels << END
42.05 3.310 4.251 "1"
109.50 1.327 1.628 "4"
1074.41 0.242 0.350 "64"
END
$view0_method0_default << END
109.50 1.327 1.628 "4"
END
# rays (number per cell and column), 2498 m: ms, error with noise, error noise-free, label
$view0_method1 << END
32.87 6.583 8.685 "0.5"
47.09 4.188 5.571 ""
86.14 3.096 4.210 ""
121.36 1.935 2.695 "4"
200.12 1.288 1.848 ""
328.66 0.869 1.296 ""
599.61 0.553 0.830 ""
1057.55 0.386 0.641 "64"
END
$view0_method1_labels << END
32.87 6.583 8.685 "0.5"
121.36 1.935 2.695 "4"
1057.55 0.386 0.641 "64"
END
$view0_method1_default << END
121.36 1.935 2.695 "4"
END
# naive, dithered, 2498 m: ms, error with noise, error noise-free, label
$view0_method2 << END
51.28 37.373 54.046 ""
93.50 29.494 43.464 ""
247.11 17.439 26.742 ""
334.29 8.535 14.133 ""
618.45 2.873 5.107 ""
1403.87 1.182 2.067 ""
2656.50 0.636 1.107 ""
END
# naive, plain, 2498 m: ms, error with noise, error noise-free, label
$view0_method3 << END
53.39 23.857 36.601 ""
93.45 13.963 22.074 ""
190.65 6.604 9.969 ""
343.51 5.718 8.142 ""
576.14 5.488 7.743 ""
1324.00 5.373 7.542 ""
END
# slices (number per column), 998 m: ms, error with noise, error noise-free, label
$view1_method0 << END
35.11 3.589 4.457 "1"
60.53 2.097 2.652 ""
76.42 1.723 2.222 ""
98.47 1.497 1.853 "4"
154.83 1.112 1.456 ""
173.40 0.947 1.248 ""
248.21 0.744 0.971 ""
297.47 0.626 0.817 ""
407.24 0.529 0.702 ""
538.65 0.448 0.604 ""
1027.07 0.300 0.419 "64"
END
$view1_method0_default << END
98.47 1.497 1.853 "4"
END
# rays (number per cell and column), 998 m: ms, error with noise, error noise-free, label
$view1_method1 << END
30.63 6.111 8.258 "0.5"
44.10 4.187 5.478 ""
71.73 2.900 3.998 ""
106.99 1.917 2.609 "4"
183.43 1.270 1.828 ""
292.99 0.835 1.273 ""
560.78 0.567 0.883 ""
935.06 0.418 0.723 "64"
END
$view1_method1_default << END
106.99 1.917 2.609 "4"
END
# naive, dithered, 998 m: ms, error with noise, error noise-free, label
$view1_method2 << END
43.45 57.309 68.454 ""
79.21 45.715 56.273 ""
170.52 27.728 36.855 ""
300.60 16.094 23.134 ""
542.94 7.361 11.858 ""
1263.56 1.851 3.476 ""
2378.59 0.988 1.690 ""
4539.88 0.566 1.028 ""
END
# naive, plain, 998 m: ms, error with noise, error noise-free, label
$view1_method3 << END
50.79 34.855 46.548 ""
75.65 21.606 30.993 ""
157.96 9.515 15.311 ""
278.56 5.165 8.331 ""
500.12 4.332 6.413 ""
1158.50 4.050 5.722 ""
END
do for [format in 'svg png'] {
reset
if (format eq 'svg') {
  set terminal svg size 1200,660 font 'sans,13' background rgb 'white'
} else {
  set terminal pngcairo size 1200,660 font 'sans,11' background rgb 'white'
}
set output 'performance-innsbruck-26.'.format
set multiplot title 'innsbruck-26: error over frame time (low and left is good)' font ',15' noenhanced
set tmargin at screen 0.88
set bmargin at screen 0.2
unset key
set logscale xy
set xrange [5:7263.81]
set yrange [0.1:88.99]
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
    keyentry with lines lw 2 dt 1 lc rgb 'black' title '2498 m before the threshold', \
    keyentry with lines lw 2 dt 2 lc rgb 'black' title '998 m before the threshold', \
    keyentry with points pt 6 ps 1.8 lw 2 lc rgb 'black' title 'default sampling'
unset multiplot
set output
}
