#include "scenes/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/constants.h"

namespace fanbeam::scenes {
namespace {

constexpr double kFinest_m = 64.0;
constexpr int kMostLooks = 100'000;

struct Box {
  glm::dvec2 low_m, high_m;
};

// The rays that a square mirrors.
struct ClimbingRays {
  double from_m = 0.0;   // height, at least
  double tangent = 0.0;  // at least
  double reach_m = 0.0;  // at most
  glm::dvec2 ahead{1.0, 0.0};
  double spread_rad = core::kPi;  // to either side
};

}  // namespace

void Relief::Square::add(const Square& other) {
  low_m = std::min(low_m, other.low_m);
  high_m = std::max(high_m, other.high_m);
  least = glm::min(least, other.least);
  most = glm::max(most, other.most);
}

Relief::Relief(const terrain::HeightField& ground) : corner_m_(ground.west_m, ground.south_m) {
  add_finest(ground);
  while (levels_.back().squares.size() > 1) add_coarser();
}

void Relief::add_finest(const terrain::HeightField& ground) {
  int cells = 1;
  while (2 * cells * ground.spacing_m <= kFinest_m) cells *= 2;
  Level& level = levels_.emplace_back();
  level.columns = (ground.columns - 2) / cells + 1;
  level.rows = (ground.rows - 2) / cells + 1;
  level.size_m = cells * ground.spacing_m;
  level.squares.resize(static_cast<std::size_t>(level.columns) *
                       static_cast<std::size_t>(level.rows));
  // A post is off by 2^-24 of the largest coordinate each way, a difference by twice that: a gradient
  // up to 1 by four times that over the spacing, and as much again for the normal's own arithmetic.
  const auto [lowest, highest] =
      std::minmax_element(ground.height_m.begin(), ground.height_m.end());
  const double largest_m =
      std::max({std::abs(ground.west_m), std::abs(ground.east_m()), std::abs(ground.south_m),
                std::abs(ground.north_m()), *highest - *lowest});
  const auto error = static_cast<float>(0x1p-21 * std::max(largest_m / ground.spacing_m, 1.0));
  for (int j = 0; j + 1 < ground.rows; ++j)
    for (int i = 0; i + 1 < ground.columns; ++i) {
      const double sw = ground.height_m[ground.post(i, j)];
      const double se = ground.height_m[ground.post(i + 1, j)];
      const double nw = ground.height_m[ground.post(i, j + 1)];
      const double ne = ground.height_m[ground.post(i + 1, j + 1)];
      const glm::vec2 south(glm::dvec2(se - sw, ne - se) / ground.spacing_m);
      const glm::vec2 north(glm::dvec2(ne - nw, nw - sw) / ground.spacing_m);
      level
          .squares[static_cast<std::size_t>(j / cells) * static_cast<std::size_t>(level.columns) +
                   static_cast<std::size_t>(i / cells)]
          .add({static_cast<float>(std::min({sw, se, nw, ne})),
                static_cast<float>(std::max({sw, se, nw, ne})), glm::min(south, north) - error,
                glm::max(south, north) + error});
    }
}

void Relief::add_coarser() {
  const Level& fine = levels_.back();
  Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, 2.0 * fine.size_m, {}};
  coarse.squares.resize(static_cast<std::size_t>(coarse.columns) *
                        static_cast<std::size_t>(coarse.rows));
  for (int row = 0; row < fine.rows; ++row)
    for (int column = 0; column < fine.columns; ++column)
      coarse
          .squares[static_cast<std::size_t>(row / 2) * static_cast<std::size_t>(coarse.columns) +
                   static_cast<std::size_t>(column / 2)]
          .add(fine.at(column, row));
  levels_.push_back(std::move(coarse));
}

class Relief::Search {
 public:
  Search(const Relief& relief, const glm::dvec3& antenna_m, double farthest_m,
         const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& may_mirror)
      : relief_(relief), antenna_m_(antenna_m), farthest_m_(farthest_m), may_mirror_(may_mirror) {}

