// Highway scenarios: the JSON reader, and the motions that are made of what it takes.
#include <cmath>

#include "scenes/highway_reader.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

namespace {

void look_at(const core::HighwayScenario& scenario, const core::HighwayRadar& radar) {
  fuzz::must(scenario.truth.size() == scenario.targets.size(), "a truth list for each target");
  for (const core::HighwayTarget& target : scenario.targets) {
    fuzz::must(
        target.fluctuation >= core::Swerling::steady && target.fluctuation <= core::Swerling::case4,
        "a case that there is");
    for (const double share : {0.0, 0.3, 1.0}) {
      const core::HighwayTruth truth =
          core::truth_at(target, scenario.radar_speed_mps, radar, share * scenario.duration_s);
      fuzz::must(std::isfinite(truth.range_m) && std::isfinite(truth.range_rate_mps) &&
                     std::isfinite(truth.azimuth_rad),
                 "finite motion");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList&) {
    const scenes::HighwayFile file = scenes::parse_highway(text, "highway.json");
    fuzz::must(file.radar.array_elements >= 1, "an element or more");
    fuzz::must(file.radar.bandwidth_Hz < file.radar.centre_frequency_Hz, "a band above zero");
    for (const core::HighwayScenario& scenario : file.scenarios) look_at(scenario, file.radar);
  });
  return 0;
}
