// Exact visibility inside one slice: the profile of ground, walls and roofs, walked from near to
// far under a running horizon.
//
// A point is visible when the tangent of its elevation is above that of everything nearer. Buildings
// are solid from the ground up, so the upper outline of ground and active roofs is all there is; a
// wall shows where the outline jumps up. Pieces are cut exactly where the horizon crosses them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "renderer/casting/profile/edge_index.h"
#include "renderer/casting/profile/ground_cut.h"
#include "renderer/casting/profile/slice.h"
#include "renderer/casting/profile/wall_front.h"
#include "renderer/world.h"

namespace fanbeam::renderer {

// A point of the profile.
struct ProfilePoint {
  double distance_m = 0.0;  // horizontal
  double height_m = 0.0;    // relative to the sensor
};

// A point in a slice of which is asked whether it is seen.
struct SightPoint {
  double distance_m = 0.0;  // horizontal
  double height_m = 0.0;    // relative to the sensor
  std::size_t line = 0;     // index into SightLines
};

// Where the walk passes a wall, a painted border or a point asked for.
struct SliceEvent {
  double distance_m;
  std::uint32_t edge;  // from the number of edges on: points
};

// Buffers that one thread keeps from slice to slice.
struct SweepScratch {
  GroundCut cut;
  std::vector<SliceEvent> events;
  WallFront front;
};

class SliceSweep {
 public:
  // Ground below the tangent `darkest_tangent` is not shown: it only hides what is behind it. With
  // `fronts` walls count as wall_front.h tells, else as far as the wedge goes.
  SliceSweep(const World& world, const glm::dvec3& sensor_m, const EdgeIndex& edges,
             double darkest_tangent, bool fronts, SweepScratch& scratch);

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
  void add_event(double distance_m, std::uint32_t edge);
  void test(const SightPoint& point, double at_m);
  void find_events(const EdgeIndex::Candidates& candidates, double far_m);
  void pass(const SliceEvent& event, double ground_m);
  void enter(const SliceEvent& event, const CutEdge& edge, double ground_m);
  void leave(double distance_m, std::uint32_t prism);
  void walk_ground(const ProfilePoint& near, const ProfilePoint& far, std::size_t piece);
  void see_ground(ProfilePoint near, const ProfilePoint& far, std::size_t piece);
  void see_wall(const SliceEvent& event, double low_m, double top_m);
  void add_wall(const WallPart& part, double from_m, double top_m, std::int32_t material);
  void close_roof(double distance_m);
  void find_top();
  bool visible(ProfilePoint& near, const ProfilePoint& far);
  int next_piece();

  const World& world_;
  const terrain::HeightField* ground_;
  const terrain::SurfaceMap* map_;
  glm::dvec3 sensor_m_;
  const EdgeIndex& edges_;
  double darkest_tangent_;
  bool fronts_;

  Wedge wedge_{Slice{}};
  GroundCut& cut_;
  std::vector<SliceEvent>& events_;
  WallFront& front_;
  VisiblePieces* pieces_ = nullptr;
  const Full* full_ = nullptr;
  Sights sights_;
  double horizon_tangent_ = 0.0;
  std::vector<std::uint32_t> active_;  // prisms around the walk
  std::vector<std::uint32_t> left_already_;
  bool roofed_ = false;
  double roof_m_ = 0.0;       // highest active roof, relative to the sensor
  double roof_from_m_ = 0.0;  // the roof is seen as far as here
  std::int32_t roof_material_ = 0;
};

}  // namespace fanbeam::renderer
