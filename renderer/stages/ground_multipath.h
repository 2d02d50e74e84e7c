// Point targets seen directly and by way of the ground under the path.
//
// With the one-way amplitude of the mirrored path over the direct one
//     a = Gamma sqrt(g(e_r) / g(e_d)) (R / R') e^(-j k d),   d = R' - R = 4 h1 h2 / (R' + R)
// the echo of a target has three parts, at the ranges R, R + d / 2 and R + d:
//     direct 1, there or back by the ground 2 a (two equal paths), both by the ground a^2.
// coherent: parts in one range cell add as amplitudes, |(1 + a)^2|^2 when all three share it (the
//           propagation factor F^4); parts in different cells do not interfere
// mean:     powers 1, 4 |a|^2 and |a|^4, the mean over an unknown phase
// A phase wants d within a wavelength's tenth, heights within millimetres: files know them to
// centimetres. Expected power therefore uses the mean; a realisation of speckle the coherent form.
//
// g: with side lobes.
// h1, h2: heights of antenna and target over the tangent plane of the ground at the reflection,
// found by iteration (8 steps at most) on planes through the ground's heights two posts apart;
// R' the distance to the target's image. Gamma of the material there, polarisation as over level
// ground, |Gamma|^2 at most what the ground does not scatter (renderer/surfaces/mirrors.h).
// Sources: M. A. Richards et al., Principles of Modern Radar I (2010), section 4.9; M. I. Skolnik, Radar Handbook, 3rd ed. (2008), chapter 26 [recalled].
// Inputs: a target seen directly. A blocked leg of the mirrored path leaves the direct echo alone.
// Neglected: divergence by the Earth's curvature and by hills, more than one reflection point,
// diffuse reflection, loss in air over d, a change of RCS between the two directions, targets seen
// by the ground alone. Accuracy: d to 1e-12 relative; closed forms on flat ground in the tests.
// Cost: 1 microsecond a target, two shadow rays included.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "core/echo.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

enum class Multipath { none, mean, coherent };

struct GroundPath {
  std::complex<double> amplitude;  // a, without its phase of path length
  double longer_m = 0.0;           // d
  double elevation_rad = 0.0;      // e_r
};

// Nothing without reflecting ground, or when a leg is blocked.
std::optional<GroundPath> ground_path(const World& world, const sensors::AntennaFrame& antenna,
                                      const glm::dvec3& target_m);

// Appends the target's echoes, one for each range cell that its parts fall into; the first is in
// the cell of `direct`. With Multipath::none `direct` alone.
void add_with_ground(const World& world, const sensors::AntennaFrame& antenna,
                     const glm::dvec3& target_m, const core::Echo& direct, Multipath multipath,
                     std::vector<core::Echo>& echoes);

}  // namespace fanbeam::renderer
