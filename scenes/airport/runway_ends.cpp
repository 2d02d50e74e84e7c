#include "scenes/airport/runway_ends.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/text.h"
#include "core/units.h"

namespace fanbeam::scenes {
namespace {

using core::ErrorClass;

// "47.6660,9.4979,406.6"
std::optional<AirportRunwayEnd> end_from(const std::string& text, const char* option,
                                         core::ProblemList& problems) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const core::ParsedNumber number = core::parse_number(part);
    if (number.error != core::NumberError::none) break;
    numbers.push_back(number.value);
  }
  const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  const auto refuse = [&](const std::string& expected) {
    problems.error(ErrorClass::range, {}, option, "\"" + text + "\"", expected);
    return std::nullopt;
  };
  if (numbers.size() != commas + 1 || numbers.size() < 2 || numbers.size() > 3)
    return refuse("LAT,LON or LAT,LON,HEIGHT_M: degrees and metres with a decimal point");
  if (std::abs(numbers[0]) > 90.0 || std::abs(numbers[1]) > 180.0)
    return refuse(std::abs(numbers[0]) <= 180.0 && std::abs(numbers[1]) <= 90.0
                      ? "the latitude, -90 to 90 deg, before the longitude"
                      : "latitude -90 to 90, longitude -180 to 180 deg");
  if (numbers.size() == 3 && (numbers[2] < -500.0 || numbers[2] > 6000.0))
    return refuse("a height of -500 to 6000 m");
  AirportRunwayEnd end;
  end.pavement_end = {core::radians(numbers[0]), core::radians(numbers[1]), 0.0};
  if (numbers.size() == 3) end.elevation_m = numbers[2];
  return end;
}

}  // namespace

std::optional<Airport> airport_from_ends(const RunwayEnds& told, core::ProblemList& problems) {
  const auto near = end_from(told.threshold, "--threshold", problems);
  const auto far = end_from(told.far_end, "--far-end", problems);
  const std::string reciprocal = reciprocal_runway(told.runway);
  if (reciprocal.empty())
    problems.error(ErrorClass::range, {}, "--runway", "\"" + told.runway + "\"",
                   "01 to 36, with L, C or R where there are parallels");
  if (!near || !far || reciprocal.empty()) return std::nullopt;
  Airport airport;
  airport.ident = told.airport;
  AirportRunway runway;
  runway.ends[0] = *near;
  runway.ends[0].name = told.runway;
  runway.ends[1] = *far;
  runway.ends[1].name = reciprocal;
  runway.width_m = told.width_m;
  runway.surface = surface_of_text("");
  airport.runways.push_back(std::move(runway));
  return airport;
}

}  // namespace fanbeam::scenes
