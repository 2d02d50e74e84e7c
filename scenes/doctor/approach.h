// How a flight comes down to a runway.
#pragma once

#include <optional>
#include <string>

#include "scenes/scene.h"

namespace fanbeam::scenes {

struct Approach {
  std::string runway;  // the end's name
  // Where the flight passes the threshold, or its nearest point when it ends before.
  bool passes_threshold = false;
  double before_threshold_m = 0.0;  // 0 where it passes
  double height_m = 0.0;            // over the threshold
  double right_m = 0.0;             // of the centre line, seen on landing
  // Of the straight line through the final approach: all that lies less than 10 km before the
  // threshold, at least 30 m over it (above the flare) and near the centre line (100 m and a fifth
  // of the distance). By least squares, without the Earth's curvature.
  double glide_path_rad = 0.0;
  double fitted_from_m = 0.0, fitted_to_m = 0.0;  // before the threshold
};

// Of all passes the one nearest to a threshold: one that comes to 5 km at least, along 500 m or
// more of final approach, which falls by 0.5 to 15 deg. Nothing when there is none.
// At most 20 000 poses are looked at, evenly spread; between two of them the path is straight.
std::optional<Approach> approach_of(const Scene& scene);

}  // namespace fanbeam::scenes
