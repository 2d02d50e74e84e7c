#include "renderer/stages/wide_pieces.h"

#include <algorithm>

namespace fanbeam::renderer {
namespace {

double nearest2_m2(const VisiblePieces& pieces, int i) {
  const double near_m = pieces.near_distance_m[i], far_m = pieces.far_distance_m[i];
  const double near_z_m = pieces.near_height_m[i], far_z_m = pieces.far_height_m[i];
  return std::min(near_m * near_m + near_z_m * near_z_m, far_m * far_m + far_z_m * far_z_m);
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
    if (!(pieces.cross_m2[i] > 0.0)) continue;
    const int count = parts_of(pieces.cross_m2[i], nearest2_m2(pieces, i), kMostSpan_rad);
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
