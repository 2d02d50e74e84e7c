// G06 and the table of threshold factors; detectors on maps, edges, targets beside stronger ones.
#include "signal/detection/cfar.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/swerling.h"
#include "sensors/receiver/detection.h"
#include "signal/detection/cfar_calibration.h"
#include "signal/detection/map_peaks.h"
#include "signal/fourier/window.h"
#include "tests/processor_time.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

CfarReference averaging(int count) {
  return {CfarKind::cell_averaging, count / 2, count - count / 2};
}
CfarReference ordered(int count, int rank) {
  return {CfarKind::ordered_statistic, count / 2, count - count / 2, rank};
}

void check_factors(const CfarReference& reference, std::vector<double> expected) {
  const double kProbabilities[] = {1e-2, 1e-3, 1e-4, 1e-6};
  for (std::size_t i = 0; i < 4; ++i) {
    if (expected[i] == 0.0) continue;
    // The table's last digit.
    CHECK(cfar_factor(reference, kProbabilities[i]) ==
          Approx(expected[i]).margin(6e-7).epsilon(1e-7));
    CHECK(cfar_false_alarm_probability(reference, cfar_factor(reference, kProbabilities[i])) ==
          Approx(kProbabilities[i]).epsilon(1e-8));
  }
}

PowerMap filled(int rows, int columns, double power_W) {
  PowerMap map(rows, columns);
  for (double& value_W : map.values_W) value_W = power_W;
  return map;
}

}  // namespace

TEST_CASE("threshold factors are those of the table", "[cfar]") {
  check_factors(averaging(8), {6.226235, 10.97099, 17.298221, 36.987306});
  check_factors(averaging(16), {5.336343, 8.638824, 12.452471, 21.941979});
  check_factors(averaging(24), {5.076664, 8.004514, 11.227182, 18.678706});
  check_factors(averaging(32), {4.953024, 7.710008, 10.672686, 17.277649});
  check_factors(ordered(16, 12), {4.425093, 7.421411, 11.080194, 20.954160});
  check_factors(ordered(20, 15), {4.181035, 6.855393, 9.999261, 18.004279});
  check_factors(ordered(24, 18), {4.025383, 6.502431, 9.340805, 16.293288});
  check_factors(ordered(32, 24), {3.838277, 6.086337, 8.580143, 14.398525});
  check_factors({CfarKind::greatest_of, 8, 8}, {0, 7.487313, 10.870971, 19.355623});
  check_factors({CfarKind::smallest_of, 8, 8}, {0, 12.599715, 19.556682, 41.056670});
}

TEST_CASE("G06 factors do not cancel for a thousand million reference cells", "[cfar]") {
  CHECK(cfar_factor(averaging(16), 1e-6) == Approx(21.94197929).margin(1e-8).epsilon(0.0));
  CHECK(cfar_factor(averaging(1000000000), 1e-6) == Approx(13.81551065).margin(1e-8).epsilon(0.0));
}

TEST_CASE("halves of unequal size fall back to what is known", "[cfar]") {
  // One half so large that its mean is the true one, 1: the greatest of 1 and the mean of four.
  // Its exceedance lies between those of either half alone.
  const CfarReference greatest{CfarKind::greatest_of, 4, 8};
  const CfarReference smallest{CfarKind::smallest_of, 4, 8};
  for (const double factor : {3.0, 10.0, 30.0}) {
    const double four = std::pow(1.0 + factor / 4.0, -4.0);
    const double eight = std::pow(1.0 + factor / 8.0, -8.0);
    const double high = cfar_false_alarm_probability(smallest, factor);
    const double low = cfar_false_alarm_probability(greatest, factor);
    // exp(-a max) + exp(-a min) is the sum of both exponentials.
    CHECK(high + low == Approx(four + eight).epsilon(1e-12));
    CHECK(low < eight);
    CHECK(high > four);
    CHECK(cfar_false_alarm_probability({CfarKind::smallest_of, 8, 4}, factor) ==
          Approx(high).epsilon(1e-12));
  }
}

