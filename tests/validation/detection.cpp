#include "sensors/receiver/detection.h"

#include <cmath>

#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

double required_dB(core::Swerling target, double probability, double false_alarms, int looks) {
  return 10.0 * std::log10(sensors::required_snr(target, probability, false_alarms, looks));
}

Section required_snr() {
  Section section{
      "Detection: signal-to-noise ratio for one look",
      "M. I. Skolnik, Introduction to Radar Systems, 3rd ed. 2001, figure 2.6 and table "
      "2.3 (steady target); closed form ln Pfa / ln Pd - 1 (Swerling 1)",
      "dB",
      Section::Measure::difference,
      0.06,
      "read from a figure to 0.1 dB"};
  using core::Swerling;
  section.add("steady, Pd 0.9, Pfa 1e-6", required_dB(Swerling::steady, 0.9, 1e-6, 1), 13.2);
  section.add("steady, Pd 0.5, Pfa 1e-6", required_dB(Swerling::steady, 0.5, 1e-6, 1), 11.2);
  section.add("Swerling 1, Pd 0.9, Pfa 1e-6", required_dB(Swerling::case1, 0.9, 1e-6, 1), 21.14);
  section.add("Swerling 1, Pd 0.5, Pfa 1e-6", required_dB(Swerling::case1, 0.5, 1e-6, 1), 12.77);
  return section;
}

// Albersheim, Proc. IEEE 69 (1981): published to hold within 0.2 dB.
double albersheim_dB(double probability, double false_alarms, int looks) {
  const double a = std::log(0.62 / false_alarms);
  const double b = std::log(probability / (1.0 - probability));
  const double n = looks;
  return -5.0 * std::log10(n) +
         (6.2 + 4.54 / std::sqrt(n + 0.44)) * std::log10(a + 0.12 * a * b + 1.7 * b);
}

Section against_albersheim() {
  Section section{
      "Detection: several looks, steady target",
      "Albersheim's equation, Proc. IEEE 69 (1981) 839, as in Richards, Fundamentals of "
      "Radar Signal Processing, 2nd ed., section 6.3",
      "dB",
      Section::Measure::difference,
      0.4,
      "the equation is stated to 0.2 dB for a linear detector; ours is square-law, up "
      "to 0.2 dB apart"};
  for (const int looks : {1, 4, 16, 64})
    for (const double probability : {0.5, 0.9})
      for (const double false_alarms : {1e-4, 1e-6})
        section.add(std::to_string(looks) + " looks, Pd " + (probability > 0.6 ? "0.9" : "0.5") +
                        ", Pfa " + (false_alarms > 1e-5 ? "1e-4" : "1e-6"),
                    required_dB(core::Swerling::steady, probability, false_alarms, looks),
                    albersheim_dB(probability, false_alarms, looks));
  return section;
}

}  // namespace

std::vector<Section> detection_sections() { return {required_snr(), against_albersheim()}; }

}  // namespace fanbeam::validation
