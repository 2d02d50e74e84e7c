#include "scenes/new_scene/track_guess.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/units.h"
#include "scenes/new_scene/approach_rows.h"
#include "scenes/new_scene/track_table.h"
#include "scenes/new_scene/words.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;
using core::VerticalDatum;

constexpr double kNearAirport_m = 100e3;
constexpr double kFitted_m = 5000.0;           // before the threshold
constexpr double kBelievable_m = 60.0;         // off the threshold crossing height
constexpr double kLargestByWeather_m = 600.0;  // 70 hPa
constexpr double kAboveWheels_m = 3.0;         // above the ground: where a flight begins and ends
// So many low rows, or so long, are a stop on the ground and no wrong heights.
constexpr std::size_t kStopRows = 3;
constexpr double kStop_s = 3.0;

// A way to read the numbers of a height column.
struct Reading {
  std::string unit;
  VerticalDatum datum = VerticalDatum::egm96;
  double off_m = 0.0;  // of the crossing height at the threshold
  double metres() const { return unit == "ft" ? core::kFoot_m : 1.0; }
};

std::string words_of(const Reading& reading) {
  return (reading.unit == "ft" ? "feet above " : "metres above ") +
         std::string(reading.datum == VerticalDatum::egm96 ? "mean sea level" : "the ellipsoid");
}

class TrackGuesser {
 public:
  TrackGuesser(const TrackTable& table, const TrackReference& reference, Notes& notes,
               core::ProblemList& problems)
      : table_(table), reference_(reference), notes_(notes), problems_(problems) {}

  std::optional<TrackGuess> guess() {
    choose_angles();
    if (problems_.has_errors()) return std::nullopt;
    place_rows();
    if (!choose_part() || !choose_height() || !keep_rows_in_the_air()) return std::nullopt;
    name_columns();
    return std::move(result_);
  }

 private:
  // Of the nearest row, with latitude and longitude as in the file, or exchanged.
  double nearest_m(double unit_rad, bool exchanged) const {
    double least_m = std::numeric_limits<double>::infinity();
    const core::Geodetic& at = reference_.threshold;
    for (const TrackTable::Row& row : table_.rows) {
      const double latitude_rad = unit_rad * (exchanged ? row.longitude : row.latitude);
      const double longitude_rad = unit_rad * (exchanged ? row.latitude : row.longitude);
      if (!(std::abs(latitude_rad) <= core::kPi / 2)) continue;
      constexpr double kEarth_m = 6371e3;
      const double north_m = kEarth_m * (latitude_rad - at.latitude_rad);
      const double east_m = kEarth_m * std::cos(at.latitude_rad) *
                            core::wrap_pi_rad(longitude_rad - at.longitude_rad);
      least_m = std::min(least_m, std::hypot(north_m, east_m));
    }
    return least_m;
  }

  void choose_angles() {
    const NamedColumn& latitude = *table_.columns.latitude;
    const double degree_rad = core::radians(1.0);
    angle_unit_ = !latitude.unit.empty() ? latitude.unit : "deg";
    if (latitude.unit.empty() && nearest_m(degree_rad, false) > kNearAirport_m &&
        nearest_m(1.0, false) < kNearAirport_m) {
      angle_unit_ = "rad";
      notes_.push_back({"track angles", "radians: as degrees the flight would be elsewhere", true});
    }
    angle_rad_ = angle_unit_ == "rad" ? 1.0 : degree_rad;
    if (nearest_m(angle_rad_, false) > kNearAirport_m &&
        nearest_m(angle_rad_, true) < kNearAirport_m)
      problems_.error(ErrorClass::range, table_.header,
                      latitude.name + ", " + table_.columns.longitude->name,
                      "exchanged: the flight is at the airport only with latitude and longitude "
                      "the other way round",
                      "latitudes in the column of that name");
  }

