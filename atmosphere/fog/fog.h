// Specific attenuation of fog, one way: gamma = K M, M the liquid water content in g/m3.
// All three laws are Rayleigh absorption by drops far smaller than the wavelength (under 0.1 mm).
//
// itu-p840 (default): Recommendation ITU-R P.840-8, Annex 1 (liquid-water coefficient unchanged in
// P.840-9): K_l = 0.819 f / (eps'' (1 + eta^2)) with a double-Debye permittivity of water. 1 to
// 200 GHz; -40 C (below, drops freeze) to 50 C. The coefficient halves from 0 C to 25 C at 35 GHz.
//
// altshuler: E. Altshuler 1984 (IEEE Trans. AP 32, 757), K = -1.347 + 0.0372 L + 18.0/L - 0.022 T,
// L the wavelength in mm, T in C. Published for 3 to 30 mm and -8 to 25 C; accepted from 3 to
// 10 mm only, where it is positive everywhere and, at 3 to 8.6 mm, within 19 % of P.840 (35 % at
// 10 mm and 25 C). Above about 12 mm it turns negative in warm air.
//
// centimetre: K = 0.438 / L^2, L in cm, accepted from 2 to 10 cm. It knows no temperature:
// against P.840 it is 1.5 % high at 25 C, 13 % low at 18 C and almost 50 % low at 0 C.
//
// Ranges of wavelength hold for c = 3e8 m/s and for the true c, 0.07 % apart: 2 to 10 cm are 3 to
// 15 GHz and 2.998 to 14.990 GHz, and all of both is accepted.
#pragma once

#include <string_view>

namespace fanbeam::atmosphere {

enum class FogLaw { itu_p840, altshuler, centimetre };

// "itu-p840", "altshuler", "centimetre". Throws InputError E-REF for any other name.
FogLaw fog_law_named(std::string_view name);
std::string_view name_of(FogLaw law);

inline constexpr double kLargestLiquidWater_g_per_m3 = 20.0;

// K in (dB/km)/(g/m3). Ranges as above. Throws InputError: E-RANGE, E-NONFINITE.
double fog_coefficient(FogLaw law, double frequency_Hz, double temperature_C);

// Liquid water 0 to 20 g/m3 (fog rarely holds more than 1); exactly 0 dB/km at 0 g/m3.
// Throws InputError: E-RANGE, E-NONFINITE.
double fog_attenuation_dB_per_km(FogLaw law, double liquid_water_g_per_m3, double frequency_Hz,
                                 double temperature_C);

}  // namespace fanbeam::atmosphere
