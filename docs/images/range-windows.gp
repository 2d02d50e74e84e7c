# Point responses of docs/physics/range-response.md.
# gnuplot -e "output='range-windows.png'" docs/images/range-windows.gp
set terminal pngcairo size 960,480 font "sans,10"
set output output
dB(x) = x > 1e-9 ? 10 * log10(x) : NaN
s(x) = abs(x) < 1e-9 ? 1.0 : sin(pi * x) / (pi * x)
pair(x, m) = s(x - m) + s(x + m)
rect(x) = s(x)**2
hann(x) = (s(x) + 0.5 * pair(x, 1))**2
hamming(x) = (s(x) + 0.23 / 0.54 * pair(x, 1))**2
taylor(x) = (s(x) + 0.3418973 * pair(x, 1) - 0.0149965 * pair(x, 2) + 0.0037291 * pair(x, 3))**2
set samples 3001
set grid
set xlabel "range offset, bins of c / 2B"
set ylabel "power over the peak, dB"
set xrange [0:8]
set yrange [-70:2]
set title "Range response of a sweep's window"
plot dB(rect(x)) title "rectangular" lw 2, dB(hann(x)) title "hann" lw 2, \
     dB(hamming(x)) title "hamming" lw 2, dB(taylor(x)) title "taylor -35 dB, 4 lobes" lw 2
