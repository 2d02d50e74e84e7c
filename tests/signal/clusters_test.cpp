// DBSCAN against a plain quadratic version, and its documented order.
#include "signal/detection/clusters.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "core/errors.h"
#include "core/random.h"

using namespace fanbeam;
using namespace fanbeam::signal;

namespace {

std::vector<std::vector<double>> random_points(int count) {
  std::vector<std::vector<double>> points;
  for (int i = 0; i < count; ++i) {
    const auto pair =
        core::normal_pair({.seed = 5, .stream = 1001}, static_cast<std::uint64_t>(i), 0);
    // Three heaps and some stray points.
    const double centre = i % 10 == 0 ? 20.0 * pair[0] : 12.0 * (i % 3);
    points.push_back({centre + pair[0], 2.0 * pair[1]});
  }
  return points;
}

// Groups of cores by repeated joining, without any tree.
std::vector<int> plain_clusters(const std::vector<std::vector<double>>& points,
                                const std::vector<double>& scales, int least) {
  const std::size_t count = points.size();
  const auto near = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < scales.size(); ++i)
      sum += std::pow((points[a][i] - points[b][i]) / scales[i], 2);
    return sum <= 1.0;
  };
  std::vector<bool> core(count);
  for (std::size_t a = 0; a < count; ++a) {
    int neighbours = 0;
    for (std::size_t b = 0; b < count; ++b) neighbours += near(a, b) ? 1 : 0;
    core[a] = neighbours >= least;
  }
  std::vector<std::size_t> root(count);
  for (std::size_t i = 0; i < count; ++i) root[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b)
        if (core[a] && core[b] && root[b] < root[a] && near(a, b)) {
          root[a] = root[b];
          changed = true;
        }
  }
  std::map<std::size_t, int> number;
  for (std::size_t i = 0; i < count; ++i)
    if (core[i] && number.count(root[i]) == 0) {
      const int next = static_cast<int>(number.size());
      number[root[i]] = next;
    }
  std::vector<int> labels(count, kNoCluster);
  for (std::size_t i = 0; i < count; ++i) {
    if (core[i]) labels[i] = number[root[i]];
    if (core[i]) continue;
    for (std::size_t b = 0; b < count; ++b)
      if (core[b] && near(i, b) && (labels[i] == kNoCluster || number[root[b]] < labels[i]))
        labels[i] = number[root[b]];
  }
  return labels;
}

}  // namespace

TEST_CASE("clusters are those of the definition", "[clusters]") {
  const auto points = random_points(600);
  for (const int least : {1, 3, 8})
    for (const double scale : {0.4, 0.9}) {
      const auto labels = clusters(points, {scale, 2.0 * scale}, least);
      CHECK(labels == plain_clusters(points, {scale, 2.0 * scale}, least));
      if (least == 1) CHECK(std::count(labels.begin(), labels.end(), kNoCluster) == 0);
    }
  const auto labels = clusters(points, {0.9, 1.8}, 8);
  CHECK(*std::max_element(labels.begin(), labels.end()) >= 2);
  CHECK(std::count(labels.begin(), labels.end(), kNoCluster) > 5);
}

TEST_CASE("the groups do not depend on the order of the points", "[clusters]") {
  const auto points = random_points(300);
  auto reversed = points;
  std::reverse(reversed.begin(), reversed.end());
  const auto forward = clusters(points, {0.9, 1.8}, 1);
  const auto backward = clusters(reversed, {0.9, 1.8}, 1);
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      REQUIRE((forward[a] == forward[b]) ==
              (backward[points.size() - 1 - a] == backward[points.size() - 1 - b]));
}

TEST_CASE("a neighbour at distance 1 exactly counts, identical points too", "[clusters]") {
  CHECK(clusters({{0.0}, {2.0}, {4.5}}, {2.0}, 2) == std::vector<int>{0, 0, kNoCluster});
  CHECK(clusters({{1.0}, {1.0}, {1.0}}, {1.0}, 3) == std::vector<int>{0, 0, 0});
  CHECK(clusters({}, {1.0}, 1).empty());
}

TEST_CASE("detections of one car are one cluster, of two lanes or speeds two", "[clusters]") {
  const auto at = [](double range_m, double azimuth_rad, double speed_mps) {
    RadarDetection detection;
    detection.range_m = range_m;
    detection.azimuth_rad = azimuth_rad;
    detection.radial_speed_mps = speed_mps;
    return detection;
  };
  const auto labels =
      detection_clusters({at(50.0, 0.0, -5.0), at(51.0, 0.01, -5.2), at(50.5, 0.07, -5.0),
                          at(50.2, 0.0, 3.0), at(50.9, 0.068, -5.1)},
                         {});
  CHECK(labels == std::vector<int>{0, 0, 1, kNoCluster, 1});
}

TEST_CASE("points without a place are refused", "[clusters]") {
  CHECK_THROWS_AS(clusters({{std::nan("")}}, {1.0}, 1), core::InputError);
  CHECK_THROWS_AS(clusters({{1.0, 2.0}}, {1.0}, 1), core::InputError);
  CHECK_THROWS_AS(clusters({{1.0}}, {0.0}, 1), core::InputError);
  CHECK_THROWS_AS(clusters({{1.0}}, {1.0}, 0), core::InputError);
}
