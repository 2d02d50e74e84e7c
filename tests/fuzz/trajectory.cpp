// Recorded flights: the CSV reader, and the flight that is made of its rows.
#include <cmath>

#include "scenes/trajectory/track_check.h"
#include "scenes/trajectory/trajectory_attitude.h"
#include "scenes/trajectory/trajectory_csv.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

namespace {

void read_and_fly(const std::filesystem::path& file, const scenes::TrajectoryColumns& columns) {
  fuzz::expect_answer([&](core::ProblemList& problems) {
    scenes::RawTrack track = scenes::read_track_csv(file, columns, problems);
    if (problems.has_errors()) return;
    scenes::check_track(track, columns, {}, problems);
    if (problems.has_errors()) return;
    fuzz::must(!track.rows.empty(), "a row that stays");
    const scenes::Trajectory flight = scenes::trajectory_from(track, {}, problems);
    for (const double share : {0.0, 0.3, 1.0}) {
      const core::Pose pose =
          flight.at(flight.begin_s() + share * (flight.end_s() - flight.begin_s()));
      fuzz::must(std::isfinite(pose.position.latitude_rad) &&
                     std::isfinite(pose.position.longitude_rad) &&
                     std::isfinite(pose.position.height_m) && std::isfinite(pose.q_NB.w),
                 "finite poses");
    }
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("flight.csv", fuzz::text_of(data, size));
  for (const scenes::OutlierPolicy policy :
       {scenes::OutlierPolicy::error, scenes::OutlierPolicy::reject, scenes::OutlierPolicy::keep}) {
    scenes::TrajectoryColumns own;
    own.outliers = policy;
    read_and_fly(file, own);
  }
  // Another form of the same table, through a window.
  scenes::TrajectoryColumns columns;
  columns.time = {"t", "ms", false};
  columns.height = {"alt", "ft", false};
  columns.first_row = 2;
  columns.to_time_s = 100.0;
  read_and_fly(file, columns);
  return 0;
}