  bool anything() { return mirrors_into_ground({relief_.levels_.size() - 1, 0, 0}); }

 private:
  struct Place {
    std::size_t level;
    int column, row;
  };

  const Square& square_at(const Place& at) const {
    return relief_.levels_[at.level].at(at.column, at.row);
  }
  Box box_of(const Place& at) const {
    const double size_m = relief_.levels_[at.level].size_m;
    const glm::dvec2 low_m = relief_.corner_m_ + size_m * glm::dvec2(at.column, at.row);
    return {low_m, low_m + size_m};
  }
  template <class May>
  bool any_quarter(const Place& of, const May& may) {
    const Level& finer = relief_.levels_[of.level - 1];
    for (int row = 2 * of.row; row < std::min(2 * of.row + 2, finer.rows); ++row)
      for (int column = 2 * of.column; column < std::min(2 * of.column + 2, finer.columns);
           ++column)
        if (may(Place{of.level - 1, column, row})) return true;
    return false;
  }

  // The most that ground rises in the directions within `spread_rad` of a level unit vector.
  static double rise(const Square& square, const glm::dvec2& ahead, double spread_rad) {
    const glm::dvec2 least(square.least), most(square.most);
    const double steepest = glm::length(glm::max(glm::abs(least), glm::abs(most)));
    const glm::dvec2 along = glm::max(least * ahead, most * ahead);
    return std::min(along.x + along.y + 2.0 * std::sin(spread_rad / 2.0) * steepest, steepest);
  }

  // Nothing where a mirrored ray may go down. The square has ground nearer than the farthest range.
  std::optional<ClimbingRays> mirrored(const Place& at, double near_m, double nearest_m) const {
    const Box box = box_of(at);
    const Square& square = square_at(at);
    const glm::dvec2 antenna_m(antenna_m_);
    const double far_m = std::min(
        glm::length(glm::max(glm::abs(box.low_m - antenna_m), glm::abs(box.high_m - antenna_m))),
        farthest_m_);
    const double low_m = static_cast<double>(square.low_m) - kRayError_m;
    const double above_m = antenna_m_.z - static_cast<double>(square.high_m) - kRayError_m;
    const double most_above_m = antenna_m_.z - low_m;
    ClimbingRays rays;
    const glm::dvec2 to_m = (box.low_m + box.high_m) / 2.0 - antenna_m;
    const double middle_m = glm::length(to_m);
    const double half_m = glm::distance(box.low_m, box.high_m) / 2.0;
    if (middle_m > 0.0) rays.ahead = to_m / middle_m;
    const double aside_rad = middle_m > half_m ? std::asin(half_m / middle_m) : core::kPi;
    const double steepest = rise(square, rays.ahead, core::kPi);
    const double least = -rise(square, -rays.ahead, aside_rad);
    const double climb_m =
        2.0 * least * (least < 0.0 ? far_m : near_m) + above_m * (1.0 - steepest * steepest);
    if (!(above_m > 0.0 && steepest < 1.0 && climb_m > 0.0)) return std::nullopt;
    const double sine = climb_m / ((1.0 + steepest * steepest) * std::hypot(far_m, most_above_m));
    rays.from_m = low_m;
    rays.tangent = sine / std::sqrt(std::max(1.0 - sine * sine, 1e-12));
    const double turn_sine =
        near_m > 0.0 ? 2.0 * steepest * (steepest + most_above_m / near_m) : 1.0;
    rays.spread_rad =
        std::min(aside_rad + (turn_sine < 1.0 ? std::asin(turn_sine) : core::kPi), core::kPi);
    const double grazing_sine = std::min((far_m * steepest + most_above_m) / nearest_m, 1.0);
    rays.reach_m = farthest_m_ * (farthest_m_ - nearest_m) /
                   (farthest_m_ - nearest_m * grazing_sine * grazing_sine);
    return rays;
  }

