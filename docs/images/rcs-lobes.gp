# Lobes of standard shapes at 35 GHz from the formulas of docs/physics/rcs-shapes.md.
# gnuplot -e "output='rcs-lobes.png'" docs/images/rcs-lobes.gp
set terminal pngcairo size 960,520 font "sans,10"
set output output
lambda = 299792458.0 / 35e9
k = 2 * pi / lambda
rad(x) = x * pi / 180
sinc2(x) = abs(x) < 1e-8 ? 1.0 : (sin(x) / x)**2
dB(x) = x > 1e-12 ? 10 * log10(x) : NaN
plate(w, h, a) = abs(a) < 90 ? 4*pi*(w*h)**2/lambda**2 * cos(rad(a))**2 * sinc2(k*w*sin(rad(a))) : 0
dihedral(w, h, a) = abs(a) < 45 ? 16*pi*(w*h)**2/lambda**2 * sin(pi/4 - abs(rad(a)))**2 : 0
cylinder(r, L, a) = 2*pi*r*L**2/lambda * cos(rad(a)) * sinc2(k*L*sin(rad(a)))
# Cosines to the edges, turned sideways about the axis' perpendicular.
l0(a) = cos(rad(a))/sqrt(3)
lp(a) = l0(a) + sin(rad(a))/sqrt(2)
lm(a) = l0(a) - sin(rad(a))/sqrt(2)
# Sideways by a: cosines lm <= l0 <= lp for a > 0.
tri(a) = lm(abs(a)) <= 0 ? 0 : (lm(abs(a))+l0(a) <= lp(abs(a)) ? 4*lm(abs(a))*l0(a)/(lm(abs(a))+l0(a)+lp(abs(a))) : (lm(abs(a))+l0(a)+lp(abs(a))) - 2/(lm(abs(a))+l0(a)+lp(abs(a))))
sq(a) = lm(abs(a)) <= 0 ? 0 : (lp(abs(a)) >= 2*l0(a) ? 4*lm(abs(a))*l0(a)/lp(abs(a)) : lm(abs(a))*(4 - lp(abs(a))/l0(a)))
corner(area, edge) = 4*pi*(area*edge**2)**2/lambda**2
set samples 1201
set grid
set xlabel "degrees off the axis"
set ylabel "radar cross-section, dBsm"
set xrange [-45:45]
set yrange [-30:30]
set key outside right
set title "Shapes of 0.1 m at 35 GHz (cylinder: r = 5 mm, L = 0.1 m)"
plot dB(corner(sq(x), 0.1)) title "square trihedral" lw 2, \
     dB(corner(tri(x), 0.1)) title "triangular trihedral" lw 2, \
     dB(dihedral(0.1, 0.1, x)) title "dihedral, across the crease" lw 2, \
     dB(plate(0.1, 0.1, x)) title "plate" lw 1, \
     dB(cylinder(0.005, 0.1, x)) title "cylinder, off broadside" lw 1, \
     dB(pi*0.1**2) title "sphere" lw 2 dt 2
