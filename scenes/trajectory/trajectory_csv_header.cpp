#include "scenes/trajectory/trajectory_csv_header.h"

#include <algorithm>
#include <limits>
#include <string>

#include "core/spelling.h"
#include "core/text.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

struct Unit {
  std::string_view name;
  double scale;
};

// What the units of one kind of quantity are, for the search and for messages.
struct Dimension {
  std::array<Unit, 2> units;
  const char* expected;
};

constexpr Dimension kTime{{{{"s", 1.0}, {"ms", 1e-3}}}, "a unit: s, ms or iso8601"};
constexpr Dimension kAngle{{{{"deg", core::radians(1.0)}, {"rad", 1.0}}}, "a unit: deg or rad"};
constexpr Dimension kLength{{{{"m", 1.0}, {"ft", core::kFoot_m}}}, "a unit: m or ft"};

struct Quantity {
  const Dimension& dimension;
  double lowest;
  double highest;
  const char* expected;
};

constexpr double kAnyTime_s = std::numeric_limits<double>::max();
constexpr Quantity kInstant{kTime, -kAnyTime_s, kAnyTime_s, "a time"};
constexpr Quantity kRightAngle{kAngle, -core::radians(90.0), core::radians(90.0), "-90 to 90 deg"};
constexpr Quantity kHalfTurn{kAngle, -core::radians(180.0), core::radians(180.0),
                             "-180 to 180 deg"};
constexpr Quantity kTurn{kAngle, -core::radians(540.0), core::radians(540.0), "-540 to 540 deg"};
constexpr Quantity kHeight{kLength, -20e3, 1000e3, "-20000 to 1000000 m"};

class HeaderSearch {
 public:
  HeaderSearch(const std::vector<std::string_view>& header, const core::Place& place,
               core::ProblemList& problems)
      : header_(header), place_(place), problems_(problems) {}

  std::optional<TrackCell> find(const TrajectoryColumn& column, const Quantity& quantity) {
    const auto found = std::find(header_.begin(), header_.end(), column.name);
    if (found == header_.end()) {
      if (!column.may_be_missing)
        complain(column, "missing",
                 "a column of this name" +
                     core::names_there_text(column.name, {header_.begin(), header_.end()}));
      return std::nullopt;
    }
    if (std::find(found + 1, header_.end(), column.name) != header_.end())
      complain(column, "there twice", "one column of this name");
    const std::string_view unit = unit_of(column);
    if (&quantity.dimension == &kTime && unit == "iso8601")
      return TrackCell{column.name,
                       static_cast<std::size_t>(found - header_.begin()),
                       1.0,
                       quantity.lowest,
                       quantity.highest,
                       quantity.expected,
                       true};
    for (const Unit& known : quantity.dimension.units)
      if (known.name == unit)
        return TrackCell{column.name,      static_cast<std::size_t>(found - header_.begin()),
                         known.scale,      quantity.lowest,
                         quantity.highest, quantity.expected};
    complain(column, "unit \"" + std::string(unit) + "\"", quantity.dimension.expected);
    return std::nullopt;
  }

 private:
  void complain(const TrajectoryColumn& column, const std::string& found,
                const std::string& expected) {
    problems_.error(ErrorClass::parse, place_, "column \"" + column.name + "\"", found, expected);
  }

  const std::vector<std::string_view>& header_;
  const core::Place& place_;
  core::ProblemList& problems_;
};

}  // namespace

std::string_view unit_of(const TrajectoryColumn& column) {
  if (!column.unit.empty()) return column.unit;
  const std::size_t underscore = column.name.rfind('_');
  if (underscore == std::string::npos) return {};
  return std::string_view(column.name).substr(underscore + 1);
}

void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  bool quoted = false;
  std::size_t begin = 0;
  const auto add = [&](std::size_t end) {
    std::string_view cell = core::trimmed(line.substr(begin, end - begin));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
      cell = core::trimmed(cell.substr(1, cell.size() - 2));
    cells.push_back(cell);
    begin = end + 1;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == ',' && !quoted) add(i);
  }
  add(line.size());
}

TrackCells find_track_cells(const std::vector<std::string_view>& header,
                            const TrajectoryColumns& columns, const core::Place& place,
                            core::ProblemList& problems) {
  HeaderSearch search(header, place, problems);
  TrackCells cells;
  cells.cells_per_row = header.size();
  cells.time = search.find(columns.time, kInstant).value_or(TrackCell{});
  cells.position = {search.find(columns.latitude, kRightAngle).value_or(TrackCell{}),
                    search.find(columns.longitude, kTurn).value_or(TrackCell{}),
                    search.find(columns.height, kHeight).value_or(TrackCell{})};
  cells.attitude = {search.find(columns.roll, kHalfTurn), search.find(columns.pitch, kRightAngle),
                    search.find(columns.heading, kTurn)};
  return cells;
}

}  // namespace fanbeam::scenes
