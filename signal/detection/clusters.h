// Groups detections of one object by density: DBSCAN.
//
// A point with at least `least_neighbours` points (itself included) within distance 1 is a core;
// cores within distance 1 of each other share a cluster, and so do the other points near a core.
// The rest is noise. Distances are Euclidean after each coordinate is divided by its scale, so that
// range, speed and place can be mixed. Clusters are numbered by their first core; a point near
// cores of two clusters goes to the one with the lower number: the result does not depend on the
// search's order, and permuting the points permutes the groups (up to such shared points).
//
// Source: M. Ester et al., "A density-based algorithm for discovering clusters", KDD 1996.
// Inputs: finite coordinates, 1 to 8 of them, the same number for every point; positive scales;
// least neighbours 1 or more. E-RANGE, E-NONFINITE otherwise. Cost: n log n by a k-d tree.
#pragma once

#include <vector>

#include "signal/detection/detections.h"

namespace fanbeam::signal {

inline constexpr int kNoCluster = -1;

// Cluster number of each point, from 0, or kNoCluster.
std::vector<int> clusters(const std::vector<std::vector<double>>& points,
                          const std::vector<double>& scales, int least_neighbours);

struct ClusterScales {
  double place_m = 2.0;  // forward and right
  double speed_mps = 1.0;
  int least_neighbours = 2;
};

// Detections by place on the ground plane and radial speed.
std::vector<int> detection_clusters(const std::vector<RadarDetection>& detections,
                                    const ClusterScales& scales);

}  // namespace fanbeam::signal
