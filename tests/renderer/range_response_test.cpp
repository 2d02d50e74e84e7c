// Echoes spread along range by the point response of the sweep.
#include "renderer/stages/range_response.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/parallel.h"
#include "renderer/plan/plan.h"
#include "sensors/receiver/point_response.h"
#include "tests/renderer/test_worlds.h"
#include "tests/renderer/values.h"

using namespace fanbeam;
using renderer::RangeResponse;
using tests::total;

namespace {

using Window = sensors::Waveform::Window;

sensors::Sensor with_window(Window window, int columns = 4, int cells = 524) {
  sensors::Sensor sensor = tests::hivision(columns);
  sensor.waveform.window = window;
  sensor.range.cells = cells;
  return sensor;
}

std::vector<double> impulse(const sensors::Sensor& sensor, int row, int column) {
  std::vector<double> image(static_cast<std::size_t>(sensor.scan.columns * sensor.range.cells));
  image[static_cast<std::size_t>(row * sensor.scan.columns + column)] = 1.0;
  return image;
}

// Share of a cell's power that falls more than `rows` cells away on one side.
double tail(const std::vector<double>& shares, std::size_t rows) {
  double beyond = 0.5 * (1.0 - shares[0]);
  for (std::size_t k = 1; k <= rows && k < shares.size(); ++k) beyond -= shares[k];
  return beyond;
}

}  // namespace

TEST_CASE("the shares of a cell's power add up to 1 within 1e-9", "[range_response]") {
  // Hann's lobes fall with the sixth power: all of it is within 4000 cells.
  for (const Window window : {Window::hann, Window::rectangular}) {
    const sensors::Sensor sensor = with_window(window, 1, 4000);
    const RangeResponse response(sensor);
    const std::vector<double>& shares = response.shares(0);
    double sum = shares[0];
    for (std::size_t k = 1; k < shares.size(); ++k) sum += 2.0 * shares[k];
    // sinc^2 beyond n bins: 1 / (2 pi^2 n) a side, averaged over a cell as wide as a bin; ripple
    // falls with n^-3.
    const double bin_cells = sensors::PointResponse(sensor, 0).scale_m() / sensor.range.cell_m;
    const double n = static_cast<double>(shares.size()) - 0.5;
    const double beyond = window == Window::hann ? 0.0
                                                 : bin_cells * std::log((n + 0.5) / (n - 0.5)) /
                                                       (core::kPi * core::kPi);
    CHECK(sum + beyond == Approx(1.0).epsilon(0.0).margin(1e-9));
  }
}

TEST_CASE("power stays in the picture but for what leaves the gate at its ends",
          "[range_response]") {
  for (const Window window : {Window::rectangular, Window::hann, Window::hamming, Window::taylor}) {
    const sensors::Sensor sensor = with_window(window);
    const RangeResponse response(sensor);
    for (const int row : {0, 5, 260, 523}) {
      std::vector<double> image = impulse(sensor, row, 2);
      response.apply(image);
      const std::vector<double>& shares = response.shares(2);
      const double leaves = tail(shares, static_cast<std::size_t>(row)) +
                            tail(shares, static_cast<std::size_t>(523 - row));
      CHECK(total(image) + leaves == Approx(1.0).epsilon(0.0).margin(1e-9));
      CHECK(leaves > -1e-12);
      for (const double value : image) CHECK(value >= 0.0);
    }
    // In the middle of a long gate almost nothing leaves.
    const sensors::Sensor longer = with_window(window, 1, 8000);
    std::vector<double> image = impulse(longer, 4000, 0);
    RangeResponse(longer).apply(image);
    CHECK(total(image) == Approx(1.0).epsilon(0.0).margin(window == Window::hann ? 1e-9 : 1e-4));
  }
}

TEST_CASE("columns do not mix, and a uniform picture stays uniform away from the ends",
          "[range_response]") {
  const sensors::Sensor sensor = with_window(Window::hann);
  const RangeResponse response(sensor);
  std::vector<double> image = impulse(sensor, 100, 1);
  response.apply(image);
  for (int row = 0; row < sensor.range.cells; ++row)
    for (const int column : {0, 2, 3})
      CHECK(image[static_cast<std::size_t>(row * 4 + column)] == 0.0);
  std::vector<double> even(image.size(), 2.0);
  response.apply(even);
  for (int row = 50; row < 474; ++row)
    CHECK(even[static_cast<std::size_t>(row * 4)] == Approx(2.0).epsilon(1e-8));
}

