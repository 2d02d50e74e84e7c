// What is where in the pictures of a frame: runways, approach lights, obstacles, buildings; where each
// lies by formula, how much of it is in sight, in which cells it sends most, and how it
// stands out.
//
// Positions are of place.h: geometry, no echoes. Masks are of the frame's layers
// (renderer/stages/frame_layers.h): a cell belongs to the object that sends it most.
//   in sight   of a runway: share of a grid of kRunwayGrid points; of an object: of its triangles that
//              face the antenna, weighted with the area that they show it and judged by their middles
//              (object_shapes.h); of point targets: share of the points
//   in view    the same shares of what lies inside the B-scope's sector and gate, hidden or not
//   signal to clutter   strongest cell of the mask in the B-scope over the noise plus the mean of the
//              cells within kRing rows of it, and as many columns behind the reach of the azimuth beam,
//              that lie more than a row and that reach away from the mask
// Touchdown zone: the first 900 m behind the threshold, or half of what lies beyond it where that is less
// than 1800 m, where its lights are (ICAO Annex 14, 5.3.13). Corners are those of the pavement. A runway's near end is the
// one whose threshold is nearer.
// Neglected: refraction; parts of an object smaller than a triangle.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "renderer/frame.h"
#include "scenes/scene.h"
#include "session/labels/object_shapes.h"
#include "session/labels/place.h"

namespace fanbeam::session {

inline constexpr int kRing = 8;
inline constexpr std::array<int, 2> kRunwayGrid = {100, 5};  // along, across

// Cells of a picture, its top row first.
struct MaskLabel {
  std::vector<std::uint32_t> cells{};            // column * rows + row, rising
  int left = 0, top = 0, columns = 0, rows = 0;  // the box around them
};

struct RunwayLabel {
  std::string near_end, far_end;  // "26", "08"
  double length_m = 0.0, width_m = 0.0;
  // Of the antenna: before the near threshold, right of the centre line as one lands, above the
  // threshold.
  double along_track_m = 0.0, cross_track_m = 0.0, above_m = 0.0;
  std::array<PlaceLabel, 4> corners;         // near left, near right, far right, far left
  std::array<PlaceLabel, 2> thresholds;      // near, far: the ends of the centre line too
  std::array<PlaceLabel, 4> touchdown_zone;  // as the corners
  double in_sight_share = 0.0, in_view_share = 0.0;
  MaskLabel bscope, cscope;  // pavement, shoulders and markings
};

enum class ObjectGroup { building, box, model, lights, target };
enum class Placement { on_runway, beside_runway, elsewhere };  // beside: in the strip around it

struct ObjectLabel {
  std::string name;
  ObjectGroup group{};
  Placement placement{};
  std::vector<std::uint32_t> ids;  // in layers: of all parts of a model, of targets of one name
  PlaceLabel middle;               // of the box around it; of solids in sight where any of it is
  // Top above the ground below its middle; of points, the most that one is above the ground below it.
  double height_m = 0.0;
  double in_sight_share = 0.0, in_view_share = 0.0;
  std::optional<double>
      signal_to_clutter_dB;  // where it sends most of a cell and others surround it
  MaskLabel bscope, cscope;
  std::vector<PlaceLabel> points;  // of lights
};

struct FrameLabels {
  std::vector<RunwayLabel> runways;
  std::vector<ObjectLabel> objects;  // of which some part is in view or some cell is lit
};

// What objects a scene has. Made once; for every scene that shares the site and its targets' names.
class Labeller {
 public:
  explicit Labeller(const scenes::Scene& scene);
  ~Labeller();
  Labeller(const Labeller&) = delete;
  Labeller& operator=(const Labeller&) = delete;

  // `frame` holds layers, those of the C-scope if there are masks to be of it, and bscope_W. `scene` is
  // the one that it was rendered of. Deterministic for any number of threads.
  FrameLabels labels(const scenes::Scene& scene, const core::Pose& pose,
                     const renderer::Frame& frame) const;

 private:
  struct Known;
  std::unique_ptr<const Known> known_;
};

}  // namespace fanbeam::session