  void place_rows() {
    const terrain::LocalFrame frame(reference_.threshold);
    const double east = std::sin(reference_.bearing_rad), north = std::cos(reference_.bearing_rad);
    for (const TrackTable::Row& source : table_.rows) {
      ApproachRow row;
      row.time_s = source.time_s;
      row.position = {angle_rad_ * source.latitude, angle_rad_ * source.longitude, 0.0};
      row.before_m = row.left_m = std::numeric_limits<double>::infinity();
      if (std::abs(row.position.latitude_rad) <= core::kPi / 2 &&
          std::abs(row.position.longitude_rad) <= 3 * core::kPi) {
        const glm::dvec3 local_m = frame.to_local_m(
            {row.position.latitude_rad, row.position.longitude_rad, reference_.threshold.height_m});
        row.before_m = -(local_m.x * east + local_m.y * north);
        row.left_m = local_m.y * east - local_m.x * north;
        row.over_terrain = std::hypot(row.before_m, row.left_m) < kNearAirport_m &&
                           reference_.ground_m(row.position).has_value();
      }
      rows_.push_back(row);
    }
  }

  bool choose_part() {
    const std::vector<ApproachPart> approaches =
        find_approaches(rows_, reference_.start_distance_m, reference_.runway_length_m);
    is_approach_ = !approaches.empty();
    if (is_approach_) {
      part_ = approaches.front();
      const std::string which =
          approaches.size() == 1
              ? "the one approach to this runway in it"
              : "the first of " + std::to_string(approaches.size()) + " approaches in it";
      notes_.push_back({"flight", which + ", from " + tenths(rows_[part_.first].before_m / 1e3) +
                                      " km before the threshold on"});
      return true;
    }
    if (const auto part = find_nearest_part(rows_, reference_.start_distance_m)) {
      part_ = *part;
      notes_.push_back({"flight",
                        "no approach to this runway: its rows within " +
                            tenths(reference_.start_distance_m / 1e3) +
                            " km of the threshold are taken",
                        true});
      return true;
    }
    problems_.error(
        ErrorClass::range, table_.header, "flight",
        "comes no nearer than " + tenths(nearest_m(angle_rad_, false) / 1e3) +
            " km to the threshold over the elevation data",
        "two rows within " + tenths(reference_.start_distance_m / 1e3) +
            " km of it and over the elevation data; a flight to another runway is moved onto this "
            "one by [trajectory.transplant], see docs/scene-format.md");
    return false;
  }

