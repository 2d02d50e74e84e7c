// Pictures that show nothing, told by fanbeam doctor.
//
// The middle frame of the flight is rendered as fanbeam render does by default, expected power
// without realisation, and looked at as B-scope and C-scope. A picture shows nothing when all but
// one in kShowing of its pixels are
//   within kContrast_grey of what the display shows without any echo: noise alone, or black, or
//   within kContrast_grey of one grey, be it black, white or between.
// What to change follows from levels in dB: of the noise, and of the strongest pixel.
#pragma once

#include "scenes/doctor/finding.h"
#include "scenes/scene.h"

namespace fanbeam::session {

inline constexpr double kContrast_grey = 10.0;  // 4 % of the display
inline constexpr std::size_t kShowing = 10'000;

// Adds "blank-picture" for each picture that shows nothing, behind what is as bad. A frame with its
// antenna in the ground, or a C-scope of flat ground without any below, is left to the check of that.
void add_blank_pictures(const scenes::Scene& scene, scenes::Findings& findings);

}  // namespace fanbeam::session
