// A column's cells from its beat signal, held against closed forms: the sweep's point response, the
// receiver's noise, the beam, and what an own speed shifts.
#include "signal/scan/column_scan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/constants.h"
#include "core/errors.h"
#include "core/units.h"
#include "sensors/antenna/beam_pattern.h"
#include "sensors/cells.h"
#include "sensors/receiver/point_response.h"
#include "sensors/sensor_file.h"
#include "signal/receiver/receiver_noise.h"
#include "signal/scan/column_sweep.h"

using namespace fanbeam;
using SweepWindow = sensors::Waveform::Window;

namespace {

// The shipped radar, of few columns of 0.25 deg.
sensors::Sensor narrow(int columns, SweepWindow window) {
  core::ProblemList problems;
  sensors::Sensor sensor =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/hivision.toml", problems);
  problems.throw_if_errors();
  sensor.scan.field_of_view_rad *= static_cast<double>(columns) / sensor.scan.columns;
  sensor.scan.columns = columns;
  sensor.waveform.window = window;
  return sensor;
}

core::Echo echo_at(double range_m, double speed_mps = 0.0) {
  core::Echo echo;
  echo.range_m = range_m;
  echo.radial_speed_mps = speed_mps;
  echo.power_W = 1e-9;
  return echo;
}

std::vector<double> cells_of(const sensors::Sensor& sensor, const core::Echo& echo,
                             double taken_off_mps = 0.0) {
  const std::vector<core::Echo> echoes = {echo};
  const std::vector<double> phases = {1.2};
  return signal::scan_cells_W(sensor, signal::scan_beat(sensor, echoes, phases), taken_off_mps);
}

double centroid_m(const sensors::Sensor& sensor, const std::vector<double>& cells_W) {
  double sum = 0.0, moment = 0.0;
  for (int cell = 0; cell < sensor.range.cells; ++cell) {
    const double power_W = cells_W[static_cast<std::size_t>(cell)];
    sum += power_W;
    moment += power_W * sensors::range_middle_m(sensor.range, cell);
  }
  return moment / sum;
}

}  // namespace

TEST_CASE("A lone echo's cells are samples of the sweep's point response, with every window",
          "[scan]") {
  for (const SweepWindow window :
       {SweepWindow::rectangular, SweepWindow::hann, SweepWindow::hamming, SweepWindow::taylor}) {
    const sensors::Sensor sensor = narrow(1, window);
    const sensors::PointResponse response(sensor, 0);
    for (const double beside_cells : {0.0, 0.3, 0.5}) {
      const double range_m =
          sensors::range_middle_m(sensor.range, 250) + beside_cells * sensor.range.cell_m;
      const std::vector<double> cells_W = cells_of(sensor, echo_at(range_m));
      const double peak = response.density_per_m(0.0) * sensor.range.cell_m;
      for (int cell = 240; cell <= 260; ++cell) {
        const double offset_m = range_m - sensors::range_middle_m(sensor.range, cell);
        INFO(static_cast<int>(window) << " " << beside_cells << " cell " << cell);
        // The synthesis is good to 1e-4 of the amplitude; bins of 1.000009 cells.
        CHECK(cells_W[static_cast<std::size_t>(cell)] / 1e-9 ==
              Approx(response.density_per_m(offset_m) * sensor.range.cell_m)
                  .epsilon(0.0)
                  .margin(3e-4 * peak));
      }
      // Parseval: all cells together hold the echo; what a rectangular window leaves beyond the
      // gate is 1e-3.
      CHECK(std::accumulate(cells_W.begin(), cells_W.end(), 0.0) / 1e-9 ==
            Approx(1.0).epsilon(2e-3));
    }
  }
}

