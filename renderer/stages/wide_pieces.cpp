#include "renderer/stages/wide_pieces.h"

#include <algorithm>

namespace fanbeam::renderer {
namespace {

// Into how many parts a piece goes that is seen under a wide angle.
int parts_needed(const VisiblePieces& pieces, int i) {
  const auto range2_m2 = [](double distance_m, double height_m) {
    return distance_m * distance_m + height_m * height_m;
  };
  const double nearest2_m2 = std::min(range2_m2(pieces.near_distance_m[i], pieces.near_height_m[i]),
                                      range2_m2(pieces.far_distance_m[i], pieces.far_height_m[i]));
  constexpr double kMost = 1000.0;
  const double one_m2 = kMostSpan_rad * nearest2_m2;
  return pieces.cross_m2[i] < one_m2
             ? 1
             : 1 + static_cast<int>(std::min(pieces.cross_m2[i] / (one_m2 + 1e-12), kMost));
}

// Piece `from` becomes `pieces[to]`, all of it or the part between two shares of its way.
void copy_part(const VisiblePieces& from, int i, double begin, double end, VisiblePieces& pieces,
               int to) {
  const double step_m = from.far_distance_m[i] - from.near_distance_m[i];
  const double rise_m = from.far_height_m[i] - from.near_height_m[i];
  const double near_m = from.near_distance_m[i], height_m = from.near_height_m[i];
  pieces.far_distance_m[to] = end == 1.0 ? from.far_distance_m[i] : near_m + end * step_m;
  pieces.far_height_m[to] = end == 1.0 ? from.far_height_m[i] : height_m + end * rise_m;
  pieces.near_distance_m[to] = near_m + begin * step_m;
  pieces.near_height_m[to] = height_m + begin * rise_m;
  pieces.cross_m2[to] = from.cross_m2[i] * (end - begin);
  pieces.facet_m[to] = from.facet_m[i];
  pieces.facet_d2[to] = from.facet_d2[i];
  pieces.material[to] = from.material[i];
  pieces.object[to] = from.object[i];
  pieces.nearer_m[to] = from.nearer_m[i];
  pieces.farther_m[to] = from.farther_m[i];
  pieces.right_nearer[to] = from.right_nearer[i];
  pieces.share[to] = from.share[i];
  pieces.left[to] = from.left[i];
}

}  // namespace

void split_wide_pieces(VisiblePieces& pieces, VisiblePieces& parts, const SliceSweep::Full& full) {
  int kept = 0;
  for (int i = 0; i < pieces.count; ++i) {
    const int count = parts_needed(pieces, i);
    if (count == 1) {
      if (kept != i) copy_part(pieces, i, 0.0, 1.0, pieces, kept);
      ++kept;
      continue;
    }
    for (int k = 0; k < count; ++k) {
      if (parts.full()) full(parts);
      copy_part(pieces, i, static_cast<double>(k) / count, (k + 1.0) / count, parts, parts.count++);
    }
  }
  pieces.count = kept;
}

}  // namespace fanbeam::renderer
