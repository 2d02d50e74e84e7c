// Measurements from samples up: as good as the bound where a car is alone, and good enough for the
// tracker where six are not.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>

#include "core/constants.h"
#include "core/decibel.h"
#include "tests/tracking/highway_scenes.h"
#include "tracking/simulation/measurement_bound.h"
#include "tracking/simulation/measurement_simulator.h"
#include "tracking/simulation/road_families.h"
#include "tracking/simulation/sampled_frame.h"

using namespace fanbeam;
using namespace fanbeam::tracking;
using namespace fanbeam::tests;

TEST_CASE("From samples, a lone car is measured at the bound, in every frame, without ghosts",
          "[sampled][statistics]") {
  const SampledRadar radar(highway_radar());
  const auto scenario = one_stopped_car();
  MeanSquare range, rate, azimuth;
  for (std::uint32_t run = 0; run < 40; ++run) {
    const int frame = static_cast<int>(run) % 60;
    const auto truth =
        truth_at(scenario.targets[0], scenario.radar_speed_mps, highway_radar(), frame * 0.05);
    const auto seen = radar.measure(scenario, 3, run, frame);
    REQUIRE(seen.size() == 1);
    range.add((seen[0].range_m - truth.range_m) / seen[0].range_sigma_m);
    rate.add((seen[0].range_rate_mps - truth.range_rate_mps) / seen[0].range_rate_sigma_mps);
    azimuth.add((seen[0].azimuth_rad - truth.azimuth_rad) / seen[0].azimuth_sigma_rad);
  }
  INFO("range " << range.rms() << ", rate " << rate.rms() << ", azimuth " << azimuth.rms());
  // 40 normal values: 11 % in the root mean square, three of which are allowed.
  CHECK(range.rms() == Approx(1.0).epsilon(0.0).margin(0.34));
  CHECK(rate.rms() == Approx(1.0).epsilon(0.0).margin(0.34));
  CHECK(azimuth.rms() < 1.5);
}

// Of twelve elements the coherent sum has 24 dB, so each 13 dB on a ramp, 3 dB above what the beats need and 7 dB above
// the coarse detector's threshold for the sum of twelve. With the threshold of one channel for it nothing below 26 dB was
// seen, nor most below 28 dB, where one receiver sees from 19 dB on.
TEST_CASE("From samples, an array sees a weak car that the sum of its channels shows",
          "[sampled][statistics]") {
  constexpr double kRange_m = 100.0;
  for (const int elements : {1, 12}) {
    core::HighwayRadar weak = highway_radar();
    weak.array_elements = elements;
    core::HighwayScenario scenario =
        scene(3.0, kRoadSpeed_mps, {car("A", kRange_m, 0.0, kRoadSpeed_mps + 0.2)});
    scenario.targets[0].cross_section_m2 =
        core::power_from_dB(24.0) / measurement_bound(weak, 1.0, kRange_m, 0.0).signal_to_noise;
    const core::HighwayScenario empty = scene(3.0, kRoadSpeed_mps, {});
    const SampledRadar radar(weak);
    int seen = 0;
    std::size_t without = 0;
    constexpr int kFrames = 40;
    for (int frame = 0; frame < kFrames; ++frame) {
      seen += times_measured(scenario, 0, frame, radar.measure(scenario, 6, 0, frame)) == 1 ? 1 : 0;
      without += radar.measure(empty, 6, 1, frame).size();
    }
    INFO(elements << " elements");
    CHECK(seen >= 0.95 * kFrames);
    CHECK(without == 0);
  }
}

// Of 80 dB over the noise of the coarse map: side lobes at every speed 20 dB above it.
TEST_CASE("From samples, a near car's side lobes are no cars", "[sampled]") {
  const SampledRadar radar(highway_radar());
  const auto scenario =
      scene(3.0, kRoadSpeed_mps,
            {car("A", 15.0, 0.0, kRoadSpeed_mps + 0.2), car("B", 80.0, 3.0, kRoadSpeed_mps - 5.0)});
  for (const int frame : {0, 7, 14}) {
    const auto seen = radar.measure(scenario, 4, 0, frame);
    INFO("frame " << frame);
    CHECK(seen.size() == 2);
    for (const std::size_t target : {0U, 1U})
      CHECK(times_measured(scenario, target, frame, seen) == 1);
  }
}

TEST_CASE("From samples, chirps of too few samples for a detector are refused", "[sampled]") {
  core::HighwayRadar coarse = highway_radar();
  coarse.waveforms.coarse_rate_Hz = 0.2e6;
  CHECK_THROWS_WITH(SampledRadar(coarse),
                    Catch::Contains("E-RANGE") && Catch::Contains("samples of a coarse chirp"));
}

