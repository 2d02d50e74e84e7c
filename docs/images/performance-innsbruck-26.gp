# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-innsbruck-26.gp in this folder draws both pictures again.
# slices (number per column), 2498 m: ms, error with noise, error noise-free, label
$view0_method0 << END
14.79 6.033 8.369 "1"
23.55 3.149 4.573 ""
30.32 2.227 3.358 ""
38.62 1.639 2.428 ""
52.05 1.105 1.767 ""
72.77 0.930 1.543 ""
99.48 0.639 0.983 ""
123.72 0.473 0.747 "16"
151.24 0.335 0.586 ""
211.72 0.270 0.471 ""
402.60 0.188 0.386 "64"
END
$view0_method0_labels << END
14.79 6.033 8.369 "1"
123.72 0.473 0.747 "16"
402.60 0.188 0.386 "64"
END
$view0_method0_default << END
123.72 0.473 0.747 "16"
END
# rays (number per cell and column), 2498 m: ms, error with noise, error noise-free, label
$view0_method1 << END
16.84 6.588 8.859 "0.5"
24.20 4.178 5.682 ""
39.12 2.936 4.214 ""
51.22 1.772 2.554 "4"
79.11 1.351 2.062 ""
119.51 0.884 1.386 ""
191.02 0.606 0.997 ""
326.93 0.529 0.890 "64"
END
$view0_method1_labels << END
16.84 6.588 8.859 "0.5"
51.22 1.772 2.554 "4"
326.93 0.529 0.890 "64"
END
$view0_method1_default << END
51.22 1.772 2.554 "4"
END
# naive, dithered, 2498 m: ms, error with noise, error noise-free, label
$view0_method2 << END
28.42 40.495 58.754 ""
37.82 31.768 47.395 ""
83.63 18.159 28.528 ""
177.51 8.856 15.018 ""
338.06 2.985 5.539 ""
770.76 1.203 2.141 ""
1570.91 0.681 1.255 ""
3172.60 0.378 0.660 ""
END
# naive, plain, 2498 m: ms, error with noise, error noise-free, label
$view0_method3 << END
24.85 25.018 38.992 ""
42.99 14.928 24.256 ""
96.13 7.819 11.924 ""
183.78 6.948 9.901 ""
357.46 6.791 9.573 ""
879.80 6.724 9.411 ""
END
# slices (number per column), 998 m: ms, error with noise, error noise-free, label
$view1_method0 << END
13.84 4.656 6.826 "1"
22.15 2.413 3.623 ""
30.44 1.664 2.555 ""
35.77 1.302 1.902 ""
50.03 0.894 1.321 ""
68.27 0.676 1.036 ""
94.26 0.511 0.738 ""
123.56 0.410 0.602 "16"
173.58 0.289 0.443 ""
214.68 0.226 0.377 ""
444.40 0.148 0.283 "64"
END
$view1_method0_default << END
123.56 0.410 0.602 "16"
END
# rays (number per cell and column), 998 m: ms, error with noise, error noise-free, label
$view1_method1 << END
17.93 5.860 8.170 "0.5"
27.26 3.776 5.182 ""
36.42 2.756 3.934 ""
58.07 1.761 2.502 "4"
94.46 1.198 1.831 ""
144.65 0.833 1.394 ""
247.71 0.591 1.029 ""
427.98 0.502 0.928 "64"
END
$view1_method1_default << END
58.07 1.761 2.502 "4"
END
# naive, dithered, 998 m: ms, error with noise, error noise-free, label
$view1_method2 << END
26.22 59.551 72.757 ""
46.82 47.996 60.570 ""
93.72 29.496 40.274 ""
162.80 17.231 25.283 ""
311.34 7.743 12.691 ""
765.53 1.915 3.656 ""
1570.76 1.007 1.827 ""
2989.23 0.586 1.085 ""
END
# naive, plain, 998 m: ms, error with noise, error noise-free, label
$view1_method3 << END
21.63 36.104 49.623 ""
36.42 23.121 34.238 ""
86.38 10.589 17.806 ""
159.30 6.482 10.905 ""
299.91 5.701 8.809 ""
765.63 5.513 8.308 ""
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
set xrange [5:5076.15]
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
