# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-innsbruck-26.gp in this folder draws both pictures again.
# slices (number per column), 2498 m: ms, error with noise, error noise-free, label
$view0_method0 << END
8.10 5.635 7.985 "1"
12.60 2.880 4.312 ""
17.40 1.999 3.141 ""
21.91 1.427 2.197 ""
30.06 0.942 1.595 ""
39.08 0.809 1.409 "8"
53.76 0.546 0.845 ""
69.75 0.395 0.636 ""
99.43 0.312 0.570 ""
126.09 0.223 0.414 ""
243.30 0.141 0.254 "64"
END
$view0_method0_labels << END
8.10 5.635 7.985 "1"
39.08 0.809 1.409 "8"
243.30 0.141 0.254 "64"
END
$view0_method0_default << END
39.08 0.809 1.409 "8"
END
# rays (number per cell and column), 2498 m: ms, error with noise, error noise-free, label
$view0_method1 << END
11.39 6.016 8.350 "0.5"
15.78 3.542 5.056 ""
22.50 2.691 3.881 ""
33.36 1.551 2.369 "4"
44.63 1.109 1.730 ""
71.07 0.726 1.180 ""
116.68 0.465 0.770 ""
193.62 0.340 0.601 "64"
END
$view0_method1_labels << END
11.39 6.016 8.350 "0.5"
33.36 1.551 2.369 "4"
193.62 0.340 0.601 "64"
END
$view0_method1_default << END
33.36 1.551 2.369 "4"
END
# naive, dithered, 2498 m: ms, error with noise, error noise-free, label
$view0_method2 << END
19.03 40.347 58.597 ""
32.57 31.792 47.315 ""
68.51 18.305 28.634 ""
135.39 8.892 15.115 ""
258.02 3.021 5.610 ""
606.43 1.226 2.220 ""
1198.08 0.660 1.183 ""
END
# naive, plain, 2498 m: ms, error with noise, error noise-free, label
$view0_method3 << END
17.70 25.353 39.452 ""
29.03 15.105 24.511 ""
61.60 7.721 11.740 ""
113.57 6.964 9.934 ""
222.19 6.776 9.541 ""
533.80 6.725 9.409 ""
END
# slices (number per column), 998 m: ms, error with noise, error noise-free, label
$view1_method0 << END
7.56 4.279 6.307 "1"
11.66 2.098 3.190 ""
16.53 1.387 2.252 ""
20.65 1.043 1.583 ""
28.80 0.710 1.080 ""
36.58 0.471 0.770 "8"
50.77 0.379 0.592 ""
62.49 0.289 0.455 ""
89.37 0.205 0.356 ""
122.29 0.158 0.286 ""
230.97 0.121 0.263 "64"
END
$view1_method0_default << END
36.58 0.471 0.770 "8"
END
# rays (number per cell and column), 998 m: ms, error with noise, error noise-free, label
$view1_method1 << END
9.97 5.437 7.686 "0.5"
14.44 3.130 4.408 ""
20.52 2.412 3.500 ""
30.79 1.385 2.072 "4"
42.32 0.971 1.517 ""
66.72 0.631 1.109 ""
109.79 0.408 0.746 ""
185.35 0.324 0.660 "64"
END
$view1_method1_default << END
30.79 1.385 2.072 "4"
END
# naive, dithered, 998 m: ms, error with noise, error noise-free, label
$view1_method2 << END
16.05 59.557 72.768 ""
27.14 47.917 60.527 ""
58.72 29.411 40.095 ""
110.43 17.109 25.048 ""
209.68 7.693 12.526 ""
533.26 1.930 3.716 ""
1028.63 1.023 1.793 ""
2033.98 0.580 1.088 ""
END
# naive, plain, 998 m: ms, error with noise, error noise-free, label
$view1_method3 << END
14.78 36.737 50.301 ""
24.72 23.337 34.522 ""
53.26 10.628 17.815 ""
101.25 6.457 10.868 ""
186.98 5.727 8.910 ""
449.68 5.520 8.290 ""
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
set xrange [1:3254.36]
set yrange [0.1:94.5986]
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
