#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/display/seed_signal.h"
#include "sensors/sensor_file.h"
#include "tests/validation/report.h"

namespace fanbeam::validation {
namespace {

sensors::Sensor shipped(const std::string& name) {
  core::ProblemList problems;
  sensors::Sensor sensor = sensors::read_sensor(
      std::string(FANBEAM_SOURCE_DIR) + "/sensors/" + name + ".toml", problems);
  problems.throw_if_errors();
  return sensor;
}

Section seed_table() {
  Section section{"Sensor: the published table to the letter",
                  "Devendran, Kashyap, Rama Murthy, Modeling specifications for HiVision "
                  "Millimeter Wave Radar, Table 2 and its formulas, evaluated by hand with c = 3e8",
                  "",
                  Section::Measure::relative,
                  1e-7,
                  "eight digits"};
  const sensors::Sensor seed = shipped("hivision-seed");
  const sensors::SignalLimits signal = sensors::seed_signal_limits(seed);
  section.add("wavelength in m", seed.seed.speed_of_light_mps / seed.waveform.frequency_Hz,
              8.571428571e-3);
  section.add("gain", seed.antenna.peak_gain, 1805.555556);
  section.add("constant power", signal.constant_power_W_m3, 0.13289873);
  section.add("minimum signal in W", signal.minimum_W, 2.6237090e-12);
  section.add("maximum signal in W", signal.maximum_W, 1.6612341e-8);
  return section;
}

Section hivision() {
  Section section{"Sensor: derived figures of HiVision",
                  "closed forms: a two-way Gaussian beam is sqrt(pi / (8 ln 2)) of its half-power "
                  "width wide; c / 2B; the seed's rule 26000 / (0.8 x 10)",
                  "",
                  Section::Measure::relative,
                  2e-4,
                  "the design states four or five digits"};
  const sensors::Sensor sensor = shipped("hivision");
  section.add("two-way azimuth patch in deg", core::degrees(sensor.azimuth_patch_rad()), 0.60215);
  section.add("peak gain in dB", 10.0 * std::log10(sensor.antenna.peak_gain), 35.12);
  section.add("directivity in dB (cone scan)",
              10.0 * std::log10(sensors::directivity(sensor.antenna, sensors::ScanSurface::cone)),
              36.58);
  section.add("range resolution in m",
              core::kSpeedOfLight_mps / (2.0 * sensor.waveform.bandwidth_Hz), 6.67);
  return section;
}

}  // namespace

std::vector<Section> sensor_sections() { return {seed_table(), hivision()}; }

}  // namespace fanbeam::validation