TEST_CASE("a point target's measured response has the window's side lobe and width",
          "[range_response]") {
  struct Row {
    Window window;
    double lobe_dB, width_bins;
  };
  for (const Row& row : {Row{Window::rectangular, -13.26, 0.886}, Row{Window::hann, -31.47, 1.44},
                         Row{Window::hamming, -42.67, 1.30}}) {
    // Cells of a fiftieth of a bin measure the response itself.
    constexpr double kFine = 50.0;
    sensors::Sensor sensor = with_window(row.window, 8, 1200);
    const double bin_m = sensors::PointResponse(sensor, 0).scale_m();
    sensor.range.cell_m = bin_m / kFine;
    sensor.range.minimum_m = 1000.0 - 600.0 * sensor.range.cell_m;
    renderer::World world = tests::world(sensor, std::nullopt, {});
    const double e = sensor.antenna.boresight_elevation_rad;
    const double range_m = 1000.0 + 0.5 * sensor.range.cell_m;
    world.targets = {{"sphere",
                      materials::ConstantRcs{1.0},
                      {{0.0, {0.0, range_m * std::cos(e), 100.0 + range_m * std::sin(e)}}},
                      glm::dmat3(1.0)}};
    const renderer::Effects effects{{core::EffectId::range_response}};
    const renderer::Frame frame =
        renderer::render_frame(world, {}, {true, false}, effects, tests::level_pose(100.0));
    const auto power = [&](int k) { return frame.bscope_W[static_cast<std::size_t>(k * 8 + 4)]; };
    int peak = 0;
    for (int k = 0; k < 1200; ++k)
      if (power(k) > power(peak)) peak = k;
    CHECK(peak == 600);
    int half = peak;
    while (power(half + 1) > 0.5 * power(peak)) ++half;
    const double share =
        (power(half) / power(peak) - 0.5) / ((power(half) - power(half + 1)) / power(peak));
    CHECK(2.0 * (half - peak + share) / kFine == Approx(row.width_bins).epsilon(0.0).margin(0.006));
    int lobe = peak;
    while (power(lobe + 1) < power(lobe)) ++lobe;
    double highest = 0.0;
    for (int k = lobe; k < 1200; ++k) highest = std::max(highest, power(k));
    CHECK(10.0 * std::log10(highest / power(peak)) ==
          Approx(row.lobe_dB).epsilon(0.0).margin(0.03));
  }
}

TEST_CASE("one sweep over the whole scan blurs by the Gaussian that its beam makes",
          "[range_response]") {
  sensors::Sensor sensor = with_window(Window::none);
  sensor.scan.sweep = sensors::Scan::Sweep::whole_scan;
  sensor.scan.field_of_view_rad *= 41.0;  // four columns of 41 deg
  std::vector<double> image = impulse(sensor, 262, 0);
  RangeResponse(sensor).apply(image);
  double second_m2 = 0.0;
  for (int row = 0; row < 524; ++row) {
    const double away_m = (row - 262) * sensor.range.cell_m;
    second_m2 += image[static_cast<std::size_t>(row * 4)] * away_m * away_m;
  }
  const double sigma_m = sensors::PointResponse(sensor, 0).scale_m();
  // Plus the variance of the cell twice: spread evenly, then gathered.
  CHECK(second_m2 ==
        Approx(sigma_m * sigma_m + std::pow(sensor.range.cell_m, 2) / 6.0).epsilon(1e-6));
}

TEST_CASE("a frequency scan's own slope gives each column its width", "[range_response]") {
  sensors::Sensor sensor = with_window(Window::none);
  sensor.scan.sweep = sensors::Scan::Sweep::whole_scan;
  sensors::FrequencyScan law;
  law.law = sensors::FrequencyScan::Law::table;
  const double edge_rad = sensor.scan.field_of_view_rad / 2;
  law.table_azimuth_rad = {-edge_rad, 0.0, edge_rad};
  law.table_frequency_Hz = {34.9e9, 35e9, 35.05e9};  // the right half is swept half as wide
  sensor.scan.frequency_scan = law;
  const RangeResponse response(sensor);
  CHECK(sensors::PointResponse(sensor, 3).scale_m() ==
        Approx(2.0 * sensors::PointResponse(sensor, 0).scale_m()));
  std::vector<double> image = impulse(sensor, 200, 0);
  image[200 * 4 + 3] = 1.0;
  response.apply(image);
  CHECK(image[200 * 4 + 3] < image[200 * 4]);
  CHECK(image[200 * 4 + 3] == Approx(response.shares(3)[0]));
}

