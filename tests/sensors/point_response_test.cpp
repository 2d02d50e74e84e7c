// The range response of windows and of a scan in one sweep, against published figures.
#include "sensors/receiver/point_response.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "core/constants.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;
using namespace fanbeam::sensors;
using Window = Waveform::Window;

namespace {

Sensor with_window(Window window) {
  Sensor sensor = tests::hivision();
  sensor.waveform.window = window;
  return sensor;
}

// The highest lobe behind the first null, in dB of the peak.
double highest_lobe_dB(const PointResponse& response) {
  const double peak = response.density_per_m(0.0);
  double x = 0.5, lobe = 0.0;
  const auto relative = [&](double bins) {
    return response.density_per_m(bins * response.scale_m()) / peak;
  };
  while (relative(x + 1e-3) < relative(x)) x += 1e-3;
  for (; x < 30.0; x += 1e-3) lobe = std::max(lobe, relative(x));
  return 10.0 * std::log10(lobe);
}

}  // namespace

TEST_CASE("windows have their published side lobes and widths", "[point_response]") {
  // Harris 1978, table I; the Hamming lobe to one more digit by Nuttall 1981.
  struct Row {
    Window window;
    double lobe_dB, width_bins;
  };
  for (const Row& row : {Row{Window::rectangular, -13.26, 0.886}, Row{Window::hann, -31.47, 1.44},
                         Row{Window::hamming, -42.67, 1.30}}) {
    const PointResponse response(with_window(row.window), 0);
    CHECK(response.scale_m() == Approx(6.67).epsilon(0.0).margin(0.001));
    CHECK(highest_lobe_dB(response) == Approx(row.lobe_dB).epsilon(0.0).margin(0.02));
    CHECK(response.half_power_width_m() / response.scale_m() ==
          Approx(row.width_bins).epsilon(0.0).margin(0.006));
  }
}

TEST_CASE("Taylor windows keep the side lobes they are asked for", "[point_response]") {
  for (const double level_dB : {-25.0, -35.0, -45.0}) {
    Sensor sensor = with_window(Window::taylor);
    sensor.waveform.taylor_side_lobe = std::pow(10.0, level_dB / 10.0);
    sensor.waveform.taylor_equal_lobes = level_dB < -40.0 ? 8 : 4;
    // Taylor's lobes are nearly equal: the design holds them within a few tenths of a decibel.
    CHECK(highest_lobe_dB(PointResponse(sensor, 0)) == Approx(level_dB).epsilon(0.0).margin(0.4));
  }
  // -35 dB with four equal lobes: -35.1672 dB and 1.1822 bins (A. Doerry, Catalog of window taper
  // functions for sidelobe control, Sandia, 2017), as that design's F_m give.
  const PointResponse response(with_window(Window::taylor), 0);
  CHECK(highest_lobe_dB(response) == Approx(-35.1672).epsilon(0.0).margin(0.001));
  CHECK(response.half_power_width_m() / response.scale_m() ==
        Approx(1.1822).epsilon(0.0).margin(0.003));
}

TEST_CASE("a window's response is the transform of its weights", "[point_response]") {
  const PointResponse response(with_window(Window::hamming), 0);
  for (const double x : {0.0, 0.3, 1.0, 2.7, 11.4}) {
    std::complex<double> sum = 0.0;
    double energy = 0.0;
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) {
      const double t = (i + 0.5) / kSteps - 0.5;
      const double weight = 0.54 + 0.46 * std::cos(2.0 * core::kPi * t);
      sum += std::polar(weight / kSteps, 2.0 * core::kPi * x * t);
      energy += weight * weight / kSteps;
    }
    CHECK(response.density_per_m(x * response.scale_m()) * response.scale_m() ==
          Approx(std::norm(sum) / energy).epsilon(0.0).margin(1e-8));
  }
}

TEST_CASE("every response has a total of 1", "[point_response]") {
  Sensor whole_scan = tests::hivision();
  whole_scan.scan.sweep = Scan::Sweep::whole_scan;
  for (const Sensor& sensor : {with_window(Window::hann), whole_scan}) {
    const PointResponse response(sensor, 0);
    double sum = 0.0;
    const double step_m = response.scale_m() / 8.0;  // above the rate that the lobes need
    for (int i = -8000; i <= 8000; ++i) sum += response.density_per_m(i * step_m) * step_m;
    CHECK(sum == Approx(1.0).epsilon(1e-9));
  }
}

TEST_CASE("one sweep over the whole scan resolves only what the beam's dwell lets through",
          "[point_response]") {
  Sensor sensor = tests::hivision();
  sensor.scan.sweep = Scan::Sweep::whole_scan;
  CHECK(has_point_response(sensor));
  const PointResponse response(sensor, 0);
  // Transform of the Gaussian pattern over frequency, by sum: 22.473 MHz sweep over 41 deg.
  const double lit_Hz = 22.473e6 * 0.8 / 41.0;
  const auto field = [&](double range_m) {
    double sum = 0.0;
    for (int i = -4000; i <= 4000; ++i) {
      const double f = i * lit_Hz / 1000.0;
      sum += std::exp(-4.0 * std::log(2.0) * f * f / (lit_Hz * lit_Hz)) *
             std::cos(4.0 * core::kPi * f * range_m / core::kSpeedOfLight_mps);
    }
    return sum;
  };
  for (const double range_m : {50.0, 100.0, 200.0})
    CHECK(response.density_per_m(range_m) / response.density_per_m(0.0) ==
          Approx(std::pow(field(range_m) / field(0.0), 2)).epsilon(1e-6));
  CHECK(response.half_power_width_m() == Approx(213.3).epsilon(0.0).margin(0.1));
  sensor.waveform.bandwidth_Hz = 719e6;
  CHECK(PointResponse(sensor, 0).half_power_width_m() == Approx(6.67).epsilon(0.0).margin(0.01));
}

TEST_CASE("without window or one-sweep scan there is no response", "[point_response]") {
  CHECK_FALSE(has_point_response(tests::hivision()));
  CHECK(has_point_response(with_window(Window::rectangular)));
  CHECK_FALSE(point_response_varies(with_window(Window::rectangular)));
}
