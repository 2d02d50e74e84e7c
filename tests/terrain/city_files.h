// CityJSON of a test's own.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fanbeam::tests {

// A house of 12 m x 8 m (x from 1000 to 1012 m, y from 2000), walls up to 5 m and a ridge along x at 8 m, on
// the height of 40 m: a closed Solid with semantics. Eastings and northings of UTM zone 32 (EPSG:25832).
inline nlohmann::json house(double east_m = 600000.0, double north_m = 5790000.0,
                            double ridge_m = 8.0) {
  using nlohmann::json;
  json city = {
      {"type", "CityJSON"},
      {"version", "2.0"},
      {"metadata", {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/25832"}}},
      {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {east_m, north_m, 40.0}}}}};
  const std::vector<std::vector<double>> corners = {
      {0, 0, 0},  {12, 0, 0}, {12, 8, 0}, {0, 8, 0},       {0, 0, 5},
      {12, 0, 5}, {12, 8, 5}, {0, 8, 5},  {0, 4, ridge_m}, {12, 4, ridge_m}};
  for (const auto& corner : corners)
    city["vertices"].push_back({std::lround(corner[0] * 1000), std::lround(corner[1] * 1000),
                                std::lround(corner[2] * 1000)});
  const json shell = {{{3, 2, 1, 0}},    {{0, 1, 5, 4}}, {{1, 2, 6, 9, 5}}, {{2, 3, 7, 6}},
                      {{3, 0, 4, 8, 7}}, {{4, 5, 9, 8}}, {{8, 9, 6, 7}}};
  city["CityObjects"]["house"] = {
      {"type", "Building"},
      {"geometry",
       {{{"type", "Solid"},
         {"lod", "2.2"},
         {"boundaries", {shell}},
         {"semantics",
          {{"surfaces",
            {{{"type", "GroundSurface"}}, {{"type", "WallSurface"}}, {{"type", "RoofSurface"}}}},
           {"values", {{0, 1, 1, 1, 1, 2, 2}}}}}}}}};
  return city;
}

}  // namespace fanbeam::tests
