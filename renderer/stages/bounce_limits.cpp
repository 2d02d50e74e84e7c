#include "renderer/stages/bounce_limits.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "renderer/plan/largest_echo.h"
#include "sensors/cells.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::renderer {
namespace {

// An echo that fills the whole beam and stays below this part of the display's floor is not
// followed: 0.04 dB on a cell that is just not black.
constexpr double kShareOfFloor = 0.01;

}  // namespace

double widest_tangent(const sensors::BeamCut& cut) {
  const double apart_rad = 2.0 * cut.cut_rad;
  return apart_rad < core::kPi / 2 ? std::tan(apart_rad) * (1.0 + 1e-9) : 1e300;
}

std::vector<double> faintest_echoes_W_per_rad2(const sensors::Sensor& sensor, bool noise) {
  const sensors::GreyScale scale(sensor);
  const double beam_rad2 = azimuth_width_rad(sensor) * elevation_width_rad(sensor);
  const double noise_W = noise ? sensor.noise_power_W() : 0.0;
  const double row_W_m3 =
      std::max(scale.cscope_floor_W_m3(), noise ? sensors::cscope_noise_W_m3(sensor) : 0.0);
  std::vector<double> faintest;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double range_m = sensors::range_middle_m(sensor.range, cell);
    const double cell_W = std::max(scale.bscope_floor_W(cell), noise_W);
    faintest.push_back(kShareOfFloor * std::min(cell_W, row_W_m3 / (range_m * range_m * range_m)) /
                       beam_rad2);
  }
  return faintest;
}

std::vector<double> shown_powers_W(const sensors::Sensor& sensor) {
  constexpr double kUpWindow = 0.4;
  // Rows of the C-scope that lie below the horizon hold some hundred times their noise.
  constexpr double kHeld = 100.0;
  const sensors::GreyScale scale(sensor);
  const double up_window = std::pow(10.0, kUpWindow * scale.window_dB() / 10.0);
  const double row_W_m3 =
      kHeld * std::max(scale.cscope_floor_W_m3(), sensors::cscope_noise_W_m3(sensor));
  std::vector<double> shown;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double range_m = sensors::range_middle_m(sensor.range, cell);
    shown.push_back(
        std::min(up_window * scale.bscope_floor_W(cell), row_W_m3 / (range_m * range_m * range_m)));
  }
  return shown;
}

double faintest_mirror(const sensors::Sensor& sensor, const std::vector<BistaticNrcs>& nrcs,
                       const std::vector<double>& faintest_W_per_rad2) {
  double brightest = 0.0;
  for (const BistaticNrcs& surface : nrcs)
    brightest = std::max(brightest, surface.monostatic().largest());
  double faintest = 1.0;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double range_m = sensors::range_middle_m(sensor.range, cell);
    faintest =
        std::min(faintest, 0.01 * faintest_W_per_rad2[static_cast<std::size_t>(cell)] * range_m *
                               range_m / (4.0 * sensor.radar_constant_W_m2() * brightest));
  }
  return faintest;
}

}  // namespace fanbeam::renderer
