#include "renderer/stages/layer_pieces.h"

#include <algorithm>
#include <cmath>

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

// Takes piece `from` into piece `to` if it goes on in its plane. What both span stays so small that range, pattern
// and NRCS are those of one piece: farther ends at most 10 % farther, and half of kMostSpan_rad.
bool join(VisiblePieces& pieces, int to, int from) {
  constexpr double kOnePlane = 2e-3, kOneTilt = 1e-4, kFarther = 1.1;
  const auto alike = [&](const auto& column) { return column[to] == column[from]; };
  const double facet_m = pieces.facet_m[to], d2 = pieces.facet_d2[to];
  if (!(std::abs(pieces.facet_m[from] - facet_m) <= kOnePlane * facet_m) ||
      !(std::abs(pieces.facet_d2[from] - d2) <= kOneTilt * d2) ||
      pieces.near_distance_m[from] != pieces.far_distance_m[to] ||
      pieces.near_height_m[from] != pieces.far_height_m[to] ||
      !(pieces.far_distance_m[from] <= kFarther * pieces.near_distance_m[to]))
    return false;
  if (!alike(pieces.material) || !alike(pieces.object) || !alike(pieces.share) ||
      !alike(pieces.left) || pieces.farther_m[to] > 0.0 || pieces.farther_m[from] > 0.0)
    return false;
  const double cross_m2 = pieces.cross_m2[to] + pieces.cross_m2[from];
  if (!(cross_m2 <= kMostSpan_rad / 2 * nearest2_m2(pieces, to))) return false;
  pieces.cross_m2[to] = cross_m2;
  pieces.far_distance_m[to] = pieces.far_distance_m[from];
  pieces.far_height_m[to] = pieces.far_height_m[from];
  return true;
}

}  // namespace

void fit_pieces(VisiblePieces& pieces, VisiblePieces& parts, const SliceSweep::Full& full) {
  int kept = 0;
  for (int i = 0; i < pieces.count; ++i) {
    if (!(pieces.cross_m2[i] > 0.0)) continue;
    if (kept > 0 && join(pieces, kept - 1, i)) continue;
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