TEST_CASE("From samples, a target is measured in every frame but those of its gap", "[sampled]") {
  const SampledRadar radar(highway_radar());
  const core::HighwayScenario scenario = one_hidden_for_half_a_second();
  for (const int frame : {0, 9, 10, 15, 19, 20, 29}) {
    INFO("frame " << frame);
    const auto seen = radar.measure(scenario, 4, 0, frame);
    CHECK(times_measured(scenario, 0, frame, seen) == (frame >= 10 && frame < 20 ? 0 : 1));
    CHECK(times_measured(scenario, 1, frame, seen) == 1);
  }
}

// 1 cm before the radar in frame 20, and behind it within the triangle: a path that synthesis refuses.
TEST_CASE("From samples, a car through the radar has no echo, and leaves the other's",
          "[sampled]") {
  const SampledRadar radar(highway_radar());
  const auto scenario = scene(2.0, 0.0, {car("A", 10.01, 0.0, -10.0), car("B", 80.0, 3.0, -10.0)});
  REQUIRE(truth_at(scenario.targets[0], 0.0, highway_radar(), 1.0).in_view);
  const auto seen = radar.measure(scenario, 4, 0, 20);
  CHECK(seen.size() == 1);
  CHECK(times_measured(scenario, 1, 20, seen) == 1);
}

// Chirps of 60 us tell speeds within 16.4 m/s apart: 65 m/s is two folds away.
TEST_CASE("From samples, a speed is found in whatever fold it lies", "[sampled]") {
  core::HighwayRadar slow = highway_radar();
  slow.waveforms.coarse_chirp_s = 60e-6;
  const SampledRadar radar(slow);
  for (const double rate_mps : {-65.0, -20.0, 10.0, 60.0}) {
    core::HighwayScenario scenario = one_stopped_car();
    scenario.targets = {car("A", 120.0, 0.0, kRoadSpeed_mps + rate_mps)};
    INFO(rate_mps << " m/s");
    const auto truth = truth_at(scenario.targets[0], scenario.radar_speed_mps, slow, 0.0);
    const auto seen = radar.measure(scenario, 3, 0, 0);
    REQUIRE(seen.size() == 1);
    CHECK(seen[0].range_rate_mps == Approx(rate_mps).epsilon(0.0).margin(0.3));
    CHECK(seen[0].range_m == Approx(truth.range_m).epsilon(0.0).margin(0.3));
  }
}

// At 500 kHz ramps of half a millisecond show beats up to 75 m: what a car at 100 m has folds and fits none of its cells.
TEST_CASE("From samples, what folds in the fine triangle is not shown, and told so", "[sampled]") {
  core::HighwayRadar steep = highway_radar();
  core::HighwayScenario scenario = one_stopped_car();
  scenario.targets = {car("A", 100.0, 0.0, kRoadSpeed_mps)};
  const SampledRadar before(steep);
  CHECK(before.shows({.range_m = 100.0}));
  CHECK(before.measure(scenario, 3, 0, 0).size() == 1);
  steep.waveforms.fine_ramp_s = 0.5e-3;
  const SampledRadar radar(steep);
  CHECK(radar.measure(scenario, 3, 0, 0).empty());
  CHECK_FALSE(radar.shows({.range_m = 100.0}));
  CHECK(radar.shows({.range_m = 70.0}));
  // Closing at 60 m/s moves both beats by 30 kHz down, which is 9 m of them.
  CHECK_FALSE(radar.shows({.range_m = 70.0, .range_rate_mps = -60.0}));
}

// Elements a wavelength apart see what is 2 deg to the left also 75 deg to the right, as strong: which of the two was told
// was a matter of rounding. 40 deg reads as -21 deg, and is told so.
TEST_CASE(
    "From samples, elements farther apart than half a wavelength tell the direction nearest to "
    "boresight",
    "[sampled]") {
  core::HighwayRadar wide = highway_radar();
  wide.array_pitch_wavelengths = 1.0;
  const SampledRadar radar(wide);
  for (const double azimuth_rad : {-0.035, 0.0, 0.2, 0.45}) {
    const core::HighwayScenario scenario =
        scene(3.0, kRoadSpeed_mps,
              {car("A", 60.0 * std::cos(azimuth_rad), 60.0 * std::sin(azimuth_rad),
                   kRoadSpeed_mps + 0.2)});
    for (int frame = 0; frame < 4; ++frame) {
      const auto truth = truth_at(scenario.targets[0], kRoadSpeed_mps, wide, frame * 0.05);
      CHECK(radar.shows(truth));
      const auto seen = radar.measure(scenario, 3, 0, frame);
      INFO(azimuth_rad << " rad, frame " << frame);
      REQUIRE(seen.size() == 1);
      CHECK(seen[0].azimuth_rad == Approx(truth.azimuth_rad).epsilon(0.0).margin(5e-3));
    }
  }
  CHECK_FALSE(radar.shows({.range_m = 60.0, .azimuth_rad = 0.7}));
  CHECK(SampledRadar(highway_radar()).shows({.range_m = 60.0, .azimuth_rad = 0.7}));
}

