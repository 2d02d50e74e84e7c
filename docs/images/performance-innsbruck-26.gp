# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-innsbruck-26.gp in this folder draws both pictures again.
# slices (number per column), 2498 m: ms, error with noise, error noise-free, label
$view0_method0 << END
12.07 6.033 8.369 "1"
18.54 3.149 4.573 ""
24.75 2.227 3.358 ""
36.49 1.639 2.428 ""
54.35 1.105 1.767 ""
73.69 0.930 1.544 "8"
82.44 0.639 0.983 ""
117.02 0.473 0.748 ""
157.57 0.336 0.587 ""
221.65 0.270 0.472 ""
389.12 0.188 0.387 "64"
END
$view0_method0_labels << END
12.07 6.033 8.369 "1"
73.69 0.930 1.544 "8"
389.12 0.188 0.387 "64"
END
$view0_method0_default << END
73.69 0.930 1.544 "8"
END
# rays (number per cell and column), 2498 m: ms, error with noise, error noise-free, label
$view0_method1 << END
15.94 6.590 8.864 "0.5"
31.38 4.178 5.681 ""
47.54 2.937 4.212 ""
72.15 1.773 2.558 "4"
105.63 1.352 2.067 ""
170.67 0.885 1.393 ""
289.53 0.606 0.984 ""
504.12 0.528 0.875 "64"
END
$view0_method1_labels << END
15.94 6.590 8.864 "0.5"
72.15 1.773 2.558 "4"
504.12 0.528 0.875 "64"
END
$view0_method1_default << END
72.15 1.773 2.558 "4"
END
# naive, dithered, 2498 m: ms, error with noise, error noise-free, label
$view0_method2 << END
27.36 40.495 58.754 ""
37.71 31.768 47.395 ""
108.89 18.159 28.528 ""
176.34 8.856 15.018 ""
333.12 2.985 5.540 ""
790.22 1.203 2.143 ""
1763.43 0.680 1.256 ""
3149.11 0.378 0.661 ""
END
# naive, plain, 2498 m: ms, error with noise, error noise-free, label
$view0_method3 << END
24.36 25.336 39.447 ""
42.37 14.927 24.207 ""
78.00 7.733 11.778 ""
161.50 6.973 9.968 ""
323.76 6.775 9.523 ""
705.74 6.722 9.405 ""
END
# slices (number per column), 998 m: ms, error with noise, error noise-free, label
$view1_method0 << END
13.31 4.656 6.826 "1"
20.55 2.413 3.623 ""
29.10 1.664 2.555 ""
29.83 1.302 1.902 ""
52.85 0.894 1.321 ""
59.13 0.676 1.036 "8"
97.73 0.511 0.738 ""
128.88 0.410 0.602 ""
156.72 0.289 0.443 ""
229.02 0.226 0.377 ""
407.49 0.148 0.283 "64"
END
$view1_method0_default << END
59.13 0.676 1.036 "8"
END
# rays (number per cell and column), 998 m: ms, error with noise, error noise-free, label
$view1_method1 << END
19.58 5.860 8.170 "0.5"
28.62 3.776 5.182 ""
44.06 2.756 3.933 ""
71.50 1.761 2.502 "4"
95.96 1.198 1.831 ""
160.22 0.833 1.394 ""
249.14 0.591 1.029 ""
440.61 0.502 0.928 "64"
END
$view1_method1_default << END
71.50 1.761 2.502 "4"
END
# naive, dithered, 998 m: ms, error with noise, error noise-free, label
$view1_method2 << END
22.72 59.551 72.757 ""
38.20 47.996 60.570 ""
83.81 29.496 40.274 ""
162.48 17.231 25.283 ""
329.51 7.743 12.691 ""
771.25 1.915 3.656 ""
1598.56 1.007 1.827 ""
3055.86 0.586 1.085 ""
END
# naive, plain, 998 m: ms, error with noise, error noise-free, label
$view1_method3 << END
19.87 36.545 50.122 ""
33.06 23.391 34.603 ""
75.89 10.654 17.815 ""
149.99 6.453 10.952 ""
345.63 5.700 8.807 ""
742.62 5.514 8.292 ""
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
set xrange [5:5038.57]
set yrange [0.1:94.5835]
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
