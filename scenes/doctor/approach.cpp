#include "scenes/doctor/approach.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/constants.h"
#include "core/units.h"
#include "scenes/trajectory/trajectory_transplant.h"
#include "terrain/geoid.h"

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kMostPoses = 20'000;
constexpr double kFarthestFit_m = 10e3;
constexpr double kFarthestEnd_m = 5e3;
constexpr double kShortestFinal_m = 500.0;
constexpr double kAboveFlare_m = 30.0;
constexpr double kBeside_m = 100.0;
constexpr double kBesideShare = 0.2;
constexpr double kHighest_m = 1500.0;
constexpr double kShallowest_rad = core::radians(0.5);
constexpr double kSteepest_rad = core::radians(15.0);

RunwayEnd landing_on(const SceneDescription& scene, const RunwayDescription& runway, int end) {
  const RunwayEndDescription& near = runway.ends[end];
  const RunwayEndDescription& far = runway.ends[1 - end];
  const terrain::GeodesicLine line = terrain::geodesic_between(near.pavement_end, far.pavement_end);
  RunwayEnd landing{terrain::geodesic_point(near.pavement_end, line.azimuth_rad, near.displaced_m),
                    line.azimuth_rad};
  // The strip is the straight line between its ends.
  core::Geodetic& threshold = landing.threshold;
  threshold.height_m = std::lerp(near.pavement_end.height_m, far.pavement_end.height_m,
                                 near.displaced_m / line.length_m);
  threshold.height_m = terrain::ellipsoidal_height_m(threshold, scene.datum);
  return landing;
}

bool on_final(const RunwayRelative& at) {
  return at.before_threshold_m > 0.0 && at.before_threshold_m <= kFarthestFit_m &&
         std::abs(at.right_m) <= kBeside_m + kBesideShare * at.before_threshold_m &&
         std::abs(at.height_m) <= kHighest_m;
}

RunwayRelative passing(const RunwayRelative& from, const RunwayRelative& to) {
  const double s = from.before_threshold_m / (from.before_threshold_m - to.before_threshold_m);
  return {0.0, std::lerp(from.right_m, to.right_m, s), std::lerp(from.height_m, to.height_m, s)};
}

// The line through the final approach that ends with pose `last`.
bool fit(const std::vector<RunwayRelative>& path, std::size_t last, bool round_earth,
         Approach& approach) {
  double n = 0.0, sum_s = 0.0, sum_h = 0.0, sum_ss = 0.0, sum_sh = 0.0;
  double farthest_m = 0.0, nearest_m = kFarthestFit_m;
  for (std::size_t i = last + 1; i-- > 0;) {
    const RunwayRelative& at = path[i];
    if (!on_final(at) || at.before_threshold_m < farthest_m) break;
    farthest_m = at.before_threshold_m;
    if (at.height_m < kAboveFlare_m) continue;
    const double s_m = at.before_threshold_m;
    const double h_m =
        at.height_m - (round_earth ? s_m * s_m / (2.0 * core::kMeanEarthRadius_m) : 0.0);
    nearest_m = std::min(nearest_m, s_m);
    n += 1.0;
    sum_s += s_m;
    sum_h += h_m;
    sum_ss += s_m * s_m;
    sum_sh += s_m * h_m;
  }
  if (n < 3.0 || farthest_m - nearest_m < kShortestFinal_m) return false;
  const double glide_rad = std::atan((n * sum_sh - sum_s * sum_h) / (n * sum_ss - sum_s * sum_s));
  approach.glide_path_rad = glide_rad;
  approach.fitted_from_m = farthest_m;
  approach.fitted_to_m = nearest_m;
  return glide_rad >= kShallowest_rad && glide_rad <= kSteepest_rad;
}

class ApproachSearch {
 public:
  explicit ApproachSearch(const Scene& scene) : scene_(scene) {
    const std::vector<core::Pose>& poses = scene.trajectory->poses();
    const std::size_t count = std::min(poses.size(), kMostPoses);
    for (std::size_t k = 0; k < count; ++k)
      positions_.push_back(poses[count > 1 ? k * (poses.size() - 1) / (count - 1) : 0].position);
  }

  void land_on(const RunwayDescription& runway, int end) {
    const RunwayEnd landing = landing_on(scene_.description, runway, end);
    std::vector<RunwayRelative> path;
    path.reserve(positions_.size());
    for (const core::Geodetic& position : positions_)
      path.push_back(relative_to(landing, position));
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (!on_final(path[i])) continue;
      const bool last = i + 1 == path.size();
      if (!last && path[i + 1].before_threshold_m <= 0.0)
        take(runway.ends[end].name, path, i, passing(path[i], path[i + 1]), true);
      else if (last || path[i + 1].before_threshold_m > path[i].before_threshold_m)
        take(runway.ends[end].name, path, i, path[i], false);
    }
  }

  const std::optional<Approach>& nearest() const { return nearest_; }

 private:
  void take(const std::string& runway, const std::vector<RunwayRelative>& path, std::size_t last,
            const RunwayRelative& end, bool passes) {
    const double distance_m = std::hypot(end.before_threshold_m, end.right_m, end.height_m);
    if (distance_m > kFarthestEnd_m || (nearest_ && distance_m >= distance_m_)) return;
    Approach approach{runway, passes, end.before_threshold_m, end.height_m, end.right_m};
    const bool round = scene_.frame.model() == terrain::EarthModel::wgs84;
    if (!fit(path, last, round, approach)) return;
    nearest_ = approach;
    distance_m_ = distance_m;
  }

  const Scene& scene_;
  std::vector<core::Geodetic> positions_;
  std::optional<Approach> nearest_;
  double distance_m_ = 0.0;
};

}  // namespace

std::optional<Approach> approach_of(const Scene& scene) {
  if (!scene.trajectory || scene.trajectory->poses().size() < 2) return std::nullopt;
  ApproachSearch search(scene);
  for (const RunwayDescription& runway : scene.description.runways)
    for (const int end : {0, 1}) search.land_on(runway, end);
  return search.nearest();
}

}  // namespace fanbeam::scenes