// The bound told goes with the root of the power: of a steady car the same in every frame, of a Swerling 1
// car with the draws that the level of frequencies has.
TEST_CASE("From samples, a target fluctuates as it does from frequencies",
          "[sampled][statistics]") {
  const SampledRadar radar(highway_radar());
  core::HighwayScenario steady = one_stopped_car();
  core::HighwayScenario fluctuating = steady;
  fluctuating.targets[0].fluctuation = core::Swerling::case1;
  double least = 1.0, most = 1.0;
  for (std::uint32_t run = 0; run < 6; ++run) {
    const auto ratio = [&](const std::vector<RadarMeasurement>& without,
                           const std::vector<RadarMeasurement>& with) {
      REQUIRE(without.size() == 1);
      REQUIRE(with.size() == 1);
      return std::pow(without[0].range_sigma_m / with[0].range_sigma_m, 2);
    };
    const double sampled =
        ratio(radar.measure(steady, 3, run, 0), radar.measure(fluctuating, 3, run, 0));
    const double drawn = ratio(simulated_frame(steady, highway_radar(), {}, 3, run, 0),
                               simulated_frame(fluctuating, highway_radar(), {}, 3, run, 0));
    INFO("run " << run);
    CHECK(sampled == Approx(drawn).epsilon(0.1));
    least = std::min(least, sampled);
    most = std::max(most, sampled);
  }
  CHECK(most > 2.0 * least);
}

TEST_CASE("From samples, S2 is tracked as from frequencies, and twice with the same bits",
          "[sampled][statistics]") {
  const SampledRadar radar(highway_radar());
  const core::HighwayScenario scenario = six_vehicles();
  ScenarioScore score;
  int missed = 0, ghosts = 0, instances = 0, frames = 0;
  run_scenario(
      scenario, highway_radar(), road_tracker(highway_radar(), kRoadSpeed_mps),
      [&](int frame) { return radar.measure(scenario, 4, 0, frame); },
      [&](const Frame& frame) {
        score.add(scenario, frame);
        ++frames;
        const auto match = [](const RadarMeasurement& one, const core::HighwayTruth& truth) {
          return std::abs(one.range_m - truth.range_m) <= 1.0 &&
                 std::abs(one.range_rate_mps - truth.range_rate_mps) <= 1.0;
        };
        for (const auto& truth : frame.truth) {
          instances += truth.in_view;
          missed +=
              truth.in_view && std::none_of(frame.measurements.begin(), frame.measurements.end(),
                                            [&](const auto& one) { return match(one, truth); });
        }
        for (const auto& one : frame.measurements)
          ghosts += std::none_of(frame.truth.begin(), frame.truth.end(), [&](const auto& truth) {
            return truth.in_view && match(one, truth);
          });
      });
  INFO("missed " << missed << " of " << instances << ", ghosts " << ghosts << " in " << frames
                 << " scans, GOSPA " << score.gospa_m.mean() << " m, MOTA " << score.mot.mota()
                 << ", tracks " << score.tracks.size() << ", range " << score.range_m.rms()
                 << " m rms");
  CHECK(missed <= 0.03 * instances);
  CHECK(ghosts <= 0.02 * frames);
  CHECK(score.tracks.size() == 6);
  CHECK(score.mot.switches() == 0);
  CHECK(score.gospa_m.mean() <= 0.5);
  CHECK(score.mot.mota() >= 0.98);
  const auto first = radar.measure(scenario, 4, 0, 7), again = radar.measure(scenario, 4, 0, 7);
  REQUIRE(first.size() == again.size());
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(first[i].range_m == again[i].range_m);
}

