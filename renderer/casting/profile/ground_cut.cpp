#include "renderer/casting/profile/ground_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dispatch.h"

namespace fanbeam::renderer {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// At a post up to three lines are crossed at once.
constexpr double kSmallestPiece_m = 1e-9;
constexpr double kOnRim = 1e-9;  // cells

// The part of the half-line inside [0, cells] along one axis.
void clip_axis(double from, double per_m, double cells, double& near_m, double& far_m) {
  if (per_m == 0.0) {
    // Along a rim, a hair beside it by rounding counts as on it.
    if (from < -kOnRim || from > cells + kOnRim) far_m = -1.0;
    return;
  }
  const double a_m = -from / per_m, b_m = (cells - from) / per_m;
  near_m = std::max(near_m, std::min(a_m, b_m));
  far_m = std::min(far_m, std::max(a_m, b_m));
}

// Grid lines of one family in the order in which the cut meets them.
struct Crossings {
  double next_m = kNever;
  double step_m = 0.0;
  double base_m = 0.0;
  int line = 0;  // the whole number that is met next
  int direction = 0;
  int count = 0;

  // Lines at whole numbers of a coordinate that is `from` at distance 0 and rises by `per_m`;
  // the first one behind `near_m`.
  Crossings(double from, double per_m, double near_m) {
    if (per_m == 0.0) return;
    const double at_near = from + per_m * near_m;
    direction = per_m > 0.0 ? 1 : -1;
    line = static_cast<int>(per_m > 0.0 ? std::floor(at_near) + 1.0 : std::ceil(at_near) - 1.0);
    base_m = (line - from) / per_m;
    step_m = 1.0 / std::abs(per_m);
    next_m = base_m;
  }
  void advance() {
    next_m = base_m + step_m * ++count;
    line += direction;
  }
};

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a loop that was measured as it stands.
FANBEAM_HOT(void, cut_ground,
            (const terrain::HeightField& ground, const glm::dvec2& origin_m,
             const glm::dvec2& along, double far_m, double zero_m, GroundCut& cut),
            (ground, origin_m, along, far_m, zero_m, cut)) {
  cut.pieces = 0;
  const double per_spacing = 1.0 / ground.spacing_m;
  const double u0 = (origin_m.x - ground.west_m) * per_spacing, u_per_m = along.x * per_spacing;
  const double v0 = (origin_m.y - ground.south_m) * per_spacing, v_per_m = along.y * per_spacing;
  double near_m = 0.0;
  clip_axis(u0, u_per_m, ground.columns - 1, near_m, far_m);
  clip_axis(v0, v_per_m, ground.rows - 1, near_m, far_m);
  if (!(far_m > near_m)) return;

  const double* height = ground.height_m.data();
  const auto stride = static_cast<std::ptrdiff_t>(ground.columns);
  const int last_column = ground.columns - 2, last_row = ground.rows - 2;
  const auto cell = [](double at, int last) { return std::clamp(static_cast<int>(at), 0, last); };
  const double span_m = far_m - near_m;
  const auto most =
      static_cast<std::size_t>(2.0 * span_m * (std::abs(u_per_m) + std::abs(v_per_m)) +
                               8.0);  // diagonals: their sum at most
  if (cut.distance_m.size() < most + 1) {
    cut.distance_m.resize(most + 1);
    cut.height_m.resize(most + 1);
    cut.cells.resize(most);
  }
  double* distance_of = cut.distance_m.data();
  double* height_of = cut.height_m.data();
  GroundCut::Cell* cell_of = cut.cells.data();
  std::size_t pieces = 0;
  const auto height_at = [&](double distance_m) {
    const double u = u0 + u_per_m * distance_m, v = v0 + v_per_m * distance_m;
    const int i = cell(u, last_column), j = cell(v, last_row);
    const double a = u - i, b = v - j;
    const double* sw = height + j * stride + i;
    return a < b ? sw[0] + b * (sw[stride] - sw[0]) + a * (sw[stride + 1] - sw[stride])
                 : sw[0] + a * (sw[1] - sw[0]) + b * (sw[stride + 1] - sw[1]);
  };
  // Which triangle a piece lies in follows from its middle: no state to lose at corners.
  const auto add_piece = [&](double to_m, double height_m) {
    const double middle_m = (distance_of[pieces] + to_m) / 2;
    const double u = u0 + u_per_m * middle_m, v = v0 + v_per_m * middle_m;
    const int i = cell(u, last_column), j = cell(v, last_row);
    cell_of[pieces++] = {i, j, u - i < v - j};
    distance_of[pieces] = to_m;
    height_of[pieces] = height_m - zero_m;
  };

  Crossings column(u0, u_per_m, near_m), row(v0, v_per_m, near_m),
      diagonal(u0 - v0, u_per_m - v_per_m, near_m);
  distance_of[0] = near_m;
  height_of[0] = height_at(near_m) - zero_m;
  for (;;) {
    const double next_m = std::min({column.next_m, row.next_m, diagonal.next_m});
    if (next_m >= far_m) break;
    const double u = u0 + u_per_m * next_m, v = v0 + v_per_m * next_m;
    double height_m;
    if (next_m == column.next_m) {
      const int j = cell(v, last_row);
      const double* south = height + j * stride + column.line;
      height_m = south[0] + (v - j) * (south[stride] - south[0]);
      column.advance();
    } else if (next_m == row.next_m) {
      const int i = cell(u, last_column);
      const double* west = height + row.line * stride + i;
      height_m = west[0] + (u - i) * (west[1] - west[0]);
      row.advance();
    } else {
      const int i = cell(u, last_column), j = i - diagonal.line;
      const double* sw = height + j * stride + i;
      // Rounding on a rim may name a cell that is not there.
      height_m =
          j >= 0 && j <= last_row ? sw[0] + (u - i) * (sw[stride + 1] - sw[0]) : height_at(next_m);
      diagonal.advance();
    }
    if (next_m - distance_of[pieces] >= kSmallestPiece_m) add_piece(next_m, height_m);
  }
  add_piece(far_m, height_at(far_m));
  cut.pieces = pieces;
}

}  // namespace fanbeam::renderer
