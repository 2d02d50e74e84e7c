#include "scenes/airport/runway_csv_reader.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "core/text.h"
#include "core/units.h"
#include "scenes/airport/airport_numbers.h"
#include "scenes/airport/apt_dat_reader.h"
#include "scenes/line_reader.h"
#include "scenes/trajectory/trajectory_csv_header.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

// Where one layout has what a runway needs.
struct EndColumns {
  std::string_view name, latitude, longitude, elevation, displaced;
};
constexpr EndColumns kOwnEnd{"runway_end", "end_lat_deg", "end_lon_deg", "end_elevation_m_msl",
                             "displaced_threshold_m"};
constexpr EndColumns kLowEnd{"le_ident", "le_latitude_deg", "le_longitude_deg", "le_elevation_ft",
                             "le_displaced_threshold_ft"};
constexpr EndColumns kHighEnd{"he_ident", "he_latitude_deg", "he_longitude_deg", "he_elevation_ft",
                              "he_displaced_threshold_ft"};

class RunwayCsvReader {
 public:
  RunwayCsvReader(const std::filesystem::path& file, const std::string& ident,
                  core::ProblemList& problems)
      : lines_(file, problems), ident_(ident), problems_(problems) {}

  std::optional<Airport> read() {
    if (problems_.has_errors() || !read_header()) return std::nullopt;
    std::string_view line;
    while (!problems_.is_full() && lines_.next(line)) {
      split_cells(line, cells_);
      take_row();
    }
    if (by_ends_) pair_ends();
    report();
    if (problems_.has_errors()) return std::nullopt;
    return std::move(airport_);
  }

 private:
  bool read_header() {
    std::string_view line;
    if (!lines_.next(line)) {
      problems_.error(ErrorClass::parse, lines_.place(), "header", "nothing",
                      "a line of column names");
      return false;
    }
    split_cells(line, cells_);
    header_.assign(cells_.begin(), cells_.end());
    by_ends_ = has(kOwnEnd.name);
    if (!by_ends_ && !has(kLowEnd.name)) {
      problems_.error(ErrorClass::parse, lines_.place(), "columns",
                      "neither runway_end nor le_ident",
                      "a table with a row per runway end, or OurAirports' runways.csv");
      return false;
    }
    std::vector<std::string_view> needed = {by_ends_ ? "airport" : "airport_ident",
                                            by_ends_ ? "width_m" : "width_ft", "surface"};
    const auto need = [&](const EndColumns& end) {
      needed.insert(needed.end(), {end.name, end.latitude, end.longitude});
    };
    if (by_ends_) {
      need(kOwnEnd);
    } else {
      need(kLowEnd);
      need(kHighEnd);
    }
    for (const std::string_view name : needed)
      if (!has(name))
        problems_.error(ErrorClass::parse, lines_.place(), "column \"" + std::string(name) + "\"",
                        "missing", "a column of this name");
    return !problems_.has_errors();
  }

  bool has(std::string_view name) const {
    return std::find(header_.begin(), header_.end(), name) != header_.end();
  }

  // Empty where there is no such column.
  std::string_view cell(std::string_view column) const {
    const auto at = std::find(header_.begin(), header_.end(), column);
    if (at == header_.end()) return {};
    const auto index = static_cast<std::size_t>(at - header_.begin());
    return index < cells_.size() ? cells_[index] : std::string_view();
  }

  void take_row() {
    const std::string_view ident = cell(by_ends_ ? "airport" : "airport_ident");
    if (!is_same_ident(ident, ident_)) {
      if (ident.size() <= 10 && names_.size() < kMostAirportNames) names_.emplace(ident);
      return;
    }
    if (!seen_) airport_.place = lines_.place();
    seen_ = true;
    airport_.ident = std::string(ident);
    if (cells_.size() != header_.size()) {
      problems_.error(ErrorClass::parse, lines_.place(), "row",
                      std::to_string(cells_.size()) + " cells",
                      std::to_string(header_.size()) + " as in the header");
      return;
    }
    if (airport_.runways.size() >= kMostAirportRunways) {
      problems_.error(ErrorClass::limit, lines_.place(), "runways",
                      "more than " + std::to_string(kMostAirportRunways), "at most that many");
      return;
    }
    const bool placed = by_ends_ ? is_placed(kOwnEnd) : is_placed(kLowEnd) && is_placed(kHighEnd);
    if (cell("closed") == "1" || !placed) {
      skip();
      return;
    }
    airport_.runways.push_back(runway_of_row());
  }

