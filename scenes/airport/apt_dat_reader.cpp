#include "scenes/airport/apt_dat_reader.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "core/text.h"
#include "core/units.h"
#include "scenes/airport/airport_numbers.h"
#include "scenes/line_reader.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

constexpr std::size_t kRunwayFields = 26, kFirstEnd = 8, kFieldsOfEnd = 9;
constexpr double kNominalElevation_ft[] = {-1640, 19685};  // -500 to 6000 m

std::vector<std::string_view> fields_of(std::string_view line, std::size_t most = 40) {
  std::vector<std::string_view> fields;
  while (fields.size() < most) {
    line = core::trimmed(line);
    if (line.empty()) break;
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return fields;
}

// What follows the first `count` fields.
std::string_view rest_after(std::string_view line, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    line = core::trimmed(line);
    line.remove_prefix(std::min(line.find_first_of(" \t"), line.size()));
  }
  return core::trimmed(line);
}

struct Row {
  std::string text;
  core::Place place;
};

class AptDatReader {
 public:
  AptDatReader(const std::filesystem::path& file, const std::string& ident,
               core::ProblemList& problems)
      : lines_(file, problems), ident_(ident), problems_(problems) {}

  std::optional<Airport> read() {
    if (problems_.has_errors() || !check_head()) return std::nullopt;
    while (!done_ && lines_.next(line_)) take_row();
    if (problems_.has_errors()) return std::nullopt;
    if (!wanted_) {
      report_unknown_airport(ident_, names_, core::Place{lines_.place().file}, problems_);
      return std::nullopt;
    }
    read_runways();
    read_surroundings();
    if (problems_.has_errors()) return std::nullopt;
    return std::move(airport_);
  }

 private:
  bool check_head() {
    if (!lines_.next(line_) || (line_ != "I" && line_ != "A")) {
      problems_.error(ErrorClass::parse, lines_.place(), "first line",
                      "\"" + std::string(line_.substr(0, 40)) + "\"",
                      "\"I\" or \"A\", as every apt.dat begins");
      return false;
    }
    line_ = {};
    lines_.next(line_);
    const std::vector<std::string_view> fields = fields_of(line_, 2);
    const core::ParsedNumber format = core::parse_number(fields.empty() ? "" : fields[0]);
    if (format.error == core::NumberError::none && format.value >= 850 && format.value < 2000)
      return true;
    problems_.error(ErrorClass::parse, lines_.place(), "format",
                    "\"" + std::string(line_.substr(0, 40)) + "\"", "850 to 1200");
    return false;
  }

  void take_row() {
    const std::vector<std::string_view> fields = fields_of(line_, 5);
    if (fields.empty()) return;
    const std::string_view code = fields[0];
    if (code == "1" || code == "16" || code == "17" || code == "99") {
      done_ = wanted_;
      if (!wanted_) begin_airport(fields);
    } else if (code == "1302") {
      take_other_name(fields);
    } else if (code == "100") {
      if (rows_.size() < kMostAirportRunways)
        rows_.push_back({std::string(line_), lines_.place()});
      else if (wanted_)
        problems_.error(ErrorClass::limit, lines_.place(), "runways",
                        "more than " + std::to_string(kMostAirportRunways), "at most that many");
    } else if (is_surroundings(code)) {
      if (around_.size() < kMostAirportRows)
        around_.push_back({std::string(line_), lines_.place()});
      else if (wanted_ && around_.size() == kMostAirportRows)
        problems_.error(ErrorClass::limit, lines_.place(), "rows of pavements and lines",
                        "more than " + std::to_string(kMostAirportRows), "at most that many");
    } else if (code == "10" || code == "101" || code == "102") {
      other_ = code == "10"    ? "only runways of format 810 (row 10)"
               : code == "101" ? "only water runways"
                               : "only helipads";
    }
  }

  void begin_airport(const std::vector<std::string_view>& fields) {
    rows_.clear();
    around_.clear();
    other_.clear();
    in_airport_ = fields.size() >= 5;
    if (!in_airport_) return;
    head_ = {std::string(line_), lines_.place()};
    const std::string_view name = fields[4];
    remember(name);
    wanted_ = is_same_ident(name, ident_);
  }

  void take_other_name(const std::vector<std::string_view>& fields) {
    static constexpr std::string_view kKeys[] = {"icao_code", "iata_code", "faa_code",
                                                 "local_code"};
    if (!in_airport_ || fields.size() < 3) return;
    if (std::find(std::begin(kKeys), std::end(kKeys), fields[1]) == std::end(kKeys)) return;
    wanted_ = wanted_ || is_same_ident(fields[2], ident_);
  }

  // Only what can be typed is worth suggesting.
  void remember(std::string_view name) {
    const bool plain = name.size() <= 10 && std::all_of(name.begin(), name.end(), [](char letter) {
                         return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                                letter == '_' || letter == '-';
                       });
    if (plain && names_.size() < kMostAirportNames) names_.emplace_back(name);
  }

  void read_runways() {
    const std::vector<std::string_view> head = fields_of(head_.text, 5);
    airport_.ident = std::string(head[4]);
    airport_.name = std::string(rest_after(head_.text, 5));
    airport_.place = head_.place;
    const auto elevation_ft = airport_number(head[1], "airport elevation",
                                             {kNominalElevation_ft[0], kNominalElevation_ft[1]},
                                             "ft", head_.place, problems_);
    if (elevation_ft) airport_.elevation_m = *elevation_ft * core::kFoot_m;
    for (const Row& row : rows_) read_runway(row);
    if (rows_.empty() && !problems_.has_errors())
      problems_.error(ErrorClass::ref, head_.place, "runways of " + airport_.ident,
                      other_.empty() ? "none" : other_, "a land runway (row 100)");
  }