TEST_CASE("From samples, beats that touch do not pull each other", "[sampled][statistics]") {
  // 1.7 to 2.8 bins apart on the ramp up, where the window's main lobes overlap: sought one by one
  // they would be wrong by 10 to 50 mm.
  const SampledRadar radar(highway_radar());
  const core::HighwayScenario scenario = slow_crossing();
  MeanSquare range, rate;
  for (int frame = 68; frame <= 80; frame += 2) {
    const auto seen = radar.measure(scenario, 1, 0, frame);
    REQUIRE(seen.size() == 2);
    for (const RadarMeasurement& one : seen) {
      const auto truth = truth_at(scenario.targets[one.azimuth_rad < -0.03 ? 1 : 0],
                                  scenario.radar_speed_mps, highway_radar(), frame * 0.05);
      range.add(one.range_m - truth.range_m);
      rate.add(one.range_rate_mps - truth.range_rate_mps);
    }
  }
  INFO("range " << range.rms() << " m rms, rate " << rate.rms() << " m/s rms");
  CHECK(range.rms() < 1e-3);
  CHECK(rate.rms() < 2e-3);
}

namespace {

// Of measurements over what they tell, by how near another car's beat is in one of the ramps: 0.7 to 3 bins, and
// farther; and of those that tell that a beat is another car's too.
struct ToldErrors {
  struct Of {
    MeanSquare range, rate, azimuth, range_m;
  };
  Of near, far, merged;
  int unlike = 0, cars = 0, told = 0;

  void add(const std::vector<core::HighwayTruth>& truth, const core::HighwayRadar& radar,
           const RadarMeasurement& one) {
    const auto misfit = [&](const core::HighwayTruth& of) {
      return std::hypot((one.range_m - of.range_m) / 0.3,
                        (one.range_rate_mps - of.range_rate_mps) / 0.3,
                        (one.azimuth_rad - of.azimuth_rad) / 0.02);
    };
    const auto own =
        std::min_element(truth.begin(), truth.end(),
                         [&](const auto& a, const auto& b) { return misfit(a) < misfit(b); });
    double apart_bins = 1e9;
    for (auto other = truth.begin(); other != truth.end(); ++other) {
      if (other == own || !other->in_view) continue;
      const double range =
          (own->range_m - other->range_m) * 2.0 * radar.bandwidth_Hz / core::kSpeedOfLight_mps;
      const double rate = (own->range_rate_mps - other->range_rate_mps) * 2.0 * radar.ramp_s *
                          radar.centre_frequency_Hz / core::kSpeedOfLight_mps;
      apart_bins = std::min({apart_bins, std::abs(range - rate), std::abs(range + rate)});
    }
    const bool tells = one.range_systematic_m > 0.01;
    if (!tells && apart_bins < 0.7) return;
    unlike += !tells && misfit(*own) > 1.0 ? 1 : 0;
    Of& errors = tells ? merged : apart_bins < 3.0 ? near : far;
    const double range_m = one.range_m - own->range_m;
    errors.range_m.add(range_m);
    errors.range.add(range_m / std::hypot(one.range_sigma_m, one.range_systematic_m));
    errors.rate.add((one.range_rate_mps - own->range_rate_mps) /
                    std::hypot(one.range_rate_sigma_mps, one.range_rate_systematic_mps));
    errors.azimuth.add((one.azimuth_rad - own->azimuth_rad) /
                       std::hypot(one.azimuth_sigma_rad, one.azimuth_systematic_rad));
  }
};

ToldErrors told_errors(const char* family_name) {
  const core::HighwayRadar radar = highway_radar();
  const SampledRadar sampled(radar);
  ToldErrors errors;
  for (const RoadFamily& family : road_families()) {
    if (std::string(family.name) != family_name) continue;
    for (int run = 0; run < 4; ++run) {
      const core::HighwayScenario scenario = family.draw(run, radar.frame_s);
      for (int frame = run; frame < frames_of(scenario, radar); frame += 6) {
        std::vector<core::HighwayTruth> truth;
        for (const auto& target : scenario.targets)
          truth.push_back(truth_at(target, scenario.radar_speed_mps, radar, frame * radar.frame_s));
        for (std::size_t i = 0; i < truth.size(); ++i)
          errors.cars +=
              truth[i].in_view && !core::is_suppressed(scenario.targets[i], frame * radar.frame_s);
        for (const RadarMeasurement& one :
             sampled.measure(scenario, 77, static_cast<std::uint32_t>(run), frame)) {
          ++errors.told;
          errors.add(truth, radar, one);
        }
      }
    }
  }
  return errors;
}

}  // namespace