TEST_CASE("detection probabilities are those of the table", "[cfar]") {
  const std::pair<double, std::vector<double>> kRows[] = {
      {1e-4, {0.334945, 0.557918, 0.685759, 0.884424}},
      {1e-6, {0.152615, 0.362630, 0.517449, 0.805908}}};
  const double kSnr_dB[] = {10.0, 13.0, 15.0, 20.0};
  for (const auto& row : kRows) {
    const double factor = cfar_factor(averaging(16), row.first);
    for (std::size_t i = 0; i < 4; ++i) {
      // A Swerling 1 target is a background that is 1 + snr times as strong.
      const double snr = std::pow(10.0, kSnr_dB[i] / 10.0);
      CHECK(cfar_false_alarm_probability(averaging(16), factor / (1.0 + snr)) ==
            Approx(row.second[i]).margin(6e-7).epsilon(0.0));
    }
  }
  // Steady target, known noise: the receiver's own functions serve here too.
  CHECK(10.0 * std::log10(sensors::required_snr(core::Swerling::steady, 0.9, 1e-4, 1)) ==
        Approx(11.749).margin(6e-4).epsilon(0.0));
  CHECK(10.0 * std::log10(sensors::required_snr(core::Swerling::steady, 0.9, 1e-6, 1)) ==
        Approx(13.183).margin(6e-4).epsilon(0.0));
}

TEST_CASE("G06 equal cells and zeros give no detection under any detector", "[cfar]") {
  for (const CfarKind kind : {CfarKind::cell_averaging, CfarKind::ordered_statistic,
                              CfarKind::greatest_of, CfarKind::smallest_of}) {
    CfarSettings settings{.kind = kind, .design_probability = 1e-6};
    CHECK(cfar_detections(filled(30, 50, 7.0), settings).empty());
    CHECK(cfar_detections(filled(30, 50, 0.0), settings).empty());
    settings.along_rows = {.guard = 1, .reference = 2, .wraps = true};
    CHECK(cfar_detections(filled(30, 50, 7.0), settings).empty());
    CHECK(cfar_detections(PowerMap(0, 0), {.kind = kind}).empty());
    CHECK(cfar_detections(filled(3, 1, 5.0), {.kind = kind}).empty());  // no reference cell at all
  }
}

TEST_CASE("G06 border cells use the cells that exist, with their own factor", "[cfar]") {
  // In front of the first cell nothing; behind it 8 reference cells of power 1.
  const CfarSettings settings{.design_probability = 1e-4};
  for (const int column : {0, 49, 3}) {
    const int references = column == 3 ? 9 : 8;  // 3: one cell before, beyond two guard cells
    const double factor = cfar_factor(averaging(references), 1e-4);
    PowerMap map = filled(1, 50, 1.0);
    map.at(0, column) = factor * 1.001;
    REQUIRE(cfar_detections(map, settings).size() == 1);
    CHECK(cfar_detections(map, settings)[0].column == column);
    CHECK(cfar_detections(map, settings)[0].background_W == Approx(1.0));
    CHECK(cfar_detections(map, settings)[0].margin == Approx(1.001));
    map.at(0, column) = factor * 0.999;
    CHECK(cfar_detections(map, settings).empty());
  }
}

TEST_CASE("the window goes on at the other end of an axis that wraps", "[cfar]") {
  CfarSettings settings{.design_probability = 1e-4,
                        .along_columns = {.guard = 0, .reference = 0},
                        .along_rows = {.guard = 1, .reference = 4, .wraps = true}};
  PowerMap map = filled(32, 3, 1.0);
  map.at(29, 1) = 1000.0;  // 3 cells before row 0: a reference cell of it
  map.at(0, 1) = 20.0;
  auto found = cfar_detections(map, settings);
  REQUIRE(found.size() == 1);
  CHECK(found[0].row == 29);
  settings.along_rows.wraps = false;
  found = cfar_detections(map, settings);
  REQUIRE(found.size() == 1);  // 4 reference cells need a factor of 36
  map.at(0, 1) = 40.0;
  CHECK(cfar_detections(map, settings).size() == 2);
}