  bool is_placed(const EndColumns& end) const {
    return !cell(end.latitude).empty() && !cell(end.longitude).empty();
  }

  void skip() {
    if (skipped_++ == 0) first_skipped_ = lines_.place();
  }

  std::optional<double> number(std::string_view column, const core::NumberRange& range_m,
                               double metres) {
    if (cell(column).empty()) return std::nullopt;
    const auto value = airport_number(cell(column), std::string(column),
                                      {range_m.low / metres, range_m.high / metres},
                                      metres == 1.0 ? "m" : "ft", lines_.place(), problems_);
    if (!value) return std::nullopt;
    return *value * metres;
  }

  AirportRunway runway_of_row() {
    AirportRunway runway;
    runway.place = lines_.place();
    runway.surface = surface_of_text(cell("surface"));
    if (!cell("lighted").empty()) runway.edge_lights = cell("lighted") == "1";
    runway.width_m =
        (by_ends_ ? number("width_m", kWidth_m, 1.0) : number("width_ft", kWidth_m, core::kFoot_m))
            .value_or(0.0);
    if (by_ends_) {
      runway.ends[0] = end_of_row(kOwnEnd, 1.0);
    } else {
      runway.ends[0] = end_of_row(kLowEnd, core::kFoot_m);
      runway.ends[1] = end_of_row(kHighEnd, core::kFoot_m);
    }
    return runway;
  }

  AirportRunwayEnd end_of_row(const EndColumns& columns, double metres) {
    AirportRunwayEnd end;
    end.name = std::string(cell(columns.name).substr(0, 8));
    const auto angle = [&](std::string_view column, const core::NumberRange& range) {
      return core::radians(
          airport_number(cell(column), std::string(column), range, "deg", lines_.place(), problems_)
              .value_or(0.0));
    };
    end.pavement_end.latitude_rad = angle(columns.latitude, kLatitude_deg);
    end.pavement_end.longitude_rad = angle(columns.longitude, kLongitude_deg);
    end.elevation_m = number(columns.elevation, kElevation_m, metres);
    end.displaced_m = number(columns.displaced, kDisplaced_m, metres).value_or(0.0);
    return end;
  }

  // Rows of single ends, each with the first later one that is its reciprocal.
  void pair_ends() {
    std::vector<AirportRunway> ends;
    std::swap(ends, airport_.runways);
    std::vector<bool> taken(ends.size(), false);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (taken[i]) continue;
      const std::string other = reciprocal_runway(ends[i].ends[0].name);
      std::size_t j = i + 1;
      while (j < ends.size() && (taken[j] || !is_same_runway(ends[j].ends[0].name, other))) ++j;
      if (j == ends.size()) {
        if (skipped_++ == 0) first_skipped_ = ends[i].place;
        continue;
      }
      taken[j] = true;
      ends[i].ends[1] = ends[j].ends[0];
      airport_.runways.push_back(std::move(ends[i]));
    }
  }

  void report() {
    if (problems_.has_errors()) return;
    if (!seen_) {
      report_unknown_airport(ident_, {names_.begin(), names_.end()},
                             core::Place{lines_.place().file}, problems_);
    } else if (airport_.runways.empty()) {
      problems_.error(ErrorClass::ref, airport_.place, "runways of " + airport_.ident,
                      std::to_string(skipped_) + " closed or without coordinates",
                      "an open runway with the coordinates of both ends");
    } else if (skipped_ > 0) {
      problems_.warning("SKIPPED", first_skipped_, "rows of " + airport_.ident,
                        std::to_string(skipped_),
                        "left out: closed, or without the coordinates of both ends");
    }
  }

  LineReader lines_;
  const std::string& ident_;
  core::ProblemList& problems_;
  std::vector<std::string> header_;
  std::vector<std::string_view> cells_;
  bool by_ends_ = false, seen_ = false;
  Airport airport_;
  std::size_t skipped_ = 0;
  core::Place first_skipped_;
  std::set<std::string> names_;
};

}  // namespace

std::optional<Airport> read_runway_csv(const std::filesystem::path& file, const std::string& ident,
                                       core::ProblemList& problems) {
  core::ProblemList found;
  std::optional<Airport> airport = RunwayCsvReader(file, ident, found).read();
  problems.append(found.all());
  return airport;
}

}  // namespace fanbeam::scenes
