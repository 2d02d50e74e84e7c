#include "renderer/casting/profile/slice_gather.h"

#include <algorithm>
#include <mutex>

#include "core/parallel.h"
#include "core/stop.h"

namespace fanbeam::renderer {
namespace {

// One body of a loop may hold a second's slices: a request to stop is looked for once in so many of
// them, some milliseconds. What it leaves of a thread's buffers is put right before their next use.
constexpr std::size_t kSlicesBetweenLooks = 64;

void look_for_stop(std::size_t slice) {
  if (slice % kSlicesBetweenLooks == 0) core::throw_if_stopped();
}

// Sums of a whole fan, zero but for the sub-columns that are marked.
struct MarkedFan {
  std::vector<double> range_W_per_rad, elevation_W_m3_per_rad;
  std::vector<std::uint8_t> marks;  // by sub-column

  void prepare(const FanSums& fan) {
    const auto subs = static_cast<std::size_t>(fan.sub_columns);
    const std::size_t range_bins = subs * static_cast<std::size_t>(fan.cells);
    const std::size_t elevation_bins = subs * static_cast<std::size_t>(fan.rows);
    // What an exception left behind must not show in another frame.
    const bool left = std::find(marks.begin(), marks.end(), 1) != marks.end();
    if (!left && marks.size() == subs && range_W_per_rad.size() == range_bins &&
        elevation_W_m3_per_rad.size() == elevation_bins)
      return;
    range_W_per_rad.assign(range_bins, 0.0);
    elevation_W_m3_per_rad.assign(elevation_bins, 0.0);
    marks.assign(subs, 0);
  }
};

// What a part of the slices adds to the fan: only the sub-columns that it reaches are kept, for
// whole fans of every part would be hundreds of megabytes.
class FanPart {
 public:
  // Takes the marked sub-columns and leaves `fan` zero.
  void take(MarkedFan& fan, std::size_t cells, std::size_t rows) {
    cells_ = cells;
    rows_ = rows;
    place_.assign(fan.marks.size(), kNone);
    const auto reached =
        static_cast<std::size_t>(std::count(fan.marks.begin(), fan.marks.end(), 1));
    range_W_per_rad_.resize(reached * cells);
    elevation_W_m3_per_rad_.resize(reached * rows);
    std::size_t place = 0;
    for (std::size_t sub = 0; sub < fan.marks.size(); ++sub) {
      if (fan.marks[sub] == 0) continue;
      move(fan.range_W_per_rad.data() + sub * cells, cells, &range_W_per_rad_[place * cells]);
      if (rows > 0)
        move(fan.elevation_W_m3_per_rad.data() + sub * rows, rows,
             &elevation_W_m3_per_rad_[place * rows]);
      place_[sub] = place++;
      fan.marks[sub] = 0;
    }
  }
  void add_to(FanSums& sums, std::size_t sub) const {
    if (place_[sub] == kNone) return;
    add(range_W_per_rad_.data() + place_[sub] * cells_, cells_,
        sums.range_W_per_rad.data() + sub * cells_);
    add(elevation_W_m3_per_rad_.data() + place_[sub] * rows_, rows_,
        sums.elevation_W_m3_per_rad.data() + sub * rows_);
  }

  std::uint64_t hits = 0, blanked = 0;

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static void move(double* from, std::size_t count, double* to) {
    std::copy_n(from, count, to);
    std::fill_n(from, count, 0.0);
  }
  static void add(const double* from, std::size_t count, double* to) {
    for (std::size_t i = 0; i < count; ++i) to[i] += from[i];
  }

  std::size_t cells_ = 0, rows_ = 0;
  std::vector<std::size_t> place_;  // by sub-column
  std::vector<double> range_W_per_rad_, elevation_W_m3_per_rad_;
};

// The fixed number of parts, each with sums of its own that are added in their order, keeps the
// result the same for any number of threads.
constexpr std::size_t kParts = 16;

void cast_part(const SliceFrame& frame, std::size_t number, const FanSums& fan, FanPart& part) {
  thread_local MarkedFan marked;
  marked.prepare(fan);
  SliceBins bins;
  bins.range_W_per_rad = marked.range_W_per_rad.data();
  if (fan.rows > 0) bins.elevation_W_m3_per_rad = marked.elevation_W_m3_per_rad.data();
  bins.across = true;
  bins.first_azimuth_rad = fan.first_azimuth_rad;
  bins.step_rad = fan.step_rad;
  bins.sub_columns = fan.sub_columns;
  bins.reached = marked.marks.data();
  SliceTracer caster(frame);
  const std::size_t count = frame.slices.size();
  for (std::size_t i = count * number / kParts; i < count * (number + 1) / kParts; ++i) {
    look_for_stop(i);
    bins.weight = frame.slices[i].width_rad / fan.step_rad;
    caster.cast(i, bins);
  }
  part.hits = caster.hits();
  part.blanked = caster.blanked();
  part.take(marked, static_cast<std::size_t>(fan.cells), static_cast<std::size_t>(fan.rows));
}

}  // namespace

void gather_level(const SliceFrame& frame, const std::vector<SubColumnSlices>& columns,
                  FanSums& sums) {
  const auto cells = static_cast<std::size_t>(sums.cells),
             rows = static_cast<std::size_t>(sums.rows);
  std::mutex totals;
  core::parallel_for(columns.size(), [&](std::size_t c) {
    thread_local std::vector<double> range_bins, row_bins;
    const SubColumnSlices& column = columns[c];
    SliceBins bins;
    range_bins.assign(cells + 1, 0.0);
    bins.range_W_per_rad = range_bins.data();
    if (rows > 0) {
      row_bins.assign(rows + 2, 0.0);
      bins.elevation_W_m3_per_rad = row_bins.data();
    }
    bins.weight = 1.0 / static_cast<double>(column.end - column.begin);
    SliceTracer caster(frame);
    for (std::size_t i = column.begin; i < column.end; ++i) {
      look_for_stop(i);
      caster.cast(i, bins);
    }
    std::copy_n(range_bins.begin(), cells, &sums.range_W_per_rad[column.sub_column * cells]);
    if (rows > 0)
      std::copy_n(row_bins.begin() + 1, rows,
                  &sums.elevation_W_m3_per_rad[column.sub_column * rows]);
    const std::lock_guard<std::mutex> lock(totals);  // whole numbers: their sum has no order
    sums.hits += caster.hits();
    sums.blanked += caster.blanked();
  });
}

void gather_across(const SliceFrame& frame, FanSums& sums) {
  std::vector<FanPart> parts(kParts);
  core::parallel_for(kParts, [&](std::size_t p) { cast_part(frame, p, sums, parts[p]); });
  const auto cells = static_cast<std::size_t>(sums.cells),
             rows = static_cast<std::size_t>(sums.rows);
  core::parallel_for(static_cast<std::size_t>(sums.sub_columns), [&](std::size_t sub) {
    std::fill_n(sums.range_W_per_rad.data() + sub * cells, cells, 0.0);
    std::fill_n(sums.elevation_W_m3_per_rad.data() + sub * rows, rows, 0.0);
    for (const FanPart& part : parts) part.add_to(sums, sub);
  });
  for (const FanPart& part : parts) {
    sums.hits += part.hits;
    sums.blanked += part.blanked;
  }
}

}  // namespace fanbeam::renderer
