#include "scenes/trajectory/track_blame.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/units.h"
#include "scenes/trajectory/track_order.h"
#include "scenes/trajectory/trajectory_csv_header.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

constexpr std::size_t kLongestToldRun = 8;

std::string position_text(const core::Geodetic& position) {
  return rounded_text(core::degrees(position.latitude_rad), 1e6) + ", " +
         rounded_text(core::degrees(position.longitude_rad), 1e6) + " deg";
}

// In metres, and as the file says it.
std::string height_text(const TrajectoryColumns& columns, double height_m) {
  std::string text = rounded_text(height_m) + " m";
  if (unit_of(columns.height) == "ft")
    text += " (" + rounded_text((height_m - columns.height_offset_m) / core::kFoot_m) + " ft)";
  return text;
}

std::string between_text(const TrackRow& a, const TrackRow& b) {
  return "where rows " + std::to_string(a.row) + " and " + std::to_string(b.row) + " put it";
}

double angle_deg(const TrackRow& row, const std::string& angle) {
  return core::degrees(angle == "roll"    ? row.roll_rad
                       : angle == "pitch" ? row.pitch_rad
                                          : row.heading_rad);
}

// Why one row does not fit between its neighbours.
class MotionText {
 public:
  MotionText(const RawTrack& track, const TrajectoryColumns& columns, const TrackMotion& motion,
             std::size_t i, const GoodNeighbours& good, bool absolute)
      : track_(track), columns_(columns), motion_(motion), i_(i), good_(good) {
    const auto see = [&](std::size_t from, std::size_t to) {
      const StepMisfit step = absolute ? motion.absolute_misfit(from, to) : motion.misfit(from, to);
      if (step.ratio > worst_.ratio) worst_ = step;
    };
    if (good.before) see(*good.before, i);
    if (good.after) see(i, *good.after);
    vertical_ = worst_.kind == Misfit::height || worst_.kind == Misfit::climb;
  }

  BlamedRow blame() const {
    return {motion_.row(i_), vertical_ ? "height" : "position", value(), expected()};
  }

 private:
  const TrackRow& row(std::size_t i) const { return track_.rows[motion_.row(i)]; }

  std::string place(const core::Geodetic& position) const {
    return vertical_ ? height_text(columns_, position.height_m) : position_text(position);
  }

  std::string value() const {
    const std::size_t beside = good_.before ? *good_.before : *good_.after;
    const double step_s = std::abs(motion_.time_s(i_) - motion_.time_s(beside));
    const double way_m = vertical_ ? std::abs(motion_.height_m(i_) - motion_.height_m(beside))
                                   : glm::distance(motion_.foot_m(i_), motion_.foot_m(beside));
    return place(row(i_).position) + (vertical_ ? ", climb or descent of " : ", ground speed ") +
           rounded_text(way_m / step_s) + " m/s";
  }

  std::string expected() const {
    const bool by_speed = worst_.kind == Misfit::speed || worst_.kind == Misfit::climb;
    std::string text = by_speed ? "at most " + rounded_text(worst_.allowed) + " m/s, "
                                : "at most " + rounded_text(worst_.allowed, 1.0) + " m from ";
    if (!good_.before || !good_.after) {
      const TrackRow& beside = row(good_.before ? *good_.before : *good_.after);
      return text + (by_speed ? "seen from " : "what follows from ") + place(beside.position) +
             " in row " + std::to_string(beside.row);
    }
    if (by_speed) text += "near ";
    const TrackRow& a = row(*good_.before);
    const TrackRow& b = row(*good_.after);
    const double s = (row(i_).time_s - a.time_s) / (b.time_s - a.time_s);
    core::Geodetic there = terrain::geodetic_from_ecef(
        glm::mix(motion_.foot_m(*good_.before), motion_.foot_m(*good_.after), s));
    there.height_m = std::lerp(a.position.height_m, b.position.height_m, s);
    return text + place(there) + ", " + between_text(a, b);
  }

  const RawTrack& track_;
  const TrajectoryColumns& columns_;
  const TrackMotion& motion_;
  std::size_t i_;
  GoodNeighbours good_;
  StepMisfit worst_;
  bool vertical_ = false;
};

}  // namespace

BlamedRow blame(const RawTrack& track, const TrajectoryColumns& columns, const TrackMotion& motion,
                std::size_t i, const GoodNeighbours& good, bool absolute) {
  return MotionText(track, columns, motion, i, good, absolute).blame();
}

BlamedRow blame(const RawTrack& track, const TrackTurning& turning, std::size_t i,
                const GoodNeighbours& good) {
  TurnMisfit worst;
  std::size_t beside = i;
  const auto see = [&](std::size_t from, std::size_t to) {
    const TurnMisfit step = turning.misfit(from, to);
    if (step.ratio <= worst.ratio) return;
    worst = step;
    beside = from == i ? to : from;
  };
  if (good.before) see(*good.before, i);
  if (good.after) see(i, *good.after);
  const TrackRow& row = track.rows[turning.row(i)];
  const TrackRow& other = track.rows[turning.row(beside)];
  const double step_s = std::abs(row.time_s - other.time_s);
  return {turning.row(i), worst.angle,
          rounded_text(angle_deg(row, worst.angle)) + " deg, " + rounded_text(worst.found_deg) +
              " deg in " + rounded_text(step_s, 1000.0) + " s",
          "at most " + rounded_text(worst.allowed_deg) + " deg from " +
              rounded_text(angle_deg(other, worst.angle)) + " deg in row " +
              std::to_string(other.row)};
}

void tell(const RawTrack& track, const std::vector<BlamedRow>& blamed,
          core::ProblemList& problems) {
  for (std::size_t k = 0; k < blamed.size() && !problems.is_full();) {
    std::size_t end = k + 1;
    while (end < blamed.size() && blamed[end].row - blamed[k].row == end - k) ++end;
    const bool together = end - k > kLongestToldRun;
    for (const std::size_t stop = end; k < stop; ++k) {
      const BlamedRow& row = blamed[k];
      const TrackRow& first = track.rows[row.row];
      const TrackRow& last = track.rows[blamed[together ? stop - 1 : k].row];
      problems.error(core::ErrorClass::range, place_of(track, first),
                     rows_text(first.row, last.row) + ", " + row.what, row.value,
                     row.expected + "; mend it, or set trajectory.outliers = \"reject\"");
      if (together) k = stop - 1;
    }
  }
}

}  // namespace fanbeam::scenes
