#include "signal/scan/column_sweep.h"

#include <cmath>

#include "core/constants.h"
#include "core/errors.h"
#include "sensors/antenna/frequency_scan.h"

namespace fanbeam::signal {
namespace {

constexpr double kCellTolerance = 1e-3;
constexpr double kSpareSamples = 1.1;
constexpr int kSampleBlock = 16;  // lengths that transform fast

double frequency_Hz(const sensors::Sensor& sensor, int column) {
  return sensor.scan.frequency_scan ? sensors::steered_column(sensor, column).frequency_Hz
                                    : sensor.waveform.frequency_Hz;
}

// The part of the dwell that is sampled.
double sampled_share(const sensors::Sensor& sensor) {
  return core::kSpeedOfLight_mps / (2.0 * sensor.waveform.bandwidth_Hz) / sensor.range.cell_m;
}

int samples_of(const sensors::RangeGate& gate) {
  const double cells = kSpareSamples * gate.maximum_m() / gate.cell_m;
  return kSampleBlock * static_cast<int>(std::ceil(cells / kSampleBlock));
}

}  // namespace

std::string why_no_column_sweep(const sensors::Sensor& sensor) {
  if (sensor.seed.active) return "the sensor follows a published table that no sweep obeys";
  if (sensor.scan.sweep == sensors::Scan::Sweep::whole_scan)
    return "one sweep covers the whole scan (scan.sweep)";
  if (!(std::abs(sampled_share(sensor) - 1.0) <= kCellTolerance))
    return "a range cell of " + core::number_text(sensor.range.cell_m) + " m is not c / 2B (" +
           core::number_text(sampled_share(sensor) * sensor.range.cell_m) + " m)";
  return {};
}

Waveform column_sweep(const sensors::Sensor& sensor, int column) {
  const std::string why_not = why_no_column_sweep(sensor);
  if (!why_not.empty())
    core::throw_input_error(core::ErrorClass::unsupported, "sensor", "\"" + sensor.name + "\"",
                            "one ramp per column: " + why_not);
  const double slope_Hz_per_s = sensor.waveform.bandwidth_Hz / sensor.receiver.dwell_s;
  const double sampled_s = sensor.receiver.dwell_s * sampled_share(sensor);
  Waveform waveform;
  waveform.kind = WaveformKind::chirp_sequence;
  waveform.centre_frequency_Hz = frequency_Hz(sensor, column);
  waveform.bandwidth_Hz = slope_Hz_per_s * sampled_s;
  waveform.sample_rate_Hz = {samples_of(sensor.range) / sampled_s};
  Segment ramp;
  ramp.start_s = -0.5 * sampled_s;
  ramp.duration_s = sampled_s;
  ramp.start_frequency_Hz = waveform.centre_frequency_Hz - 0.5 * waveform.bandwidth_Hz;
  ramp.slope_Hz_per_s = slope_Hz_per_s;
  waveform.segments = {ramp};
  check(waveform);
  return waveform;
}

}  // namespace fanbeam::signal
