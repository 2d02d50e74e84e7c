#include <cmath>

#include "core/constants.h"
#include "materials/rcs/rcs.h"
#include "tests/data_rows.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

using materials::RcsModel;

double peak_dBsm(const RcsModel& model, double frequency_GHz) {
  return 10.0 * std::log10(materials::rcs_m2(model, {1.0, 0.0, 0.0},
                                             core::kSpeedOfLight_mps / (frequency_GHz * 1e9)));
}

Section published_reflectors() {
  Section section{"Radar cross-section: published reflectors",
                  "ESA STEP forum, topic 14333: corner reflectors at 5.405 GHz",
                  "dBsm",
                  Section::Measure::difference,
                  0.01,
                  "two decimals are printed"};
  section.add("dihedral of 1.5 m x 1.5 m", peak_dBsm(materials::Dihedral{1.5, 1.5}, 5.405), 46.17);
  section.add("triangular trihedral of 2.5 m",
              peak_dBsm(materials::TriangularTrihedral{2.5}, 5.405), 47.26);
  return section;
}

RcsModel shape(const std::string& name) {
  if (name == "triangular_trihedral") return materials::TriangularTrihedral{0.1};
  if (name == "square_trihedral") return materials::SquareTrihedral{0.1};
  if (name == "dihedral") return materials::Dihedral{0.1, 0.1};
  if (name == "plate") return materials::RectangularPlate{0.1, 0.1};
  if (name == "sphere") return materials::Sphere{0.1};
  return materials::Cylinder{0.05, 1.0};
}

Section peaks() {
  Section section{"Radar cross-section: peaks of standard shapes",
                  "textbook closed forms (Knott, Shaeffer, Tuley), evaluated by another program",
                  "dBsm",
                  Section::Measure::difference,
                  6e-4,
                  "rounded to 0.001 dB"};
  for (const tests::DataRow& row : tests::data_rows("rcs_peaks.csv"))
    section.add(row.text("shape") + " at " + row.text("frequency_GHz") + " GHz",
                peak_dBsm(shape(row.text("shape")), row.number("frequency_GHz")),
                row.number("rcs_dBsm"));
  return section;
}

}  // namespace

std::vector<Section> target_sections() { return {published_reflectors(), peaks()}; }

}  // namespace fanbeam::validation