  // The first column that has heights in at least half of the part's rows.
  const NamedHeight* choose_column() {
    const std::vector<NamedHeight>& heights = table_.columns.heights;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      std::size_t there = 0;
      for (std::size_t i = part_.first; i <= part_.last; ++i)
        there += std::isfinite(table_.rows[i].height[k]) ? 1 : 0;
      if (2 * there < part_.last - part_.first + 1) continue;
      column_ = k;
      return &heights[k];
    }
    problems_.error(ErrorClass::parse, table_.header, heights.front().name,
                    "empty in most rows of the approach", "a height in every row");
    return nullptr;
  }

  double sea_level_m(std::size_t row, const Reading& reading) const {
    const double height_m = table_.rows[row].height[column_] * reading.metres();
    return reading.datum == VerticalDatum::egm96 ? height_m : height_m - reference_.geoid_m;
  }

  double off_at_threshold_m(const Reading& reading) const {
    std::vector<double> before_m, height_m;
    for (std::size_t i = part_.first; i <= part_.last; ++i) {
      const bool fitted = rows_[i].before_m >= 0.0 && rows_[i].before_m <= kFitted_m;
      if (!fitted || !std::isfinite(table_.rows[i].height[column_])) continue;
      before_m.push_back(rows_[i].before_m);
      height_m.push_back(sea_level_m(i, reading) - reference_.threshold.height_m);
    }
    if (before_m.empty()) return std::numeric_limits<double>::infinity();
    return height_at_threshold_m(before_m, height_m) - reference_.threshold_crossing_height_m;
  }

  // Of a flight that is no approach: how far its lowest row is from the ground.
  double clearance_m(const Reading& reading) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = part_.first; i <= part_.last; ++i)
      if (std::isfinite(table_.rows[i].height[column_]))
        least_m = std::min(least_m, sea_level_m(i, reading) -
                                        reference_.ground_m(rows_[i].position).value_or(0.0));
    return least_m;
  }

  bool choose_height() {
    const NamedHeight* column = choose_column();
    if (column == nullptr) return false;
    std::vector<Reading> readings;
    for (const char* unit : {"m", "ft"})
      for (const VerticalDatum datum : {VerticalDatum::egm96, VerticalDatum::ellipsoid}) {
        if (!column->unit.empty() && column->unit != unit) continue;
        const bool sea_level =
            column->kind == HeightKind::sea_level || column->kind == HeightKind::pressure;
        if (sea_level && datum == VerticalDatum::ellipsoid) continue;
        if (column->kind == HeightKind::ellipsoid && datum == VerticalDatum::egm96) continue;
        readings.push_back({unit, datum});
      }
    is_approach_ = is_approach_ && std::isfinite(off_at_threshold_m(readings.front()));
    // Inside the ground is worse than anything above it.
    for (Reading& reading : readings) {
      reading.off_m = is_approach_ ? off_at_threshold_m(reading) : clearance_m(reading);
      if (!is_approach_ && reading.off_m < 0.0) reading.off_m = 1e6 - reading.off_m;
    }
    std::stable_sort(readings.begin(), readings.end(), [](const Reading& a, const Reading& b) {
      return std::abs(a.off_m) < std::abs(b.off_m);
    });
    reading_ = readings.front();
    result_.datum = reading_.datum;
    result_.columns.height = {column->name, reading_.unit, false};
    explain_height(*column, readings);
    return true;
  }

  void explain_height(const NamedHeight& column, const std::vector<Reading>& readings) {
    std::string text = safe_words(column.name) + ": " + words_of(reading_);
    const auto crossing = [&](const Reading& reading) {
      return whole(reading.off_m + reference_.threshold_crossing_height_m) + " m";
    };
    if (!is_approach_) {
      text += readings.size() == 1 ? ", by its name" : ", the lowest that stays above the ground";
      notes_.push_back({"track height", text, true});
      return;
    }
    text += readings.size() == 1 ? ", by its name" : ", by name and data";
    text += "; the approach then crosses the threshold at " + crossing(reading_);
    if (readings.size() > 1)
      text += " (" + words_of(readings[1]) + ": " + crossing(readings[1]) + ")";
    bool guess = readings.size() > 1;
    const bool pressure = column.kind == HeightKind::pressure;
    if (pressure && std::abs(reading_.off_m) <= kLargestByWeather_m) {
      result_.columns.height_offset_m = std::round(-10.0 * reading_.off_m) / 10.0;
      text += ". Pressure heights are off by the day's weather: " +
              tenths(result_.columns.height_offset_m) +
              " m are added, which brings it to the crossing height";
      guess = true;
    } else if (std::abs(reading_.off_m) > kBelievable_m) {
      text += ", which no landing does: look at the file's units";
      guess = true;
    }
    notes_.push_back({"track height", text, guess});
  }

  // Nothing where the row has no height.
  std::optional<double> above_ground_m(std::size_t row) const {
    if (!std::isfinite(table_.rows[row].height[column_])) return std::nullopt;
    const double ground_m =
        rows_[row].before_m < 0.0 && is_approach_
            ? reference_.threshold.height_m - reference_.runway_slope * rows_[row].before_m
            : reference_.ground_m(rows_[row].position).value_or(0.0);
    return sea_level_m(row, reading_) + result_.columns.height_offset_m - ground_m;
  }

  bool is_low(std::size_t row) const {
    return above_ground_m(row).value_or(kAboveWheels_m) < kAboveWheels_m;
  }

  // Of a flight that is no approach: the longest piece between its stops on the ground.
  void keep_longest_piece() {
    std::vector<ApproachPart> pieces;
    std::size_t begin = part_.first;
    for (std::size_t i = part_.first, end = i; i <= part_.last; i = end = std::max(end, i + 1)) {
      while (end <= part_.last && is_low(end)) ++end;
      const bool stop =
          end - i >= kStopRows || (end > i && rows_[end - 1].time_s - rows_[i].time_s >= kStop_s);
      if (!stop) continue;
      if (begin < i) pieces.push_back({begin, i - 1});
      begin = end;
    }
    if (begin <= part_.last) pieces.push_back({begin, part_.last});
    if (pieces.empty()) return;
    part_ = *std::max_element(pieces.begin(), pieces.end(), [&](const auto& a, const auto& b) {
      return rows_[a.last].time_s - rows_[a.first].time_s <
             rows_[b.last].time_s - rows_[b.first].time_s;
    });
    if (pieces.size() > 1)
      notes_.push_back({"flight",
                        "on the ground in between: the longest of " +
                            std::to_string(pieces.size()) + " pieces in the air is taken",
                        true});
  }

  // Cuts off what is on the ground: a frame's antenna must be above it. Between rows in the air one or two low
  // ones are wrong heights, for whoever reads the whole file to judge; behind the threshold one is the landing,
  // also where the flight goes around after it.
  bool keep_rows_in_the_air() {
    const auto flies = [&](std::size_t row) {
      return above_ground_m(row).value_or(0.0) >= kAboveWheels_m;
    };
    if (!is_approach_) keep_longest_piece();
    for (std::size_t i = part_.first; is_approach_ && i < part_.last; ++i)
      if (rows_[i].before_m < 0.0 && is_low(i)) part_.last = i;
    while (part_.first < part_.last && !flies(part_.first)) ++part_.first;
    while (part_.first < part_.last && !flies(part_.last)) --part_.last;
    if (part_.first == part_.last) {
      problems_.error(ErrorClass::range, table_.header, "flight",
                      "never " + whole(kAboveWheels_m) + " m above the ground in two rows",
                      "two rows in the air: look at the unit of " + result_.columns.height.name);
      return false;
    }
    for (std::size_t i = part_.first; i <= part_.last; ++i)
      result_.path.push_back(rows_[i].position);
    tell_times();
    return true;
  }

  void tell_times() {
    result_.columns.from_time_s = std::floor(1e3 * rows_[part_.first].time_s) / 1e3;
    result_.columns.to_time_s = std::ceil(1e3 * rows_[part_.last].time_s) / 1e3;
    notes_.push_back(
        {"track time", safe_words(table_.columns.time->name) + ": " + table_.time_why + "; " +
                           std::to_string(part_.last - part_.first + 1) + " rows, " +
                           tenths(rows_[part_.last].time_s - rows_[part_.first].time_s) + " s"});
  }

  void name_columns() {
    const NamedColumns& named = table_.columns;
    TrajectoryColumns& columns = result_.columns;
    const auto angle = [&](const std::optional<NamedColumn>& from, bool may_be_missing) {
      if (!from) return TrajectoryColumn{"", "", true};
      return TrajectoryColumn{from->name, from->unit.empty() ? angle_unit_ : from->unit,
                              may_be_missing};
    };
    columns.time = {named.time->name, table_.time_unit, false};
    columns.latitude = angle(named.latitude, false);
    columns.longitude = angle(named.longitude, false);
    columns.roll = angle(named.roll, true);
    columns.pitch = angle(named.pitch, true);
    columns.heading = angle(named.heading, true);
    std::string recorded;
    for (const TrajectoryColumn* column : {&columns.roll, &columns.pitch, &columns.heading})
      if (!column->name.empty())
        recorded += (recorded.empty() ? "" : ", ") + safe_words(column->name);
    notes_.push_back(
        {"track columns",
         safe_words(columns.latitude.name) + ", " + safe_words(columns.longitude.name) +
             "; attitude: " + (recorded.empty() ? "none, derived from the path" : recorded)});
  }

  const TrackTable& table_;
  const TrackReference& reference_;
  Notes& notes_;
  core::ProblemList& problems_;
  std::string angle_unit_;
  double angle_rad_ = 0.0;
  std::vector<ApproachRow> rows_;  // one for each of the table's
  ApproachPart part_;
  bool is_approach_ = false;
  std::size_t column_ = 0;
  Reading reading_;
  TrackGuess result_;
};

}  // namespace

std::optional<TrackGuess> guess_track(const std::filesystem::path& file,
                                      const TrackReference& reference, Notes& notes,
                                      core::ProblemList& problems) {
  const std::optional<TrackTable> table = read_track_table(file, problems);
  if (!table) return std::nullopt;
  core::ProblemList found;
  std::optional<TrackGuess> guess = TrackGuesser(*table, reference, notes, found).guess();
  problems.append(found.all());
  return guess;
}

}  // namespace fanbeam::scenes