TEST_CASE("a rectangle leaves its guard cells out and counts the rest once", "[cfar]") {
  const CfarSettings settings{.design_probability = 1e-3,
                              .along_columns = {.guard = 2, .reference = 3},
                              .along_rows = {.guard = 1, .reference = 2, .wraps = true}};
  const CfarReference reference = cfar_reference(settings);
  CHECK(reference.before + reference.after == 7 * 11 - 3 * 5);
  CHECK(reference.before == reference.after);
  PowerMap map = filled(20, 30, 1.0);
  for (int r = 9; r <= 11; ++r)
    for (int c = 13; c <= 17; ++c) map.at(r, c) = 50.0;  // fills the guard cells
  bool centre = false;
  for (const CfarCell& cell : cfar_detections(map, settings))
    if (cell.row == 10 && cell.column == 15) {
      centre = true;
      CHECK(cell.background_W == Approx(1.0));
    }
  CHECK(centre);
}

TEST_CASE("powers that are none, windows that meet themselves and odd settings are refused",
          "[cfar]") {
  PowerMap map = filled(8, 8, 1.0);
  map.at(3, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(cfar_detections(map, {}), core::InputError);
  map.at(3, 3) = -1.0;
  CHECK_THROWS_AS(cfar_detections(map, {}), core::InputError);
  map.at(3, 3) = 1.0;
  CHECK_THROWS_AS(cfar_detections(map, {.along_rows = {2, 2, true}}), core::InputError);
  CHECK_THROWS_AS(cfar_detections(map, {.along_columns = {0, 0}}), core::InputError);
  CHECK_THROWS_AS(cfar_detections(map, {.design_probability = 0.0}), core::InputError);
  CHECK_THROWS_AS(cfar_detections(map, {.rank_fraction = 0.0}), core::InputError);
  CHECK_THROWS_AS(cfar_factor(ordered(16, 17), 1e-3), core::InputError);
  CHECK_THROWS_AS(cfar_factor({CfarKind::greatest_of, 0, 8}, 1e-3), core::InputError);
  CHECK_THROWS_AS(cfar_factor(averaging(16), std::nan("")), core::InputError);
  CHECK_THROWS_AS(calibrated_cfar({}, {}, 0), core::InputError);
}

TEST_CASE("calibration changes nothing where cells are independent", "[cfar][calibration]") {
  CfarSettings settings{.design_probability = 1e-3};
  CHECK(calibrated_cfar(settings, {}).factor == Approx(8.638824).epsilon(1e-6));
  CHECK(calibrated_cfar(settings, {}).design_probability == Approx(1e-3).epsilon(1e-6));
  // A rectangular window leaves bins independent.
  const std::vector<double> ones(64, 1.0);
  CHECK(calibrated_cfar(settings, {ones, 64, {}, 0}).factor == Approx(8.638824).epsilon(1e-6));
  // What is drawn agrees with the closed form within its own error.
  for (const double probability : {1e-3, 1e-4, 1e-6}) {
    settings = {.kind = CfarKind::ordered_statistic, .design_probability = probability};
    const CfarCalibration drawn = calibrated_cfar(settings, {});
    INFO("design " << probability << ", error " << drawn.relative_error);
    CHECK(drawn.relative_error > 0.0);
    CHECK(drawn.relative_error < (probability < 1e-5 ? 0.08 : 0.02));
    CHECK(drawn.design_probability == Approx(probability).epsilon(3.5 * drawn.relative_error));
  }
}

// H. A. David, H. N. Nagaraja, "Order Statistics", 2003, 2.5: E = sum over i < k of 1 / (N - i), and of
// the larger of two exponential means of one cell 3/2, of the smaller 1/2. Tolerances are two to three standard
// errors of 500 draws: 1.4, 3.3 and 4.5 %.
TEST_CASE("calibration tells what a detector's estimate of noise is on average",
          "[cfar][calibration]") {
  double ranked = 0.0;
  for (int i = 0; i < 12; ++i) ranked += 1.0 / (16 - i);
  const auto mean_of = [](CfarSettings settings, int looks) {
    return calibrated_cfar(settings, {}, looks).mean_estimate;
  };
  CHECK(mean_of({.kind = CfarKind::ordered_statistic}, 1) == Approx(ranked).epsilon(0.03));
  const CfarReach one{.guard = 0, .reference = 1};
  CHECK(mean_of({.kind = CfarKind::greatest_of, .along_columns = one}, 1) ==
        Approx(1.5).epsilon(0.1));
  CHECK(mean_of({.kind = CfarKind::smallest_of, .along_columns = one}, 1) ==
        Approx(0.5).epsilon(0.1));
  CHECK(mean_of({.kind = CfarKind::cell_averaging}, 1) == 1.0);
  CHECK(mean_of({.kind = CfarKind::cell_averaging}, 12) == 1.0);
  // A cell's background is that mean, whatever the detector: what stands over it is one ratio.
  PowerMap map(1, 40);
  map.values_W.assign(40, 2.0);
  map.values_W[20] = 2000.0;
  const CfarSettings told{.kind = CfarKind::ordered_statistic, .mean_estimate = ranked};
  const auto found = cfar_detections(map, told);
  REQUIRE(found.size() == 1);
  CHECK(found[0].background_W == Approx(2.0 / ranked));
  CHECK(found[0].margin == Approx(cfar_detections(map, {.kind = told.kind})[0].margin));
}

// Halves by rows (Doppler) had both sides of the step: a background of 50.
TEST_CASE("greatest of guards a step of clutter in range in two dimensions too", "[cfar]") {
  PowerMap map(40, 40);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) map.at(row, column) = column < 20 ? 1.0 : 100.0;
  map.at(15, 18) = 1e6;
  CfarSettings settings{.along_columns = {2, 8, false}, .along_rows = {2, 2, true}};
  const auto background_W = [&](CfarKind kind) {
    settings.kind = kind;
    for (const CfarCell& cell : cfar_detections(map, settings))
      if (cell.row == 15 && cell.column == 18) return cell.background_W;
    return -1.0;
  };
  // Of 82 cells 76 are behind the step.
  CHECK(background_W(CfarKind::greatest_of) == Approx((6.0 + 7600.0) / 82.0));
  CHECK(background_W(CfarKind::smallest_of) == Approx(1.0));
}