TEST_CASE("Noise of a column's cells is that of the sensor", "[scan]") {
  const sensors::Sensor sensor = narrow(40, SweepWindow::taylor);
  signal::FloatCube beat = signal::scan_beat(sensor, {}, {});
  const double rate_Hz = signal::column_sweep(sensor, 0).sample_rate_Hz[0];
  signal::add_receiver_noise(
      {}, {signal::noise_sample_W(sensor.receiver.noise_figure, rate_Hz), true, {1, 0, 0}}, beat);
  const std::vector<double> cells_W = signal::scan_cells_W(sensor, beat, 0.0);
  const double mean_W =
      std::accumulate(cells_W.begin(), cells_W.end(), 0.0) / static_cast<double>(cells_W.size());
  // 20 960 exponential cells whose window correlates neighbours: three sigma are 2.5 %.
  CHECK(mean_W == Approx(sensor.noise_power_W()).epsilon(0.025));
}

TEST_CASE("Columns see an echo through their two-way beam", "[scan]") {
  const sensors::Sensor sensor = narrow(11, SweepWindow::hann);
  core::Echo echo = echo_at(sensors::range_middle_m(sensor.range, 100));
  echo.azimuth_rad = core::radians(0.1);
  const std::vector<double> cells_W = cells_of(sensor, echo);
  const double peak = sensors::PointResponse(sensor, 0).density_per_m(0.0) * sensor.range.cell_m;
  for (int column = 0; column < 11; ++column) {
    const double offset_rad = core::radians(0.25 * (column - 5)) - echo.azimuth_rad;
    INFO("column " << column);
    CHECK(cells_W[static_cast<std::size_t>(100 * 11 + column)] / (1e-9 * peak) ==
          Approx(sensors::two_way_gain(sensor.antenna.azimuth, offset_rad))
              .epsilon(1e-3)
              .margin(1e-12));
  }
}

TEST_CASE("70 m/s towards an echo bring it 41.5 m nearer unless they are taken off", "[scan]") {
  const sensors::Sensor sensor = narrow(1, SweepWindow::hann);
  const double range_m = 1500.0, speed_mps = 70.0;
  const core::Echo echo = echo_at(range_m, -speed_mps);
  // fc v / S, S = B / dwell.
  const double shift_m = sensor.waveform.frequency_Hz * speed_mps * sensor.receiver.dwell_s /
                         sensor.waveform.bandwidth_Hz;
  CHECK(shift_m == Approx(41.5).epsilon(0.0).margin(0.05));
  CHECK(centroid_m(sensor, cells_of(sensor, echo)) ==
        Approx(range_m - shift_m).epsilon(0.0).margin(0.02));
  CHECK(centroid_m(sensor, cells_of(sensor, echo, speed_mps)) ==
        Approx(range_m).epsilon(0.0).margin(0.02));
}

TEST_CASE("Sensors without a sweep per column, or without a window, are refused", "[scan]") {
  core::ProblemList problems;
  const sensors::Sensor published =
      sensors::read_sensor(FANBEAM_SOURCE_DIR "/sensors/hivision-seed.toml", problems);
  CHECK_FALSE(signal::why_no_column_sweep(published).empty());
  sensors::Sensor sensor = narrow(1, SweepWindow::hann);
  CHECK(signal::why_no_column_sweep(sensor).empty());
  sensor.scan.sweep = sensors::Scan::Sweep::whole_scan;
  CHECK_THROWS_AS(signal::column_sweep(sensor, 0), core::InputError);
  sensor = narrow(1, SweepWindow::hann);
  sensor.range.cell_m = 10.0;
  CHECK_THROWS_AS(signal::scan_beat(sensor, {}, {}), core::InputError);
  sensor = narrow(1, SweepWindow::none);
  const signal::FloatCube beat = signal::scan_beat(sensor, {}, {});
  CHECK_THROWS_AS(signal::scan_cells_W(sensor, beat, 0.0), core::InputError);
  sensor.scan.columns = 2;
  CHECK_THROWS_AS(signal::scan_cells_W(sensor, beat, 0.0), core::InternalError);
}
