# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-innsbruck-26.gp in this folder draws both pictures again.
# slices (number per column), 2498 m: ms, error with noise, error noise-free, label
$view0_method0 << END
10.04 2.208 3.297 "1"
13.77 0.890 1.409 ""
17.65 0.529 0.892 ""
21.54 0.376 0.605 ""
29.60 0.235 0.379 ""
37.96 0.180 0.318 "8"
50.53 0.180 0.275 ""
64.60 0.149 0.252 ""
90.94 0.138 0.210 ""
115.02 0.119 0.190 ""
215.45 0.104 0.176 "64"
END
$view0_method0_labels << END
10.04 2.208 3.297 "1"
37.96 0.180 0.318 "8"
215.45 0.104 0.176 "64"
END
$view0_method0_default << END
37.96 0.180 0.318 "8"
END
# rays (number per cell and column), 2498 m: ms, error with noise, error noise-free, label
$view0_method1 << END
10.20 6.016 8.350 "0.5"
14.26 3.542 5.056 ""
20.39 2.691 3.881 ""
30.24 1.551 2.369 "4"
41.37 1.109 1.730 ""
64.62 0.726 1.180 ""
104.19 0.465 0.770 ""
174.85 0.340 0.601 "64"
END
$view0_method1_labels << END
10.20 6.016 8.350 "0.5"
30.24 1.551 2.369 "4"
174.85 0.340 0.601 "64"
END
$view0_method1_default << END
30.24 1.551 2.369 "4"
END
# naive, dithered, 2498 m: ms, error with noise, error noise-free, label
$view0_method2 << END
18.22 40.347 58.597 ""
30.15 31.792 47.315 ""
65.72 18.305 28.634 ""
121.45 8.892 15.115 ""
230.15 3.021 5.610 ""
554.01 1.226 2.220 ""
1091.80 0.660 1.183 ""
END
# naive, plain, 2498 m: ms, error with noise, error noise-free, label
$view0_method3 << END
16.69 25.353 39.452 ""
27.27 15.105 24.511 ""
57.77 7.721 11.740 ""
107.69 6.964 9.934 ""
202.59 6.776 9.541 ""
503.24 6.725 9.409 ""
END
# slices (number per column), 998 m: ms, error with noise, error noise-free, label
$view1_method0 << END
8.20 2.013 2.813 "1"
12.20 0.760 1.132 ""
16.55 0.462 0.742 ""
20.65 0.317 0.485 ""
28.37 0.209 0.381 ""
36.48 0.158 0.271 "8"
49.52 0.162 0.326 ""
64.25 0.130 0.237 ""
91.12 0.123 0.236 ""
118.52 0.103 0.206 ""
223.27 0.096 0.218 "64"
END
$view1_method0_default << END
36.48 0.158 0.271 "8"
END
# rays (number per cell and column), 998 m: ms, error with noise, error noise-free, label
$view1_method1 << END
9.05 5.437 7.686 "0.5"
14.97 3.130 4.408 ""
18.66 2.412 3.500 ""
28.92 1.385 2.072 "4"
38.89 0.971 1.517 ""
61.04 0.631 1.109 ""
99.90 0.408 0.746 ""
165.25 0.324 0.660 "64"
END
$view1_method1_default << END
28.92 1.385 2.072 "4"
END
# naive, dithered, 998 m: ms, error with noise, error noise-free, label
$view1_method2 << END
16.45 59.557 72.768 ""
27.88 47.917 60.527 ""
59.17 29.411 40.095 ""
110.69 17.109 25.048 ""
209.69 7.693 12.526 ""
544.62 1.930 3.716 ""
999.12 1.023 1.793 ""
1999.09 0.580 1.088 ""
END
# naive, plain, 998 m: ms, error with noise, error noise-free, label
$view1_method3 << END
14.85 36.737 50.301 ""
24.69 23.337 34.522 ""
52.42 10.628 17.815 ""
97.96 6.457 10.868 ""
190.68 5.727 8.910 ""
458.66 5.520 8.290 ""
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
set xrange [1:3198.54]
set yrange [0.01:94.5986]
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
