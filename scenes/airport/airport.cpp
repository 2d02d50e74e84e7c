#include "scenes/airport/airport.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "core/spelling.h"
#include "core/text.h"
#include "core/units.h"
#include "terrain/local_frame.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

// "6l" as (6, "L"); a number of 0 for what is no designator.
struct Designator {
  int number = 0;
  std::string suffix;
};

Designator designator_of(std::string_view name) {
  Designator result;
  std::size_t i = 0;
  for (; i < name.size() && i < 2 && name[i] >= '0' && name[i] <= '9'; ++i)
    result.number = 10 * result.number + (name[i] - '0');
  if (result.number < 1 || result.number > 36 || name.size() > i + 1) return {};
  if (i == name.size()) return result;
  if (std::isalpha(static_cast<unsigned char>(name[i])) == 0) return {};
  result.suffix = static_cast<char>(std::toupper(static_cast<unsigned char>(name[i])));
  return result;
}

std::string runways_text(const Airport& airport) {
  std::string text;
  for (const AirportRunway& runway : airport.runways)
    text += (text.empty() ? "" : ", ") + runway.ends[0].name + "/" + runway.ends[1].name;
  return text.empty() ? "none" : text;
}

void check_ends(const Landing& landing, core::ProblemList& problems) {
  const core::Place& place = landing.runway.place;
  if (landing.length_m < 100.0 || landing.length_m > 10e3)
    problems.error(ErrorClass::range, place, "distance of the runway's ends",
                   core::number_text(std::round(landing.length_m)) + " m",
                   "100 to 10000 m (latitude before longitude)");
  const AirportRunwayEnd* const ends = landing.runway.ends;
  check_displaced(ends[0].displaced_m + ends[1].displaced_m, landing.length_m, place, problems);
  if (landing.runway.surface.water)
    problems.error(ErrorClass::unsupported, place, "surface", landing.runway.surface.as_found,
                   "a runway on land");
  const std::optional<double> nominal_deg = designated_bearing_deg(landing.threshold_end().name);
  if (!nominal_deg) return;
  const double off_deg =
      std::abs(core::degrees(core::wrap_pi_rad(landing.bearing_rad - core::radians(*nominal_deg))));
  const std::string bearing =
      core::number_text(std::round(core::degrees(landing.bearing_rad))) + " deg true";
  if (off_deg > 140.0)
    problems.error(
        ErrorClass::range, place, "bearing of runway " + landing.threshold_end().name, bearing,
        "about " + core::number_text(*nominal_deg) + " deg: the ends are the other way round");
  else if (off_deg > 40.0)
    problems.warning("BEARING", place, "bearing of runway " + landing.threshold_end().name, bearing,
                     "taken as it is, though the designator stands for " +
                         core::number_text(*nominal_deg) + " deg magnetic");
}

}  // namespace

bool is_same_ident(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::toupper(static_cast<unsigned char>(x)) ==
           std::toupper(static_cast<unsigned char>(y));
  });
}

bool is_same_runway(std::string_view a, std::string_view b) {
  const Designator first = designator_of(a), second = designator_of(b);
  if (first.number == 0 || second.number == 0) return a == b;
  return first.number == second.number && first.suffix == second.suffix;
}

std::string reciprocal_runway(std::string_view name) {
  const Designator designator = designator_of(name);
  if (designator.number == 0) return {};
  const int number = designator.number > 18 ? designator.number - 18 : designator.number + 18;
  std::string suffix = designator.suffix;
  if (suffix == "L")
    suffix = "R";
  else if (suffix == "R")
    suffix = "L";
  return (number < 10 ? "0" : "") + std::to_string(number) + suffix;
}

std::optional<double> designated_bearing_deg(std::string_view name) {
  const Designator designator = designator_of(name);
  if (designator.number == 0) return std::nullopt;
  return 10.0 * designator.number;
}

std::string landing_name(const std::string& ident, const std::string& runway) {
  std::string name = ident + "-" + runway;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return core::safe_word(name);
}

void report_unknown_airport(const std::string& ident, const std::vector<std::string>& known,
                            const core::Place& place, core::ProblemList& problems) {
  std::string near;
  for (const std::string& name : core::nearest_names(ident, known, 5))
    near += (near.empty() ? "" : ", ") + name;
  problems.error(ErrorClass::ref, place, "airport", "\"" + ident + "\"",
                 near.empty() ? "an airport of this file, which has none"
                              : "one of this file's airports (" + std::to_string(known.size()) +
                                    "), nearest: " + near);
}

void check_displaced(double both_m, double length_m, const core::Place& place,
                     core::ProblemList& problems) {
  if (both_m > 0.0 && both_m + 100.0 > length_m)
    problems.error(ErrorClass::range, place, "displaced thresholds",
                   core::number_text(both_m) + " m together",
                   "at least 100 m of the pavement's " + core::number_text(std::round(length_m)) +
                       " m left to land on");
}

std::optional<Landing> choose_landing(const Airport& airport, const std::string& runway,
                                      core::ProblemList& problems) {
  for (const AirportRunway& candidate : airport.runways) {
    for (const int end : {0, 1}) {
      if (!is_same_runway(candidate.ends[end].name, runway)) continue;
      Landing landing{candidate, end};
      const terrain::GeodesicLine line = terrain::geodesic_between(
          landing.threshold_end().pavement_end, landing.far_end().pavement_end);
      landing.length_m = line.length_m;
      landing.bearing_rad = core::radians(core::wrap_360_deg(core::degrees(line.azimuth_rad)));
      check_ends(landing, problems);
      return landing;
    }
  }
  problems.error(ErrorClass::ref, airport.place, "runway", "\"" + runway + "\"",
                 "the end to land on, of " + airport.ident + "'s " + runways_text(airport));
  return std::nullopt;
}

}  // namespace fanbeam::scenes