// Of the nearer half of the first columns a few cells are left, which alone would ask for 20 dB more.
TEST_CASE("smallest of two halves finds at the map's first range what it finds within", "[cfar]") {
  PowerMap map(40, 40);
  for (double& power : map.values_W) power = 1.0;
  CfarSettings settings{.kind = CfarKind::smallest_of,
                        .design_probability = 1e-6,
                        .along_columns = {2, 4, false},
                        .along_rows = {2, 2, true}};
  for (const int column : {0, 1, 2, 20, 39}) {
    CAPTURE(column);
    PowerMap lit = map;
    lit.at(20, column) = 24.0;
    CHECK(cfar_detections(lit, settings).size() == 1);
  }
}

TEST_CASE("a sum over channels is calibrated to a few percent, even for rare alarms",
          "[cfar][calibration]") {
  const auto taylor = window_weights({.kind = WindowKind::taylor}, 256);
  for (const double probability : {1e-3, 1e-6}) {
    const CfarSettings settings{.kind = CfarKind::ordered_statistic,
                                .design_probability = probability,
                                .along_columns = {2, 4, false},
                                .along_rows = {2, 2, true}};
    const CfarCalibration sum = calibrated_cfar(settings, {taylor, 256, taylor, 256}, 12);
    INFO("error " << sum.relative_error << ", factor " << sum.factor);
    CHECK(sum.relative_error < 0.05);
    // Twelve looks fluctuate little: the factor is far below that of one.
    CHECK(sum.factor < 0.5 * cfar_factor(cfar_reference(settings), probability));
    CHECK(sum.factor > 1.0);
  }
}

