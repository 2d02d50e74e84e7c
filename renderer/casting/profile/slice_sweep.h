// Exact visibility inside one slice: the profile of ground, walls and roofs, walked from near to
// far under a running horizon.
//
// A point is visible when the tangent of its elevation is above that of everything nearer. Buildings
// are solid from the ground up, so the upper outline of ground and roofs is all there is; a wall
// shows where the outline jumps up. Pieces are cut exactly where the horizon crosses them.
//
// Buildings are clipped to the wedge: each wall in it counts with its width there, and hides what is
// behind it at its own headings alone (wedge_strips.h). The ground's heights and borders are those
// of the slice.
//
// Neglected: how much nearer one end of a wall's part is than its middle, in what it hides.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/ground_cut.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/wedge.h"
#include "renderer/casting/profile/wedge_strips.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

// A point in a wedge of which is asked whether it is seen.
struct SightPoint {
  double heading_rad = 0.0;
  double distance_m = 0.0;  // horizontal
  double height_m = 0.0;    // relative to the sensor
  std::size_t line = 0;     // index into SightLines
};

// Where the walk passes a wall, a painted border or a point asked for.
struct SliceEvent {
  double distance_m;
  const CutEdge* edge;   // none: a point
  std::uint32_t number;  // of the part of the wedge that the edge takes, or of the point
};

// Buffers that one thread keeps from slice to slice.
struct SweepScratch {
  GroundCut cut;
  std::vector<SliceEvent> events;
  std::vector<HeadingRange> parts;
  WedgeStrips strips;
};

class SliceSweep {
 public:
  // Ground below the tangent `darkest_tangent` is not shown: it only hides what is behind it.
  SliceSweep(const World& world, const glm::dvec3& sensor_m, const EdgeIndex& edges,
             double darkest_tangent, SweepScratch& scratch);

  // Walks `slice` out to `far_m`. `full` is called whenever `pieces` has no room left and must
  // empty it; what remains at the end stays there.
  using Full = std::function<void(VisiblePieces&)>;
  // Points [first, last) are tested against the horizon on the way; `clear` gets their answers.
  struct Sights {
    const SightPoint* first = nullptr;
    const SightPoint* last = nullptr;
    std::uint8_t* clear = nullptr;
  };
  void run(const Slice& slice, const EdgeIndex::Candidates& candidates, double far_m,
           VisiblePieces& pieces, const Full& full, const Sights& sights);

 private:
  void add_event(const SliceEvent& event);
  void find_events(const EdgeIndex::Candidates& candidates, double far_m);
  void pass(const SliceEvent& event, const ProfilePoint& at, std::size_t piece);
  void test(const SightPoint& point, const ProfilePoint& at, std::size_t piece);
  void enter(WedgeStrip& strip, const SliceEvent& event, double ground_m);
  void leave(WedgeStrip& strip, const SliceEvent& event);
  void walk_to(WedgeStrip& strip, const ProfilePoint& at, std::size_t piece);
  void walk_ground(WedgeStrip& strip, const ProfilePoint& near, const ProfilePoint& far,
                   std::size_t piece);
  void see_ground(WedgeStrip& strip, ProfilePoint near, const ProfilePoint& far, std::size_t piece);
  void see_wall(WedgeStrip& strip, const SliceEvent& event, double low_m, double top_m);
  void add_wall(const WallPart& part, double from_m, double top_m, const HeadingRange& range,
                const terrain::Solid& prism);
  void set_part(int i, const HeadingRange& part);
  void close_roof(WedgeStrip& strip, double distance_m);
  int next_piece();

  const World& world_;
  const terrain::HeightField* ground_;
  const terrain::SurfaceMap* map_;
  glm::dvec3 sensor_m_;
  const EdgeIndex& edges_;
  double darkest_tangent_;

  Wedge wedge_{Slice{}};
  GroundCut& cut_;
  std::vector<SliceEvent>& events_;
  std::vector<HeadingRange>& parts_;
  WedgeStrips& strips_;
  bool changed_ = false;  // strips may have become alike since they were joined
  VisiblePieces* pieces_ = nullptr;
  const Full* full_ = nullptr;
  Sights sights_;
};

}  // namespace fanbeam::renderer
