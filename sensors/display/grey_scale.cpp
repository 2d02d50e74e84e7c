#include "sensors/display/grey_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decibel.h"
#include "core/dispatch.h"
#include "core/errors.h"
#include "core/series.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/display/seed_signal.h"

namespace fanbeam::sensors {
namespace {

double cubed(double x) { return x * x * x; }

double level_of(double ratio, const char* field) {
  // log takes 60 % of the time of log10 (glibc 2.36).
  if (ratio > 0.0) return core::kDecibelsPerNeper * std::log(ratio);
  if (ratio == 0.0) return -std::numeric_limits<double>::infinity();
  if (std::isnan(ratio))
    core::throw_input_error(core::ErrorClass::nonfinite, field, ratio, "0 or more");
  core::throw_input_error(core::ErrorClass::range, field, ratio, "0 or more");
}

// False when a value is negative or not a number; the greys then mean nothing.
FANBEAM_HOT(bool, grey_of_all,
            (const double* values, std::size_t count, double factor, double low_dB,
             double greys_per_dB, double* grey),
            (values, count, factor, low_dB, greys_per_dB, grey)) {
  unsigned refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double ratio = values[i] * factor;
    refused |= ratio >= 0.0 ? 0U : 1U;
    const double level_dB = core::kDecibelsPerNeper * core::series_log(ratio);
    const double unclamped = (level_dB - low_dB) * greys_per_dB;
    const double above = unclamped > 0.0 ? unclamped : 0.0;
    const double clamped = above < 255.0 ? above : 255.0;
    grey[i] = ratio > 0.0 ? clamped : 0.0;
  }
  return refused == 0;
}

FANBEAM_HOT(bool, round_all, (const double* grey, std::size_t count, std::uint8_t* rounded),
            (grey, count, rounded)) {
  unsigned refused = 0;
  for (std::size_t i = 0; i < count; ++i) {
    refused |= grey[i] == grey[i] ? 0U : 1U;
    const double above = grey[i] > 0.0 ? grey[i] : 0.0;
    const double clamped = above < 255.0 ? above : 255.0;
    const int whole = static_cast<int>(clamped);
    rounded[i] = static_cast<std::uint8_t>(whole + (clamped - whole >= 0.5 ? 1 : 0));
  }
  return refused == 0;
}

}  // namespace

double compensated_cells_m3(const RangeGate& gate) {
  double sum_m3 = 0.0;
  for (int row = 0; row < gate.cells; ++row) sum_m3 += cubed(range_middle_m(gate, row));
  return sum_m3;
}

GreyScale::GreyScale(const Sensor& sensor)
    : low_dB_(sensor.display.low_dB), high_dB_(sensor.display.high_dB) {
  const RangeGate& gate = sensor.range;
  level_per_power_per_W_.assign(static_cast<std::size_t>(gate.cells), 1.0);
  if (sensor.display.mapping == Display::Mapping::stc) {
    const double flat_ground_W_m3 =
        sensor.radar_constant_W_m2() * two_way_width(sensor.antenna.azimuth) * gate.cell_m;
    for (int row = 0; row < gate.cells; ++row)
      level_per_power_per_W_[static_cast<std::size_t>(row)] =
          cubed(range_middle_m(gate, row)) / flat_ground_W_m3;
    level_per_compensated_per_W_m3_ = 1.0 / flat_ground_W_m3;
  } else if (sensor.display.mapping == Display::Mapping::log) {
    level_per_compensated_per_W_m3_ = sensor.display.cscope_rows / compensated_cells_m3(gate);
  } else {
    level_per_compensated_per_W_m3_ = 1.0 / cubed(range_middle_m(gate, 0));
    const SignalLimits limits = seed_signal_limits(sensor);
    low_dB_ = 10.0 * std::log10(limits.minimum_W);
    high_dB_ = 10.0 * std::log10(limits.maximum_W);
  }
  greys_per_dB_ = 255.0 / (high_dB_ - low_dB_);
}

double GreyScale::grey_of_level(double level_dB) const {
  if (std::isnan(level_dB))
    core::throw_input_error(core::ErrorClass::nonfinite, "display level", level_dB,
                            "a level in dB");
  if (level_dB <= low_dB_) return 0.0;
  if (level_dB >= high_dB_) return 255.0;
  return std::min(255.0, (level_dB - low_dB_) * greys_per_dB_);
}

double GreyScale::bscope_floor_W(int range_row) const {
  return std::pow(10.0, low_dB_ / 10.0) /
         level_per_power_per_W_[static_cast<std::size_t>(range_row)];
}

double GreyScale::cscope_floor_W_m3() const {
  return std::pow(10.0, low_dB_ / 10.0) / level_per_compensated_per_W_m3_;
}

double GreyScale::level_dB(double power_W, int range_row) const {
  return level_of(power_W * level_per_power_per_W_[static_cast<std::size_t>(range_row)],
                  "received power");
}

double GreyScale::bscope_grey(double power_W, int range_row) const {
  return grey_of_level(level_dB(power_W, range_row));
}

double GreyScale::cscope_level_dB(double compensated_power_W_m3) const {
  return level_of(compensated_power_W_m3 * level_per_compensated_per_W_m3_,
                  "range-compensated power");
}

double GreyScale::cscope_grey(double compensated_power_W_m3) const {
  return grey_of_level(cscope_level_dB(compensated_power_W_m3));
}

void GreyScale::bscope_grey(std::span<const double> power_W, int range_row, double* grey) const {
  grey_of_ratios(power_W, level_per_power_per_W_[static_cast<std::size_t>(range_row)],
                 "received power", grey);
}

void GreyScale::cscope_grey(std::span<const double> compensated_power_W_m3, double* grey) const {
  grey_of_ratios(compensated_power_W_m3, level_per_compensated_per_W_m3_, "range-compensated power",
                 grey);
}

void GreyScale::grey_of_ratios(std::span<const double> values, double factor, const char* field,
                               double* grey) const {
  if (grey_of_all(values.data(), values.size(), factor, low_dB_, greys_per_dB_, grey)) return;
  for (const double value : values) level_of(value * factor, field);  // throws at the first
}

void round_greys(std::span<const double> grey, std::uint8_t* rounded) {
  if (round_all(grey.data(), grey.size(), rounded)) return;
  for (const double value : grey) grey8(value);  // throws at the first
}

std::uint8_t grey8(double grey) {
  if (std::isnan(grey))
    core::throw_input_error(core::ErrorClass::nonfinite, "grey", grey, "0 to 255");
  const double clamped = std::clamp(grey, 0.0, 255.0);
  // Not the whole part of grey + 0.5: that sum rounds 0.49999999999999994 up to 1.
  const int whole = static_cast<int>(clamped);
  return static_cast<std::uint8_t>(clamped - whole >= 0.5 ? whole + 1 : whole);
}

}  // namespace fanbeam::sensors