  void read_runway(const Row& row) {
    const std::vector<std::string_view> fields = fields_of(row.text);
    if (fields.size() < kRunwayFields) {
      problems_.error(ErrorClass::parse, row.place, "row 100",
                      std::to_string(fields.size()) + " fields",
                      std::to_string(kRunwayFields) + " (a land runway with two ends)");
      return;
    }
    AirportRunway runway;
    runway.place = row.place;
    const auto code = [&](std::size_t index, const char* field) {
      return airport_code(fields[index], field, 0, 1'000'000, row.place, problems_).value_or(0);
    };
    runway.width_m =
        airport_number(fields[1], "width", kWidth_m, "m", row.place, problems_).value_or(0.0);
    runway.surface = surface_of_apt_code(code(2, "surface"));
    runway.shoulders = code(3, "shoulder") > 0;
    runway.edge_lights = code(6, "edge lights") > 0;
    runway.markings = false;
    for (const std::size_t end : {0U, 1U}) {
      const std::size_t first = kFirstEnd + end * kFieldsOfEnd;
      AirportRunwayEnd& at = runway.ends[end];
      at.name = std::string(fields[first].substr(0, 8));
      const auto number = [&](std::size_t index, const char* field, const core::NumberRange& range,
                              const char* unit) {
        return airport_number(fields[first + index], at.name + " " + field, range, unit, row.place,
                              problems_)
            .value_or(0.0);
      };
      at.pavement_end.latitude_rad = core::radians(number(1, "latitude", kLatitude_deg, "deg"));
      at.pavement_end.longitude_rad = core::radians(number(2, "longitude", kLongitude_deg, "deg"));
      at.displaced_m = number(3, "displaced threshold", kDisplaced_m, "m");
      runway.markings = *runway.markings || code(first + 5, "markings") > 0;
      at.approach_lights = code(first + 6, "approach lights") > 0;
    }
    airport_.runways.push_back(std::move(runway));
  }

  // Pavements, lines and their corners, visual aids.
  static bool is_surroundings(std::string_view code) {
    return code == "21" ||
           (code.size() == 3 && (code.starts_with("11") || code == "120" || code == "130"));
  }

  void read_surroundings() {
    std::optional<AirportPavement> pavement;
    AptOutline outline;
    core::Place head;  // of the pavement or line at hand
    const auto finish = [&] {
      const auto tell = [&](const char* field, const char* what, const char* done) {
        problems_.warning("SKIPPED", head, field, what, done);
      };
      if (pavement && outline.is_open())
        tell("pavement", "a ring that no row 113 or 114 closes", "the ring is left out");
      else if (pavement && outline.rings().empty())
        tell("pavement", "no ring of three corners", "left out");
      else if (head.line > 0 && outline.is_open())
        tell("line", "no row 113 to 116 ends it", "left out");
      airport_.taxiway_lights.insert(airport_.taxiway_lights.end(), outline.edge_lights().begin(),
                                     outline.edge_lights().end());
      if (pavement && !outline.rings().empty()) {
        pavement->rings = outline.rings();
        airport_.pavements.push_back(std::move(*pavement));
      }
      pavement.reset();
      outline = {};
    };
    for (const Row& row : around_) {
      if (problems_.is_full()) return;
      const std::vector<std::string_view> fields = fields_of(row.text);
      const std::string_view code = fields[0];
      if (code == "21") {
        read_aid(fields, row.place);
      } else if (code == "110" || code == "120" || code == "130") {
        finish();
        head = row.place;
        if (code != "110" || fields.size() < 2) continue;
        const auto surface = airport_code(fields[1], "surface", 0, 1'000'000, row.place, problems_);
        pavement = AirportPavement{surface_of_apt_code(surface.value_or(0)), {}, row.place};
      } else {
        outline.add(fields, row.place, problems_);
      }
    }
    finish();
  }

  void read_aid(const std::vector<std::string_view>& fields, const core::Place& place) {
    constexpr std::size_t kFewest = 5;
    if (fields.size() < kFewest || (fields[3] != "2" && fields[3] != "3")) {
      ++airport_.other_aids;
      return;
    }
    const auto angle_rad = [&](std::size_t index, const char* what,
                               const core::NumberRange& range) {
      return core::radians(
          airport_number(fields[index], what, range, "deg", place, problems_).value_or(0.0));
    };
    AirportPapi papi;
    papi.at = {angle_rad(1, "PAPI latitude", kLatitude_deg),
               angle_rad(2, "PAPI longitude", kLongitude_deg), 0.0};
    papi.heading_rad = angle_rad(4, "PAPI heading", {-360, 720});
    airport_.papis.push_back(papi);
  }

  LineReader lines_;
  const std::string& ident_;
  core::ProblemList& problems_;
  std::string_view line_;
  Airport airport_;
  Row head_;
  std::vector<Row> rows_, around_;  // of the airport at hand: runways; what lies beside them
  std::string other_;               // what it has instead of land runways
  bool in_airport_ = false, wanted_ = false, done_ = false;
  std::vector<std::string> names_;
};

}  // namespace

std::optional<Airport> read_apt_dat(const std::filesystem::path& file, const std::string& ident,
                                    core::ProblemList& problems) {
  core::ProblemList found;
  std::optional<Airport> airport = AptDatReader(file, ident, found).read();
  problems.append(found.all());
  return airport;
}

}  // namespace fanbeam::scenes
