// Worked examples of the metrics.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/errors.h"
#include "tracking/metrics/clear_mot.h"
#include "tracking/metrics/error_statistics.h"
#include "tracking/metrics/ospa.h"

using namespace fanbeam;
using namespace fanbeam::tracking;

namespace {

std::vector<Place> on_a_line(const std::vector<double>& x_m) {
  std::vector<Place> places;
  for (const double x : x_m) places.push_back({x, 0.0});
  return places;
}

std::vector<NamedPlace> named(const std::vector<std::pair<int, double>>& entries) {
  std::vector<NamedPlace> places;
  for (const auto& [id, x_m] : entries) places.push_back({id, {x_m, 0.0}});
  return places;
}

}  // namespace

TEST_CASE("OSPA and GOSPA of targets at 0 and 10 and a track at 1", "[metrics]") {
  const auto truth = on_a_line({0.0, 10.0}), tracks = on_a_line({1.0});
  CHECK(ospa_m(truth, tracks, {}) == Approx(3.605551).epsilon(0.0).margin(5e-7));
  CHECK(ospa_m(tracks, truth, {}) == Approx(3.605551).epsilon(0.0).margin(5e-7));
  const Gospa parts = gospa(truth, tracks, {});
  CHECK(parts.total_m == Approx(3.674235).epsilon(0.0).margin(5e-7));
  CHECK(parts.location == Approx(1.0));
  CHECK(parts.missed == Approx(12.5));
  CHECK(parts.unwanted == 0.0);
}

TEST_CASE("Empty sets, and pairs beyond the cut-off", "[metrics]") {
  CHECK(ospa_m({}, {}, {}) == 0.0);
  CHECK(gospa({}, {}, {}).total_m == 0.0);
  CHECK(ospa_m(on_a_line({3.0}), {}, {}) == Approx(5.0));
  // A far pair counts as one miss and one unwanted track, and costs what a pair at c would.
  const Gospa far = gospa(on_a_line({0.0}), on_a_line({100.0}), {});
  CHECK(far.location == 0.0);
  CHECK(far.missed == Approx(12.5));
  CHECK(far.unwanted == Approx(12.5));
  CHECK(far.total_m == Approx(5.0));
  // Only alpha = 2 can be split.
  const Gospa other = gospa(on_a_line({0.0, 10.0}), on_a_line({1.0}), {2.0, 5.0, 1.0});
  CHECK(other.total_m == Approx(std::sqrt(26.0)));
  CHECK(other.missed == 0.0);
  CHECK_THROWS_AS(gospa({}, {}, {0.5, 5.0, 2.0}), core::InputError);
  CHECK_THROWS_AS(gospa({}, {}, {2.0, 5.0, 3.0}), core::InputError);
  CHECK_THROWS_AS(ospa_m(on_a_line({std::nan("")}), {}, {}), core::InputError);
}

TEST_CASE("The split adds up to GOSPA", "[metrics]") {
  const Gospa parts = gospa(on_a_line({0.0, 10.0, 20.0, 50.0}), on_a_line({0.5, 11.0, 80.0}), {});
  CHECK(parts.location == Approx(0.25 + 1.0));
  CHECK(parts.missed == Approx(25.0));
  CHECK(parts.unwanted == Approx(12.5));
  CHECK(parts.total_m * parts.total_m ==
        Approx(parts.location + parts.missed + parts.unwanted).epsilon(1e-12));
}

TEST_CASE("One miss, two false tracks and a switch in twenty make a MOTA of 0.80", "[metrics]") {
  ClearMot metric(2.0);
  for (int frame = 0; frame < 10; ++frame) {
    const auto truth = named({{1, 0.0}, {2, 30.0}});
    if (frame == 3)
      metric.add_frame(truth, named({{7, 0.5}}));
    else if (frame == 5)
      metric.add_frame(truth, named({{7, 0.5}, {8, 30.5}, {9, 100.0}, {10, -100.0}}));
    else
      metric.add_frame(truth, named({{7, 0.5}, {frame < 8 ? 8 : 11, 30.5}}));
  }
  CHECK(metric.instances() == 20);
  CHECK(metric.missed() == 1);
  CHECK(metric.false_tracks() == 2);
  CHECK(metric.switches() == 1);
  CHECK(metric.mota() == Approx(0.80));
  CHECK(metric.motp_m().value() == Approx(0.5));
}

TEST_CASE("Matches stay while inside the gate, though another pairing were nearer", "[metrics]") {
  ClearMot metric(5.0);
  metric.add_frame(named({{1, 0.0}, {2, 4.0}}), named({{7, 0.0}, {8, 4.0}}));
  // Targets pass each other faster than tracks follow: each is nearer to the other's track.
  metric.add_frame(named({{1, 3.0}, {2, 1.0}}), named({{7, 0.5}, {8, 3.5}}));
  CHECK(metric.switches() == 0);
  CHECK(metric.last_match().at(1) == 7);
  CHECK(metric.motp_m().value() == Approx((0.0 + 0.0 + 2.5 + 2.5) / 4.0));
  // A target that comes back under another track is a switch too.
  metric.add_frame({}, {});
  metric.add_frame(named({{1, 50.0}}), named({{9, 50.0}}));
  CHECK(metric.switches() == 1);
}

TEST_CASE("As many matches as there can be come before small distances", "[metrics]") {
  ClearMot metric(4.0);
  metric.add_frame(named({{1, 0.0}, {2, 3.0}}), named({{7, 3.0}, {8, 6.5}}));
  CHECK(metric.missed() == 0);
  CHECK_FALSE(ClearMot(1.0).motp_m().has_value());
  CHECK_THROWS_AS(ClearMot(0.0), core::InputError);
  CHECK_THROWS_AS(metric.add_frame(named({{1, 0.0}, {1, 3.0}}), {}), core::InputError);
}

TEST_CASE("Root mean square, mean and largest of errors", "[metrics]") {
  MeanSquare errors;
  CHECK(errors.rms() == 0.0);
  for (const double e : {3.0, -4.0}) errors.add(e);
  CHECK(errors.rms() == Approx(std::sqrt(12.5)));
  CHECK(errors.mean() == Approx(-0.5));
  CHECK(errors.largest() == 4.0);
  CHECK_THROWS_AS(errors.add(std::nan("")), core::InputError);
}
