// Antenna pattern cuts from files.
//
// MSI / Planet (.msi, .pln), text: keyword lines, of which GAIN counts ("12.5 dBi"; "dBd" or no
// unit: over a dipole, 2.15 dB more in dBi), then "HORIZONTAL n" and "VERTICAL n", each followed by
// n rows "angle attenuation": angles 0 <= a < 360 increasing, attenuation in dB, 0 or more
// (EDX / MSI Planet format as described by Radio Mobile, radiomobile.pe1mew.nl, page "MSI").
// Angles count from the antenna's axis: horizontal clockwise seen from above, so azimuth = angle;
// vertical from the horizon downwards, so elevation = -angle. 180 to 360 deg are -180 to 0 deg.
// CSV (.csv), text: header "angle_deg,gain_dB", then one row each: angles increasing within
// +-180 (azimuth to the right, elevation upwards, both from the boresight), gains relative to the
// peak. Lines that start with # are comments.
// Both are normalised to the cut's own peak, which must be stated as 0 within 0.5 dB.
//
// Limits: 4 MiB, 36001 rows a cut (E-LIMIT). Refused with file and line: no number E-PARSE, NaN and
// infinity E-NONFINITE, out of range or order E-RANGE, missing rows, rows behind those announced and a second
// GAIN that is another one E-PARSE; all bad rows together.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/errors.h"

namespace fanbeam::sensors {

enum class PatternPlane { azimuth, elevation };

// Angles in the sensor's sense (right, up) from the boresight, increasing; one-way power gain
// relative to the peak, linear.
struct PatternCut {
  std::vector<double> angle_rad;
  std::vector<double> gain;
  std::optional<double> peak_gain;  // linear over isotropic, as the file's GAIN says
};

// All problems go to `problems`; the cut is usable only when none of them is new.
PatternCut read_pattern_cut(const std::filesystem::path& file, PatternPlane plane,
                            core::ProblemList& problems);

}  // namespace fanbeam::sensors