  bool mirrors_into_ground(const Place& at) {
    const Box box = box_of(at);
    const Square& square = square_at(at);
    const glm::dvec2 antenna_m(antenna_m_);
    const double near_m = glm::distance(antenna_m, glm::clamp(antenna_m, box.low_m, box.high_m));
    const double low_m = static_cast<double>(square.low_m);
    const double high_m = static_cast<double>(square.high_m);
    const double nearest_m = std::hypot(near_m, std::max(antenna_m_.z - high_m - kRayError_m, 0.0));
    if (!(nearest_m < farthest_m_)) return false;
    if (!may_mirror_(glm::dvec3(box.low_m, low_m), glm::dvec3(box.high_m, high_m))) return false;
    if (++looks_ > kMostLooks) return true;
    const auto rays = mirrored(at, near_m, nearest_m);
    if (rays && !meet_ground(*rays, at)) return false;
    return at.level == 0 ||
           any_quarter(at, [this](const Place& quarter) { return mirrors_into_ground(quarter); });
  }

  bool meet_ground(const ClimbingRays& rays, const Place& from) {
    const Level& level = relief_.levels_[from.level];
    for (int row = std::max(from.row - 1, 0); row <= std::min(from.row + 1, level.rows - 1); ++row)
      for (int column = std::max(from.column - 1, 0);
           column <= std::min(from.column + 1, level.columns - 1); ++column)
        if (!(rise(level.at(column, row), rays.ahead, rays.spread_rad) < rays.tangent)) return true;
    return stands_in_way(rays, from, {relief_.levels_.size() - 1, 0, 0});
  }

  // Of what lies neither in the square `from` nor beside it.
  bool stands_in_way(const ClimbingRays& rays, const Place& from, const Place& at) {
    if (++looks_ > kMostLooks) return true;
    const Box begin = box_of(from), end = box_of(at);
    const double apart_m = glm::length(
        glm::max(glm::max(begin.low_m - end.high_m, end.low_m - begin.high_m), glm::dvec2(0.0)));
    if (apart_m > rays.reach_m) return false;
    const double high_m = static_cast<double>(square_at(at).high_m) + kRayError_m;
    if (high_m < rays.from_m + apart_m * rays.tangent) return false;
    if (outside_sector(rays, begin, end)) return false;
    if (at.level == from.level && std::abs(at.column - from.column) <= 1 &&
        std::abs(at.row - from.row) <= 1)
      return false;
    return at.level == 0 || any_quarter(at, [&](const Place& quarter) {
             return stands_in_way(rays, from, quarter);
           });
  }

  // Whether no line from one box to the other lies in the sector.
  static bool outside_sector(const ClimbingRays& rays, const Box& begin, const Box& end) {
    if (rays.spread_rad >= core::kPi / 2.0) return false;
    const glm::dvec2 least_m = end.low_m - begin.high_m, most_m = end.high_m - begin.low_m;
    const auto most_along = [&](const glm::dvec2& axis) {
      const glm::dvec2 along_m = glm::max(least_m * axis, most_m * axis);
      return along_m.x + along_m.y;
    };
    const glm::dvec2 right(rays.ahead.y, -rays.ahead.x);
    const double ahead_m = most_along(rays.ahead);
    if (ahead_m < 0.0) return true;
    const double beside_m = ahead_m * std::tan(rays.spread_rad);
    return most_along(right) < -beside_m || most_along(-right) < -beside_m;
  }

  const Relief& relief_;
  glm::dvec3 antenna_m_;
  double farthest_m_;
  const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& may_mirror_;
  int looks_ = 0;
};

bool Relief::may_mirror_into_itself(
    const glm::dvec3& antenna_m, double farthest_m,
    const std::function<bool(const glm::dvec3&, const glm::dvec3&)>& may_mirror) const {
  return Search(*this, antenna_m, farthest_m, may_mirror).anything();
}

}  // namespace fanbeam::scenes
