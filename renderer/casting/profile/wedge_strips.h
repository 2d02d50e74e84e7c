// What is seen across the wedge of a slice, as its walk has found so far.
//
// Walls end at some heading: beside a building's corner the wedge sees past it. The wedge is split
// there, and each strip keeps a horizon and roofs of its own until the walk finds them alike again,
// which they are behind the next ground that both see.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "renderer/casting/profile/wedge.h"
#include "terrain/buildings/solids.h"

namespace fanbeam::renderer {

// A point of the profile.
struct ProfilePoint {
  double distance_m = 0.0;  // horizontal
  double height_m = 0.0;    // relative to the sensor
};

struct WedgeStrip {
  static constexpr double kBelowEverything = -1e300;

  HeadingRange range;
  double horizon_tangent = kBelowEverything;
  ProfilePoint walked;               // its ground is dealt with as far as here
  double roof_m = kBelowEverything;  // highest roof here, relative to the sensor
  double roof_from_m = 0.0;          // the roof is seen as far as here
  terrain::MaterialId roof_material = 0;
  terrain::ObjectId roof_object = terrain::kTerrainObject;
  std::uint32_t prisms = 0;  // number of WedgeStrips' PrismsAround
  bool roofed = false;
};

// The strips of one wedge from left to right.
class WedgeStrips {
 public:
  // One strip, inside the given prisms.
  void reset(const HeadingRange& wedge, const std::vector<std::uint32_t>& inside);

  // The strips that make up `part` of the wedge, split off where they must be.
  struct Span {
    WedgeStrip* first;
    WedgeStrip* last;
    WedgeStrip* begin() const { return first; }
    WedgeStrip* end() const { return last; }
  };
  Span within(const HeadingRange& part);
  Span all() { return {strips_.data(), strips_.data() + strips_.size()}; }
  WedgeStrip& at(double heading_rad);
  bool one() const { return strips_.size() == 1; }
  // Joins neighbours in which all is alike but how far they have been walked.
  void join();

  // Whether all of `part` lies outdoors behind a horizon not below `tangent`: then nothing changes
  // at the walls of a building that is nowhere higher.
  bool hide(double tangent, const HeadingRange& part) const;
  // Into a prism and out of it; false where nothing changes with that: it is hidden whole, or the
  // other way was found before.
  bool enter(const WedgeStrip& strip, std::uint32_t prism, double highest_tangent);
  bool leave(const WedgeStrip& strip, std::uint32_t prism, double highest_tangent);
  // After either: the highest roof.
  void find_roof(WedgeStrip& strip, const std::vector<terrain::Solid>& prisms,
                 double sensor_height_m) const;

 private:
  // Kept apart, so that strips are moved and copied as they are.
  struct PrismsAround {
    std::vector<std::uint32_t> inside;
    // Left before they were entered: rounding at a corner may put the way out first.
    std::vector<std::uint32_t> left_already;
    bool operator==(const PrismsAround&) const = default;
  };

  std::size_t split(double heading_rad);
  bool alike(const WedgeStrip& a, const WedgeStrip& b) const;

  std::vector<WedgeStrip> strips_;
  std::vector<PrismsAround> prisms_;
  std::vector<std::uint32_t> free_;  // numbers of prisms_ that no strip holds
};

}  // namespace fanbeam::renderer