TEST_CASE("targets drawn one by one keep their power, small shares join the ground",
          "[range_response]") {
  const sensors::Sensor sensor = with_window(Window::rectangular);
  const RangeResponse response(sensor);
  std::vector<double> together = impulse(sensor, 300, 1);
  response.apply(together);
  std::vector<double> apart(together.size(), 0.0);
  const auto drawn = response.spread({{7, 1, 300 * 4 + 1, 1.0}}, apart);
  CHECK(drawn.size() > 10);
  CHECK(drawn.size() < 80);
  for (const renderer::TargetShare& share : drawn) {
    CHECK(share.target == 7);
    CHECK(share.column == 1);
    apart[share.cell] += share.power;
  }
  for (std::size_t i = 0; i < apart.size(); ++i)
    CHECK(apart[i] == Approx(together[i]).epsilon(0.0).margin(1e-15));
}

TEST_CASE("the plan runs the range response only where a window or a whole scan asks for it",
          "[range_response]") {
  renderer::SceneFacts facts;
  facts.sensor = tests::hivision();
  facts.largest_sigma0_over_sine = 0.17;  // grass
  const auto runs = [&](const char* wishes) {
    return renderer::plan(facts, 0.5, renderer::parse_effect_wishes(wishes))
        .runs(core::EffectId::range_response);
  };
  const renderer::EffectWishes as_needed;
  CHECK_FALSE(renderer::plan(facts, 0.5, as_needed).runs(core::EffectId::range_response));
  CHECK_FALSE(runs("all"));
  facts.sensor.waveform.window = Window::hamming;
  CHECK(renderer::plan(facts, 0.5, as_needed).runs(core::EffectId::range_response));
  CHECK_FALSE(runs("none"));
  CHECK(runs("none,+range-response"));
  const double bound_dB = renderer::range_response_bound_dB(facts);
  CHECK(bound_dB > 30.0);
  CHECK(bound_dB <= 60.0);
  facts.sensor.waveform.window = Window::none;
  facts.sensor.scan.sweep = sensors::Scan::Sweep::whole_scan;
  CHECK(renderer::plan(facts, 0.5, as_needed).runs(core::EffectId::range_response));
}

// What is added was counted as spread even where the response is switched off.
TEST_CASE("what a cell may hold counts with the response and without it", "[range_response]") {
  sensors::Sensor sensor = tests::hivision();
  sensor.waveform.window = Window::hann;
  std::vector<double> cell_W(static_cast<std::size_t>(sensor.range.cells), 0.0);
  cell_W[0] = 1.0;
  const std::vector<double> most_W = renderer::largest_spread(sensor, cell_W);
  const renderer::RangeResponse response(sensor);
  CHECK(response.shares(0)[0] < 0.9);
  CHECK(most_W[0] == 1.0);
  CHECK(most_W[1] == response.shares(0)[1]);
  CHECK(most_W[2] == response.shares(0)[2]);
}

TEST_CASE("without a window the effect switched on changes no byte, nor do more threads",
          "[range_response]") {
  const materials::PhongNrcs grass(0.0325, 0.136, 1.99);
  const auto render = [&](Window window, bool on, int threads) {
    const core::ThreadLimit limit(threads);
    sensors::Sensor sensor = with_window(window, 6);
    const renderer::World world = tests::world(
        sensor, tests::ground(4000.0, 250.0, [](double, double) { return 0.0; }), {grass});
    const renderer::Effects effects{core::EffectSet{}.with(core::EffectId::range_response, on)};
    return renderer::render_frame(world, {}, {true, true}, effects, tests::level_pose(60.0));
  };
  const renderer::Frame off = render(Window::none, false, 0);
  const renderer::Frame on = render(Window::none, true, 0);
  CHECK(on.bscope_W == off.bscope_W);
  CHECK(on.bscope_grey == off.bscope_grey);
  CHECK(on.cscope_grey == off.cscope_grey);
  const renderer::Frame windowed = render(Window::hann, true, 1);
  CHECK(windowed.bscope_W != off.bscope_W);
  CHECK(windowed.bscope_W == render(Window::hann, true, 2).bscope_W);
  CHECK(windowed.cscope_W_m3 == off.cscope_W_m3);
  CHECK(render(Window::hann, false, 0).bscope_W == off.bscope_W);
}
