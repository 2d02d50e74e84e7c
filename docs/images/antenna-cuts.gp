# Cuts of docs/physics/antenna.md, one-way, 10 deg wide, peak 4 deg below the horizon.
# gnuplot -e "output='antenna-cuts.png'" docs/images/antenna-cuts.gp
set terminal pngcairo size 960,480 font "sans,10"
set output output
rad(x) = x * pi / 180
dB(x) = x > 1e-7 ? 10 * log10(x) : NaN
w = 10.0
peak = 4.0
gauss(d) = exp(-4 * log(2) * ((d - peak) / w)**2)
u(d, half) = half * sin(rad(d - peak)) / sin(rad(w / 2))
sinc(x) = abs(x) < 1e-9 ? 1.0 : sin(pi * x) / (pi * x)
sinc2(d) = sinc(u(d, 0.442947))**2
cosine(d) = (pi / 4 * (sinc(u(d, 0.594482) - 0.5) + sinc(u(d, 0.594482) + 0.5)))**2
csc2(d) = d <= 9 ? gauss(d) : gauss(9) * (sin(rad(9)) / sin(rad(d)))**2
set samples 1501
set grid
set xlabel "depression below the horizon, degrees"
set ylabel "one-way gain over the peak, dB"
set xrange [-30:60]
set yrange [-45:2]
set key outside bottom center horizontal height 1
set title "Elevation cuts of 10 deg"
plot dB(gauss(x)) title "gaussian" lw 2, \
     dB(sinc2(x)) title "sinc-squared" lw 1, \
     dB(cosine(x)) title "cosine aperture" lw 1, \
     dB(csc2(x)) title "cosecant-squared from 9 deg" lw 3 dt 2, \
     (x < -12 || x > 20 ? -35 : NaN) title "side-lobe level -35 dB beyond a cut of 16 deg" lw 2 dt 3
