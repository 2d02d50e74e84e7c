// Gusts of the Dryden form, as an aircraft near the ground meets them.
//
// Source: MIL-F-8785C, "Flying qualities of piloted airplanes" (1980), 3.7.2 (spectra) and 3.7.3.4
// (lengths and intensities at low altitude); all in feet there, metres here.
//   along    Phi_u = sigma_u^2 2 L_u / (pi V) / (1 + x^2)
//   across   Phi_v = sigma_v^2 L_v / (pi V) (1 + 3 x^2) / (1 + x^2)^2,  x = L w / V;  Phi_w
//   likewise
// one-sided in angular frequency w, integral sigma^2. The noise is that of a filter with this power
// spectrum, discretised exactly: variance and correlation at multiples of the step are those of the
// continuous process for any step. Neglected: gusts of rotation (p_g, q_g, r_g), the correlation of
// u with w, single gusts and wind shear.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace fanbeam::scenes {

// Axes: u along the flight, v to the right, w down.
struct DrydenScales {
  glm::dvec3 length_m{0.0};
  glm::dvec3 deviation_mps{0.0};
};

// `height_m` above ground, taken as 10 ft below that. Up to 1000 ft
//   L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2,
//   sigma_w = 0.1 W20, sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4   (h in feet)
// with W20 the wind 20 ft above ground (15 kt light, 30 kt moderate, 45 kt severe). Above, the
// lengths grow linearly to 1750 ft at 2000 ft as the standard says, and the deviations keep their
// value at 1000 ft (the standard's decrease with height is neglected).
// Throws InputError E-RANGE or E-NONFINITE: height -1000 to 20000 m, wind 0 to 60 m/s.
DrydenScales dryden_scales(double height_m, double wind_at_20ft_mps);

// One realisation; depends on the seed and the arguments of the calls only.
class DrydenGusts {
 public:
  // Throws InputError E-RANGE or E-NONFINITE: step 1e-4 to 1 s.
  DrydenGusts(std::uint64_t seed, double step_s);

  // The gust (m/s, as DrydenScales) at the next step; the first is already in steady state. Scales
  // and airspeed may change slowly from step to step. Throws as above: airspeed 1 to 500 m/s.
  glm::dvec3 next(const DrydenScales& scales, double airspeed_mps);

 private:
  std::uint64_t seed_;
  double step_s_;
  std::uint64_t steps_ = 0;
  double along_ = 0.0;                             // of unit variance
  std::array<std::array<double, 2>, 2> across_{};  // two filter states for v and for w
};

}  // namespace fanbeam::scenes
