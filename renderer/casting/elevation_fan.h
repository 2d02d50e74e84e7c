// Where to put rays in elevation so that every visible range cell of the ground gets its share.
//
// Equal angles give far cells almost nothing (rays per cell fall with R^2 at fixed height). The fan
// follows the terrain profile under one azimuth instead: wherever a range cell of ground is
// visible, its angular interval gets the rays asked for; hidden ground gets none. Above the highest
// ground the fan goes on to the top of the highest object, row by row of the C-scope: few rays, and
// what stands there shows against nothing. The fan only places samples: what they hit is decided by
// the caster.
//
// Azimuths of a tilted antenna, or a cone, have the gate's ends at elevations of their own: there the fan
// follows the ground under the first and the last azimuth as well.
//
// Of level ground range rises with elevation, above the lowest direction of an azimuth. Where the beam
// holds that direction (an antenna that looks down, is inverted or on its side), range falls with
// elevation below it: each part is followed from there outwards, where the nearest does not count in one row
// to just before the first range cell.
#pragma once

#include <cstddef>
#include <vector>

#include "core/constants.h"
#include "renderer/casting/sampling.h"
#include "renderer/world.h"
#include "sensors/antenna/antenna_frame.h"

namespace fanbeam::renderer {

class ElevationFan {
 public:
  // What is nearer than the first range cell shows nothing itself, but mirrors.
  enum class Nearest { first_cell, antenna };
  ElevationFan(const World& world, const Sampling& sampling, Nearest nearest = Nearest::first_cell);

  // Increasing elevations: `edges` bound the intervals that rays stand for. Azimuths from
  // `left_rad` to `right_rad`: those that see an elevation as it is, the middles of sub-columns in which
  // RayAim follows the range. Empty when nothing can be seen there.
  void place(const sensors::AntennaFrame& frame, double left_rad, double right_rad,
             std::vector<double>& edges) const;

 private:
  // How a column is followed: to where the ground lies in front, or, of a beam that holds the lowest
  // direction, upwards from there.
  enum class Way { in_front, from_lowest };
  bool holds_lowest(const sensors::AntennaFrame& frame, double azimuth_rad) const;
  void place_both_ways(const sensors::AntennaFrame& frame, double left_rad, double right_rad,
                       std::vector<double>& edges) const;
  void climb(const sensors::AntennaFrame& frame, double left_rad, double right_rad, Way way,
             double end_rad, std::vector<double>& edges) const;
  void follow_ground(const sensors::AntennaFrame& frame, double azimuth_rad, Way way,
                     double end_rad, std::vector<double>& edges) const;
  void follow_beside(const sensors::AntennaFrame& frame, double azimuth_rad, Way way,
                     double end_rad, std::size_t begun, std::vector<double>& edges) const;
  double highest_object_rad(const sensors::AntennaFrame& frame, double left_rad, double right_rad,
                            double low_rad, double end_rad) const;
  double highest_object_rad(const sensors::AntennaFrame& frame, const glm::dvec2& heading) const;
  void add_until(double elevation_rad, int parts, double largest_step_rad,
                 std::vector<double>& edges) const;

  const World& world_;
  Sampling sampling_;
  Nearest nearest_;
  double lowest_rad_ = 0.0;   // the elevation pattern is zero below
  double highest_rad_ = 0.0;  // and above
  // Largest step above the highest ground: a row of the C-scope.
  double object_step_rad_ = 0.0;
};

}  // namespace fanbeam::renderer
