# Figures and pictures were written with docs/performance.md by fanbeam_bench.
# gnuplot performance-braunschweig-26.gp in this folder draws both pictures again.
# slices (number per column), 2499 m: ms, error with noise, error noise-free, label
$view0_method0 << END
12.70 1.871 2.457 "1"
19.89 0.865 1.178 ""
26.01 0.537 0.744 ""
31.35 0.381 0.551 "4"
43.90 0.244 0.354 ""
53.99 0.172 0.249 ""
82.85 0.145 0.214 ""
94.11 0.104 0.135 ""
132.89 0.085 0.109 ""
174.13 0.082 0.103 ""
324.51 0.067 0.087 "64"
END
$view0_method0_labels << END
12.70 1.871 2.457 "1"
31.35 0.381 0.551 "4"
324.51 0.067 0.087 "64"
END
$view0_method0_default << END
31.35 0.381 0.551 "4"
END
# rays (number per cell and column), 2499 m: ms, error with noise, error noise-free, label
$view0_method1 << END
13.71 3.175 4.092 "0.5"
18.62 2.126 2.663 ""
25.64 1.625 2.058 ""
37.18 1.008 1.261 "4"
53.01 0.719 0.917 ""
100.85 0.458 0.615 ""
137.27 0.292 0.381 ""
246.22 0.202 0.283 "64"
END
$view0_method1_labels << END
13.71 3.175 4.092 "0.5"
37.18 1.008 1.261 "4"
246.22 0.202 0.283 "64"
END
$view0_method1_default << END
37.18 1.008 1.261 "4"
END
# naive, dithered, 2499 m: ms, error with noise, error noise-free, label
$view0_method2 << END
22.87 62.472 81.794 ""
41.07 49.847 68.908 ""
85.38 28.450 45.620 ""
157.80 16.417 28.163 ""
284.65 3.278 5.078 ""
670.50 1.093 1.303 ""
1280.40 0.498 0.604 ""
END
# naive, plain, 2499 m: ms, error with noise, error noise-free, label
$view0_method3 << END
21.68 33.736 52.284 ""
36.14 21.000 35.171 ""
72.40 4.305 6.109 ""
130.37 2.681 3.385 ""
244.37 2.290 2.875 ""
598.73 2.176 2.737 ""
END
# slices (number per column), 1001 m: ms, error with noise, error noise-free, label
$view1_method0 << END
15.39 1.536 2.049 "1"
25.34 0.896 1.090 ""
32.43 0.495 0.644 ""
39.12 0.396 0.543 "4"
60.04 0.227 0.366 ""
69.60 0.199 0.282 ""
91.82 0.168 0.253 ""
117.67 0.123 0.190 ""
167.43 0.080 0.119 ""
217.46 0.063 0.092 ""
420.19 0.070 0.094 "64"
END
$view1_method0_default << END
39.12 0.396 0.543 "4"
END
# rays (number per cell and column), 1001 m: ms, error with noise, error noise-free, label
$view1_method1 << END
15.86 2.908 3.738 "0.5"
23.00 1.908 2.474 ""
32.55 1.290 1.679 ""
45.75 0.898 1.161 "4"
65.02 0.543 0.705 ""
104.55 0.347 0.464 ""
180.00 0.209 0.282 ""
346.24 0.146 0.202 "64"
END
$view1_method1_default << END
45.75 0.898 1.161 "4"
END
# naive, dithered, 1001 m: ms, error with noise, error noise-free, label
$view1_method2 << END
24.94 63.319 80.989 ""
44.19 54.549 73.057 ""
88.26 41.051 59.537 ""
166.76 27.101 43.376 ""
310.65 12.714 22.864 ""
762.57 1.804 2.427 ""
1455.86 0.800 1.059 ""
END
# naive, plain, 1001 m: ms, error with noise, error noise-free, label
$view1_method3 << END
27.27 45.140 64.045 ""
41.57 32.657 50.075 ""
81.11 13.291 23.820 ""
146.94 4.087 6.858 ""
284.19 2.123 2.796 ""
693.83 1.649 2.091 ""
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
set xrange [5:2329.37]
set yrange [0.01:106.333]
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
