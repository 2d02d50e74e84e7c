// Radar cross-section of a straight round conductor of any thickness: hair-thin wires, cables,
// poles.
//
//   sigma = 4 L^2 / pi |T cos^2(p) - V sin^2(p)|^2 sinc^2(k L sin e),    x = k a cos e
//   T = sum J_n(x) / H_n(x),  V = sum J_n'(x) / H_n'(x),    each with weights e_n (-1)^n, e_0 = 1,
//   e_n = 2, H_n the Hankel function of the second kind
// e is the angle off broadside, p that between the electric field and the plane of wire and line of
// sight: 0 parallel, 90 deg perpendicular to the wire. T and V are the exact backscatter of an
// endless cylinder for the two (Balanis, Advanced Engineering Electromagnetics, 2nd ed., 11.5;
// Ruck, Radar Cross Section Handbook, 1970, chapter 4), cut to the length L as by physical optics.
//
// Two textbook forms are its limits:
//   thick  T = -V = sqrt(pi x / 4): sigma = 2 pi a L^2 / lambda cos e sinc^2, whatever p. The exact
//          value is within 0.1 dB (T) and 0.55 dB (V) from ka = 5, 0.005 dB from 50, where the
//          series is left
//   thin   |T|^2 = (pi/2)^2 / ((pi/2)^2 + ln^2(lambda / (1.781 pi a cos e))), V = 0: Chu's wire
//          (Ruck, chapter 4; Skolnik, Radar Handbook), up to his cos^2(e); within 0.1 dB below
//          ka = 0.06, but 1.3 dB too strong at ka = 0.5 and useless above 1
// A 20 mm wire (diameter) has ka = 7.3 at 35 GHz: it is a thick cylinder and no thin wire.
//
// Input: radius, length, wavelength in m, above 0; sine of e from -1 to 1; p in rad.
// Neglected: the ends and waves travelling along the wire (they decide the levels far off
// broadside, below the side lobes), strands (Bragg lobes at the pitch of the lay), insulation, sag:
// straight over L, which must be far away as 2 L^2 / lambda. A real wire: see `coherence` in
// docs/physics/thin-objects.md.
// Accuracy: 1e-13 against the sums in extended precision, ka 0.01 to 50. Cost: x + 4 x^(1/3) + 10
// terms, 2 to 13 microseconds.
#pragma once

namespace fanbeam::materials {

double round_wire_rcs_m2(double radius_m, double length_m, double polarisation_rad,
                         double sin_off_broadside, double wavelength_m);

// Upper bound over all e, from the largest |T| and |V| up to x of broadside: off it T and V may cancel less
// than at broadside, and |V| ripples with x. Exact along the field and for thick wires, but for 2 % of margin.
double largest_round_wire_rcs_m2(double radius_m, double length_m, double polarisation_rad,
                                 double wavelength_m);

}  // namespace fanbeam::materials
