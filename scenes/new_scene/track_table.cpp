#include "scenes/new_scene/track_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "scenes/line_reader.h"
#include "scenes/new_scene/words.h"
#include "scenes/trajectory/iso_time.h"
#include "scenes/trajectory/trajectory_csv.h"
#include "scenes/trajectory/trajectory_csv_header.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

// Beyond what any flight has, in any unit.
constexpr double kMostTime_s = 1e12, kMostHeight = 4e6;
// Seconds since 1970 have ten digits until the year 2286, milliseconds thirteen.
constexpr double kLeastUnixTime_ms = 1e11, kBeyondUnixTime_ms = 1e14;

class TableReader {
 public:
  TableReader(const std::filesystem::path& file, core::ProblemList& problems)
      : lines_(file, problems), problems_(problems) {}

  std::optional<TrackTable> read() {
    if (problems_.has_errors() || !read_header()) return std::nullopt;
    std::string_view line;
    while (lines_.next(line)) {
      split_cells(line, cells_);
      if (table_.time_unit.empty() && !choose_time_unit()) break;
      take_row();
      if (table_.rows.size() <= kMostTrackRows) continue;
      problems_.error(ErrorClass::limit, lines_.place(), "rows",
                      "more than " + std::to_string(kMostTrackRows), "at most that many");
      break;
    }
    if (table_.rows.empty() && !problems_.has_errors())
      problems_.error(ErrorClass::parse, lines_.place(), "rows", "none with a time and a position",
                      "at least one");
    if (problems_.has_errors()) return std::nullopt;
    return std::move(table_);
  }

 private:
  bool read_header() {
    std::string_view line;
    if (!lines_.next(line)) {
      if (!problems_.has_errors())
        problems_.error(ErrorClass::parse, lines_.place(), "header", "nothing",
                        "a line of column names");
      return false;
    }
    table_.header = lines_.place();
    split_cells(line, cells_);
    if (cells_.size() == 1 && line.find_first_of(";\t") != std::string_view::npos) {
      problems_.error(ErrorClass::parse, table_.header, "header",
                      line.find(';') != std::string_view::npos ? "cells separated by ';'"
                                                               : "cells separated by tabulators",
                      "cells separated by commas, numbers with a decimal point");
      return false;
    }
    names_ = cells_.size();
    table_.columns = recognise_columns(cells_);
    const auto need = [&](bool there, const char* what, const char* example) {
      if (!there)
        problems_.error(ErrorClass::parse, table_.header, what, "no column among " + list(),
                        std::string("one with a name such as ") + example);
    };
    need(table_.columns.time.has_value(), "time", "time_s, timestamp or UTC");
    need(table_.columns.latitude.has_value(), "latitude", "lat or Latitude (deg)");
    need(table_.columns.longitude.has_value(), "longitude", "lon or Longitude (deg)");
    need(!table_.columns.heights.empty(), "height", "altitude, alt_ft or height_m");
    if (table_.columns.heights.size() > TrackTable::kMostHeights)
      table_.columns.heights.resize(TrackTable::kMostHeights);
    return !problems_.has_errors();
  }

  std::string list() const {
    std::string text;
    for (const std::string_view name : cells_)
      if (text.size() < 120) text += (text.empty() ? "" : ", ") + safe_words(name);
    return text;
  }

  std::string_view cell(const NamedColumn& column) const {
    return column.index < cells_.size() ? cells_[column.index] : std::string_view();
  }

  // By the first row that has a time. False for a form that is none.
  bool choose_time_unit() {
    const NamedColumn& column = *table_.columns.time;
    const std::string_view text = cell(column);
    if (text.empty()) return true;
    const core::ParsedNumber number = core::parse_number(text);
    if (number.error != core::NumberError::none) {
      if (unix_time_s(text)) {
        table_.time_unit = "iso8601";
        table_.time_why = "dates and times of ISO 8601, as \"" + safe_words(text) + "\"";
        return true;
      }
      problems_.error(ErrorClass::parse, lines_.place(), column.name,
                      "\"" + safe_words(text) + "\"",
                      "seconds, milliseconds, or dates and times as 2024-05-17T08:30:00Z");
      return false;
    }
    const bool epoch_ms = number.value >= kLeastUnixTime_ms && number.value < kBeyondUnixTime_ms;
    const bool epoch_s = number.value >= 1e8 && number.value < kLeastUnixTime_ms;
    table_.time_unit = !column.unit.empty() ? column.unit : epoch_ms ? "ms" : "s";
    table_.time_why = table_.time_unit == "ms" ? "milliseconds" : "seconds";
    if (!column.unit.empty())
      table_.time_why += ", by its name";
    else if (epoch_ms || epoch_s)
      table_.time_why += " since 1970, by its size";
    else
      table_.time_why += ", assumed";
    return true;
  }

  std::optional<double> number(const NamedColumn& column) const {
    const core::ParsedNumber parsed = core::parse_number(cell(column));
    if (parsed.error != core::NumberError::none) return std::nullopt;
    return parsed.value;
  }

  void take_row() {
    if (cells_.size() != names_) return;
    const NamedColumns& columns = table_.columns;
    const std::optional<double> time =
        table_.time_unit == "iso8601" ? unix_time_s(cell(*columns.time)) : number(*columns.time);
    const auto latitude = number(*columns.latitude), longitude = number(*columns.longitude);
    if (!time || !latitude || !longitude) return;
    TrackTable::Row row{table_.time_unit == "ms" ? *time / 1e3 : *time, *latitude, *longitude, {}};
    if (std::abs(row.time_s) > kMostTime_s) return;
    row.height.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < columns.heights.size(); ++i)
      if (const auto height = number(columns.heights[i]))
        if (std::abs(*height) <= kMostHeight) row.height[i] = *height;
    table_.rows.push_back(row);
  }

  LineReader lines_;
  core::ProblemList& problems_;
  std::vector<std::string_view> cells_;
  std::size_t names_ = 0;
  TrackTable table_;
};

}  // namespace

std::optional<TrackTable> read_track_table(const std::filesystem::path& file,
                                           core::ProblemList& problems) {
  core::ProblemList found;
  std::optional<TrackTable> table = TableReader(file, found).read();
  problems.append(found.all());
  return table;
}

}  // namespace fanbeam::scenes