// A data set makes its radar anew for every frame.
TEST_CASE("a calibration that was asked for before costs nothing, and is that of its own question",
          "[cfar][calibration]") {
  const auto taylor = window_weights({.kind = WindowKind::taylor}, 128);
  const CfarSettings settings{.kind = CfarKind::ordered_statistic,
                              .design_probability = 1.7e-4,  // asked for by nobody else
                              .along_columns = {2, 4, false},
                              .along_rows = {2, 2, true}};
  const double begin_s = tests::processor_time_s();
  const CfarCalibration first = calibrated_cfar(settings, {taylor, 128, taylor, 128}, 6);
  const double drawn_s = tests::processor_time_s() - begin_s;
  const CfarCalibration other = calibrated_cfar(settings, {taylor, 128, taylor, 128}, 5);
  const CfarCalibration padded = calibrated_cfar(settings, {taylor, 256, taylor, 128}, 6);
  CHECK(other.factor > first.factor);
  CHECK(padded.factor != first.factor);
  const double again_s = tests::processor_time_s();
  for (int i = 0; i < 10; ++i) {
    const CfarCalibration again = calibrated_cfar(settings, {taylor, 128, taylor, 128}, 6);
    CHECK(again.factor == first.factor);
    CHECK(again.design_probability == first.design_probability);
    CHECK(again.relative_error == first.relative_error);
    CHECK(again.mean_estimate == first.mean_estimate);
  }
  CHECK(tests::processor_time_s() - again_s < drawn_s);
}

TEST_CASE("neighbouring cells of a Hann window are correlated by 2/3 and 1/6", "[calibration]") {
  const auto hann = window_weights({.kind = WindowKind::hann}, 128);
  CHECK(cell_correlation(hann, 128, 0).real() == Approx(1.0));
  CHECK(std::abs(cell_correlation(hann, 128, 1)) == Approx(2.0 / 3.0).epsilon(1e-12));
  CHECK(std::abs(cell_correlation(hann, 128, 2)) == Approx(1.0 / 6.0).epsilon(1e-12));
  CHECK(std::abs(cell_correlation(hann, 128, 3)) < 1e-12);
  CHECK(std::abs(cell_correlation(hann, 256, 2)) == Approx(2.0 / 3.0).epsilon(1e-12));
}

TEST_CASE("only the strongest of neighbouring detections is a peak", "[peaks]") {
  PowerMap map = filled(16, 20, 1.0);
  for (int d = -1; d <= 1; ++d) {
    map.at(0, 8 + d) = 300.0 - 100.0 * std::abs(d);
    map.at(15, 8 + d) = 250.0 - 100.0 * std::abs(d);  // a neighbour of row 0 where rows wrap
  }
  map.at(7, 3) = 100.0;
  map.at(7, 4) = 100.0;  // equal: the first stays
  std::vector<CfarCell> cells;
  for (int r = 0; r < 16; ++r)
    for (int c = 0; c < 20; ++c)
      if (map.at(r, c) > 50.0) cells.push_back({r, c, map.at(r, c), 1.0, 2.0});
  const auto wrapped = map_peaks(map, cells, true);
  REQUIRE(wrapped.size() == 2);
  CHECK(wrapped[0].cell.row == 0);
  CHECK(wrapped[0].column == Approx(8.0));
  CHECK(wrapped[0].row < 0.0);
  CHECK(wrapped[1].cell.column == 3);
  CHECK(map_peaks(map, cells, false).size() == 3);
}
