// The wedge that a slice stands for, seen from above, and what of a wall it holds.
//
// A wall is clipped to the wedge, or to the part of it in which the wall is seen: it counts with its
// true width whether or not the slice itself cuts it. Its distance is that in the middle of the
// part; how much nearer and farther it is at the part's ends goes along.
#pragma once

#include <algorithm>

#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/slice.h"

namespace fanbeam::renderer {

// Clockwise from the antenna's forward axis, like the headings of slices and edges.
struct HeadingRange {
  double left_rad = 0.0, right_rad = 0.0;

  double width_rad() const { return right_rad - left_rad; }
  double middle_rad() const { return (left_rad + right_rad) / 2; }
};

// A straight piece of a wall.
struct WallPart {
  double distance_m = 0.0;                 // horizontal, in its middle
  double nearer_m = 0.0, farther_m = 0.0;  // of its ends: at most 0, at least 0
  bool right_nearer = false;
  double facet_m = 0.0;  // from the sensor to the wall's plane
};

class Wedge {
 public:
  explicit Wedge(const Slice& slice);

  const Slice& slice() const { return slice_; }
  const HeadingRange& range() const { return range_; }
  // The headings at which an edge stands in the wedge; at most 0 wide: none.
  HeadingRange clip(const CutEdge& edge) const {
    return {std::max(std::min(edge.from_rad, edge.to_rad), range_.left_rad),
            std::min(std::max(edge.from_rad, edge.to_rad), range_.right_rad)};
  }
  // In the middle of `part`, which both the wedge and the edge contain; never beyond the edge.
  double distance_m(const CutEdge& edge, const HeadingRange& part) const;
  WallPart wall(const CutEdge& edge, const HeadingRange& part) const;

 private:
  glm::dvec2 toward(double heading_rad) const;

  Slice slice_;
  HeadingRange range_;
  glm::dvec2 left_, right_;  // unit vectors
};

}  // namespace fanbeam::renderer
