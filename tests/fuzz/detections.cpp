// Detections as tables and as JSON, and what a tracker makes of them.
#include <cmath>

#include "session/signal/detection_file.h"
#include "session/signal/measurements.h"
#include "tests/fuzz/fuzz_target.h"
#include "tracking/simulation/scenario_run.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const bool json = size > 0 && (data[0] == '{' || data[0] == '[');
  const auto file =
      fuzz::scratch_file(json ? "found.json" : "found.csv", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const auto frames = session::read_detections(file, problems);
    if (problems.has_errors()) return;
    core::HighwayRadar radar;
    radar.most_range_m = 1e6;
    tracking::Tracker tracker(tracking::road_tracker(radar, 10.0));
    double before_s = -1e300;
    for (const session::DetectedFrame& frame : frames) {
      fuzz::must(frame.time_s >= before_s, "times that do not go back");
      before_s = frame.time_s;
      fuzz::must(frame.clusters.size() == frame.detections.size(), "a cluster for each");
      if (frame.detections.size() > 50) continue;
      tracker.update(frame.time_s, session::measurements_of(frame, nullptr, {}));
      for (const tracking::Track& track : tracker.tracks())
        fuzz::must(std::isfinite(combined(track.state).mean[0]), "finite tracks");
    }
  });
  return 0;
}
