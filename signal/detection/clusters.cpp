#include "signal/detection/clusters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nanoflann.hpp>
#include <utility>

#include "core/errors.h"

namespace fanbeam::signal {
namespace {

// Points in the form that the k-d tree reads.
struct Cloud {
  std::size_t dimensions = 0;
  std::vector<double> values;  // point * dimensions + coordinate, scaled

  std::size_t kdtree_get_point_count() const {
    return dimensions == 0 ? 0 : values.size() / dimensions;
  }
  double kdtree_get_pt(std::size_t point, std::size_t coordinate) const {
    return values[point * dimensions + coordinate];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud,
                                                 -1, std::uint32_t>;

Cloud scaled_cloud(const std::vector<std::vector<double>>& points,
                   const std::vector<double>& scales) {
  if (scales.empty() || scales.size() > 8)
    core::throw_input_error(core::ErrorClass::range, "scales", static_cast<double>(scales.size()),
                            "1 to 8 of them");
  for (const double scale : scales)
    if (!(scale > 0.0 && std::isfinite(scale)))
      core::throw_input_error(core::ErrorClass::range, "scales", scale, "positive and finite");
  Cloud cloud;
  cloud.dimensions = scales.size();
  cloud.values.reserve(points.size() * scales.size());
  for (const auto& point : points) {
    if (point.size() != scales.size())
      core::throw_input_error(core::ErrorClass::range, "points", static_cast<double>(point.size()),
                              "as many coordinates as scales");
    for (std::size_t i = 0; i < point.size(); ++i) {
      if (!std::isfinite(point[i]))
        core::throw_input_error(core::ErrorClass::nonfinite, "points", point[i], "finite");
      cloud.values.push_back(point[i] / scales[i]);
    }
  }
  return cloud;
}

// Indices within distance 1 of each point, itself included, ascending.
std::vector<std::vector<std::uint32_t>> neighbourhoods(const Cloud& cloud) {
  const Tree tree(static_cast<Tree::Dimension>(cloud.dimensions), cloud,
                  nanoflann::KDTreeSingleIndexAdaptorParams(10));
  std::vector<std::vector<std::uint32_t>> all(cloud.kdtree_get_point_count());
  std::vector<std::pair<std::uint32_t, double>> found;
  nanoflann::SearchParams unsorted;
  unsorted.sorted = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // The library's radius is squared and excludes its rim.
    const double radius = std::nextafter(1.0, 2.0);
    tree.radiusSearch(&cloud.values[i * cloud.dimensions], radius, found, unsorted);
    for (const auto& neighbour : found) all[i].push_back(neighbour.first);
    std::sort(all[i].begin(), all[i].end());
  }
  return all;
}

}  // namespace

std::vector<int> clusters(const std::vector<std::vector<double>>& points,
                          const std::vector<double>& scales, int least_neighbours) {
  if (least_neighbours < 1)
    core::throw_input_error(core::ErrorClass::range, "least_neighbours", least_neighbours,
                            "1 or more");
  const Cloud cloud = scaled_cloud(points, scales);
  std::vector<int> labels(points.size(), kNoCluster);
  if (points.empty()) return labels;
  const auto near = neighbourhoods(cloud);
  const auto is_core = [&](std::size_t i) {
    return near[i].size() >= static_cast<std::size_t>(least_neighbours);
  };
  int next = 0;
  for (std::size_t seed = 0; seed < points.size(); ++seed) {
    if (labels[seed] != kNoCluster || !is_core(seed)) continue;
    std::vector<std::size_t> open = {seed};
    labels[seed] = next;
    while (!open.empty()) {
      const std::size_t point = open.back();
      open.pop_back();
      for (const std::uint32_t other : near[point]) {
        if (labels[other] != kNoCluster) continue;
        labels[other] = next;
        if (is_core(other)) open.push_back(other);
      }
    }
    ++next;
  }
  return labels;
}

std::vector<int> detection_clusters(const std::vector<RadarDetection>& detections,
                                    const ClusterScales& scales) {
  std::vector<std::vector<double>> points;
  points.reserve(detections.size());
  for (const RadarDetection& detection : detections) {
    const double ground_m = detection.range_m * std::cos(detection.elevation_rad);
    points.push_back({ground_m * std::cos(detection.azimuth_rad),
                      ground_m * std::sin(detection.azimuth_rad), detection.radial_speed_mps});
  }
  return clusters(points, {scales.place_m, scales.place_m, scales.speed_mps},
                  scales.least_neighbours);
}

}  // namespace fanbeam::signal