// Side lobes, bends and neighbours' directions were told as 5 mm, 5 mm/s and 0.5 mrad of every car, and were up to
// 17 mm, 28 mm/s and 48 mrad of two a bin apart.
TEST_CASE("From samples, cars err by the noise, as their measurements tell",
          "[sampled][statistics]") {
  for (const char* family : {"side by side", "braking", "overtaking"}) {
    const ToldErrors all = told_errors(family);
    CHECK(all.unlike == 0);
    CHECK(all.cars > 100);
    CHECK(all.told >= 0.97 * all.cars);
    CHECK(all.near.range.count() + all.far.range.count() >= 0.55 * all.cars);
    for (const auto& [what, errors] :
         {std::pair{"near", all.near}, {"far", all.far}, {"merged", all.merged}}) {
      INFO(family << ", " << what << ": " << errors.range.count() << ", range "
                  << errors.range.rms() << ", rate " << errors.rate.rms() << ", azimuth "
                  << errors.azimuth.rms() << ", " << 1e3 * errors.range_m.rms() << " mm");
      if (errors.range.count() < 20) continue;
      for (const MeanSquare* each : {&errors.range, &errors.rate, &errors.azimuth}) {
        CHECK(each->rms() < 1.4);
        if (std::string(what) != "merged") CHECK(each->rms() > 0.6);
      }
      if (std::string(what) != "merged") CHECK(errors.range_m.rms() < 0.5e-3);
    }
  }
}

// No direction tells which beats belong together. Both up tones had the same down tone; then the pairing with the
// smaller difference of speeds, which fits as well, told as sure to less than a millimetre.
TEST_CASE("One receiver tells when it cannot know which beats belong together",
          "[sampled][statistics]") {
  core::HighwayRadar radar = highway_radar();
  radar.array_elements = 1;
  const SampledRadar sampled(radar);
  int told = 0, outside = 0, unsure = 0;
  for (int run = 0; run < 40; ++run) {
    // Apart in one ramp alone, and as far apart in both.
    const double apart_m = run % 2 == 0 ? 0.02 * run : 0.0;
    const core::HighwayScenario scenario =
        scene(0.05, kRoadSpeed_mps,
              {car("A", 60.0, 0.0, kRoadSpeed_mps),
               car("B", 60.0 + apart_m, 0.0, kRoadSpeed_mps + 0.04 * run)});
    std::vector<core::HighwayTruth> truth;
    for (const auto& target : scenario.targets)
      truth.push_back(truth_at(target, scenario.radar_speed_mps, radar, 0.0));
    const auto seen = sampled.measure(scenario, 5, static_cast<std::uint32_t>(run), 0);
    if (seen.size() != 2) continue;
    for (const RadarMeasurement& one : seen) {
      double nearest = 1e9;
      for (const core::HighwayTruth& of : truth)
        nearest = std::min(
            nearest,
            std::hypot(
                (one.range_m - of.range_m) / std::hypot(one.range_sigma_m, one.range_systematic_m),
                (one.range_rate_mps - of.range_rate_mps) /
                    std::hypot(one.range_rate_sigma_mps, one.range_rate_systematic_mps)));
      ++told;
      outside += nearest > 6.0;
      unsure += one.range_systematic_m > 0.05;
    }
  }
  INFO(told << " told, " << outside << " wrong by more, " << unsure << " unsure");
  CHECK(told >= 20);
  CHECK(outside <= 0.05 * told);
  CHECK(unsure > 0);
}

TEST_CASE("From samples, S3 keeps both cars through the crossing", "[sampled][statistics]") {
  const SampledRadar radar(highway_radar());
  const core::HighwayScenario scenario = slow_crossing();
  ScenarioScore score;
  run_scenario(
      scenario, highway_radar(), road_tracker(highway_radar(), kRoadSpeed_mps),
      [&](int frame) { return radar.measure(scenario, 1, 0, frame); },
      [&](const Frame& frame) { score.add(scenario, frame); });
  INFO("range " << score.range_m.rms() << " m rms, at most " << score.range_m.largest());
  CHECK(score.tracks.size() == 2);
  CHECK(score.mot.switches() == 0);
  CHECK(score.range_m.rms() <= 0.1);
  CHECK(score.range_m.largest() <= 1.0);
}

TEST_CASE("From samples, an array too long to scan is refused, not measured wrongly or for hours",
          "[sampled]") {
  core::HighwayRadar radar = highway_radar();
  radar.array_pitch_wavelengths = 1250.0 / (radar.array_elements - 1);
  CHECK_NOTHROW(SampledRadar(radar));
  radar.array_pitch_wavelengths *= 1.01;
  CHECK_THROWS_WITH(SampledRadar(radar),
                    Catch::Contains("E-LIMIT") && Catch::Contains("1250 wavelengths"));
}
