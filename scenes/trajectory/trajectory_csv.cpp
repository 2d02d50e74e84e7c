#include "scenes/trajectory/trajectory_csv.h"

#include <array>
#include <cmath>
#include <string_view>

#include "core/text.h"
#include "scenes/line_reader.h"
#include "scenes/trajectory/iso_time.h"
#include "scenes/trajectory/track_order.h"
#include "scenes/trajectory/trajectory_csv_header.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::Place;
using core::ProblemList;

// Turns rows into the track, one after the other.
class TrackBuilder {
 public:
  TrackBuilder(const TrajectoryColumns& columns, const TrackCells& cells, ProblemList& problems)
      : columns_(columns), cells_(cells), problems_(problems) {
    for (std::size_t i = 0; i < 3; ++i) recorded_[i] = cells.attitude[i].has_value();
  }

  void add(const std::vector<std::string_view>& values, const Place& place) {
    ++row_;
    if (row_ < columns_.first_row.value_or(row_) || row_ > columns_.last_row.value_or(row_)) return;
    if (values.size() != cells_.cells_per_row) {
      problems_.error(
          ErrorClass::parse, place, "row", std::to_string(values.size()) + " cells",
          std::to_string(cells_.cells_per_row) + " as in the header, numbers with a decimal point");
      return;
    }
    TrackRow row;
    if (!read(values, cells_.time, place, row.time_s)) return;
    if (row.time_s < columns_.from_time_s.value_or(row.time_s)) return;
    if (row.time_s > columns_.to_time_s.value_or(row.time_s)) return;
    for (const TrackCell& cell : cells_.position) {
      if (!values[cell.index].empty()) continue;
      if (empty_rows_++ == 0) first_empty_ = place;
      return;
    }
    row.row = static_cast<std::int32_t>(row_);
    row.line = place.line;
    in_order_ = in_order_ && (track_.rows.empty() || row.time_s > track_.rows.back().time_s);
    read_position_and_attitude(values, place, row);
    track_.rows.push_back(row);
  }

  bool in_order() const { return in_order_; }
  bool full() const { return track_.rows.size() > kMostTrackRows; }

  RawTrack finish(const Place& end) {
    if (full())
      problems_.error(ErrorClass::limit, end, "rows", "more than " + std::to_string(kMostTrackRows),
                      "at most that many; choose a part by time or row");
    if (empty_rows_ > 0)
      problems_.warning("EMPTY", first_empty_, "rows without a position",
                        std::to_string(empty_rows_), "skipped, the first of them here");
    if (track_.rows.empty() && !problems_.has_errors())
      problems_.error(ErrorClass::parse, end, "rows", "none with a position inside the window",
                      "at least one");
    for (std::size_t i = 0; i < 3; ++i) {
      if (!cells_.attitude[i] || recorded_[i]) continue;
      problems_.warning("GAPS", first_gap_[i], std::string(cells_.attitude[i]->name), "empty cells",
                        "derived from the path everywhere");
    }
    track_.file = end.file;
    track_.has_roll = recorded_[0];
    track_.has_pitch = recorded_[1];
    track_.has_heading = recorded_[2];
    return std::move(track_);
  }

 private:
  bool read(const std::vector<std::string_view>& values, const TrackCell& cell, const Place& place,
            double& si) {
    const std::string_view text = values[cell.index];
    const auto complain = [&](ErrorClass error_class, const char* expected) {
      problems_.error(error_class, place, std::string(cell.name),
                      "\"" + std::string(text.substr(0, 40)) + "\"", expected);
      return false;
    };
    if (cell.is_iso8601) {
      const std::optional<double> instant_s = unix_time_s(text);
      if (!instant_s) return complain(ErrorClass::parse, "2024-05-17T08:30:00Z or the like");
      si = *instant_s;
      return true;
    }
    const core::ParsedNumber number = core::parse_number(text);
    switch (number.error) {
      case core::NumberError::none:
        break;
      case core::NumberError::nonfinite:
        return complain(ErrorClass::nonfinite, "a finite number");
      case core::NumberError::not_a_number:
        return complain(ErrorClass::parse, "a number with a decimal point");
      case core::NumberError::out_of_range:
        return complain(ErrorClass::parse, "a number of magnitude 1e-307 to 1e308");
    }
    si = number.value * cell.scale;
    if (si < cell.lowest || si > cell.highest) return complain(ErrorClass::range, cell.expected);
    return true;
  }

  void read_position_and_attitude(const std::vector<std::string_view>& values, const Place& place,
                                  TrackRow& row) {
    read(values, cells_.position[0], place, row.position.latitude_rad);
    read(values, cells_.position[1], place, row.position.longitude_rad);
    read(values, cells_.position[2], place, row.position.height_m);
    row.position.height_m += columns_.height_offset_m;
    const std::array<double*, 3> angles = {&row.roll_rad, &row.pitch_rad, &row.heading_rad};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!cells_.attitude[i]) continue;
      if (!values[cells_.attitude[i]->index].empty()) {
        read(values, *cells_.attitude[i], place, *angles[i]);
      } else if (recorded_[i]) {
        recorded_[i] = false;
        first_gap_[i] = place;
      }
    }
  }

  const TrajectoryColumns& columns_;
  const TrackCells& cells_;
  ProblemList& problems_;
  RawTrack track_;
  std::int64_t row_ = 0;
  bool in_order_ = true;
  std::int64_t empty_rows_ = 0;
  Place first_empty_;
  std::array<bool, 3> recorded_{};
  std::array<Place, 3> first_gap_;
};

void check_options(const TrajectoryColumns& columns, ProblemList& problems) {
  const auto check_finite = [&](const char* field, std::optional<double> value) {
    if (value && !std::isfinite(*value))
      problems.error(ErrorClass::nonfinite, {}, field, core::number_text(*value),
                     "a finite number");
  };
  check_finite("height offset", columns.height_offset_m);
  check_finite("from time", columns.from_time_s);
  check_finite("to time", columns.to_time_s);
  if (std::abs(columns.height_offset_m) > 20e3)
    problems.error(ErrorClass::range, {}, "height offset",
                   core::number_text(columns.height_offset_m) + " m", "-20000 to 20000 m");
}

}  // namespace

RawTrack read_track_csv(const std::filesystem::path& path, const TrajectoryColumns& columns,
                        ProblemList& problems) {
  ProblemList found;
  check_options(columns, found);
  LineReader reader(path, found);
  std::string_view line;
  std::vector<std::string_view> values;
  RawTrack track;
  if (found.has_errors()) {
    problems.append(found.all());
    return track;
  }
  if (reader.next(line)) {
    split_cells(line, values);
    const TrackCells cells = find_track_cells(values, columns, reader.place(), found);
    if (!found.has_errors()) {
      TrackBuilder builder(columns, cells, found);
      while (!builder.full() && found.all().size() < ProblemList::kMost && reader.next(line)) {
        split_cells(line, values);
        builder.add(values, reader.place());
      }
      track = builder.finish(reader.place());
      if (!builder.in_order() && !builder.full()) bring_into_order(track, columns, problems);
    }
  } else if (!found.has_errors()) {
    found.error(ErrorClass::parse, reader.place(), "header", "nothing", "a line of column names");
  }
  problems.append(found.all());
  return track;
}

}  // namespace fanbeam::scenes
