// The outlines and lines of X-Plane's apt.dat, rows 111 to 116, with their curves made into short
// straight pieces.
//
// Rows 111 and 112 are corners, without and with a control point of a Bezier curve; 113 and 114 the
// same, closing the ring; 115 and 116 end an open line. Between two corners the curve is quadratic when
// one of them has a control point, cubic when both have; the one before a corner is its mirror image
// ("Airport Data (apt.dat) File Specification", Laminar Research, format 1100). A piece is an eighth of
// a curve: off a quarter of a circle by 0.5 % of its radius. A curve goes the short way over the date line.
#pragma once

#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"

namespace fanbeam::scenes {

// Heights are not used.
using AirportLine = std::vector<core::Geodetic>;

class AptOutline {
 public:
  // Of a row's fields, the code first. E-PARSE, E-NONFINITE, E-RANGE for what is no position.
  void add(const std::vector<std::string_view>& fields, const core::Place& place,
           core::ProblemList& problems);

  // Corners after the last row that ended a ring or line.
  bool is_open() const { return !nodes_.empty(); }
  // Those closed by a row 113 or 114, the last point not the first again; of three points or more.
  const std::vector<AirportLine>& rings() const { return rings_; }
  // Along which taxiway edge lights stand (lighting code 102).
  const std::vector<AirportLine>& edge_lights() const { return edge_lights_; }

 private:
  struct Node {
    double latitude_rad = 0.0, longitude_rad = 0.0;
    double control_latitude_rad = 0.0, control_longitude_rad = 0.0;
    bool curved = false, edge_lit = false;
  };
  void finish(bool closed);
  static AirportLine pieces(const Node& from, const Node& to);

  std::vector<Node> nodes_;  // of the ring or line at hand
  std::vector<AirportLine> rings_, edge_lights_;
};

}  // namespace fanbeam::scenes
