// Scenes with just one thing that fanbeam doctor looks for, and what it says of them.
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/doctor/scene_doctor.h"
#include "tests/scenes/scene_folder.h"

namespace fanbeam::tests {

using scenes::Finding;
using scenes::Findings;
using scenes::Severity;

// 60 m over level grass, looking north; the terrain reaches farther than the radar.
inline const std::string kPlain = R"([scene]
name = "plain"
origin = { latitude_deg = 52.0, longitude_deg = 10.0, height_m = 0.0 }
vertical_datum = "scene"
earth = "plane"
[terrain]
half_extent_m = 4000.0
spacing_m = 100.0
[trajectory.fixed]
at = { latitude_deg = 52.0, longitude_deg = 10.0 }
above_ground_m = 60.0
)";

// Degrees of latitude this far north of the radar: metres of arc on WGS 84 at 52 deg.
inline std::string north_of_it(double distance_m) {
  return "{ latitude_deg = " + core::number_text(52.0 + distance_m / 111267.0) +
         ", longitude_deg = 10.0 }";
}

// Of HiVision, the sensor of a scene that names none.
inline constexpr double kFarthest_m = 200.0 + 524 * 6.67;

// Horizontal triangles: corners (x, z) in metres and their height y, as glTF has its axes.
inline std::string gltf(const std::vector<float>& positions,
                        const std::vector<std::uint32_t>& corners) {
  std::string bytes(reinterpret_cast<const char*>(corners.data()), corners.size() * 4);
  const std::size_t begin = bytes.size();
  bytes.append(reinterpret_cast<const char*>(positions.data()), positions.size() * 4);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (bytes.size() % 3 != 0) bytes += '\0';
  std::string base64;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (const int shift : {18, 12, 6, 0}) base64 += digits[(word >> shift) & 63];
  }
  nlohmann::json document = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"name": "plate",
      "primitives": [{"attributes": {"POSITION": 1}, "indices": 0, "mode": 4}]}],
    "accessors": [{"bufferView": 0, "componentType": 5125, "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5126, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0}, {"buffer": 0}], "buffers": [{}]})");
  document["accessors"][0]["count"] = corners.size();
  document["accessors"][1]["count"] = positions.size() / 3;
  document["bufferViews"][0]["byteLength"] = begin;
  document["bufferViews"][1]["byteOffset"] = begin;
  document["bufferViews"][1]["byteLength"] = positions.size() * 4;
  document["buffers"][0]["byteLength"] = bytes.size();
  document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64;
  return document.dump();
}

inline std::string model_at(double north_m, double above_m, const std::string& name = "plate") {
  return "[[model]]\nname = \"" + name + "\"\nfile = \"plate.gltf\"\nat = " + north_of_it(north_m) +
         "\nabove_ground_m = " + core::number_text(above_m) + "\n";
}

inline std::string box_at(double north_m, const std::string& sizes, const std::string& more = "") {
  return "[[box]]\nname = \"box\"\nat = " + north_of_it(north_m) + "\n" + sizes + more;
}

inline Findings examined(const TemporaryFolder& folder, const std::string& text) {
  const Outcome outcome = build_text(folder, text);
  for (const core::Problem& problem : outcome.problems) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(outcome.scene != nullptr);
  return scenes::examine(*outcome.scene, outcome.problems);
}

inline std::vector<std::string> checks_of(const Findings& findings, Severity at_least) {
  std::vector<std::string> checks;
  for (const Finding& finding : findings)
    if (finding.severity >= at_least) checks.push_back(finding.check);
  return checks;
}

inline Finding found(const Findings& findings, const std::string& check) {
  for (const Finding& finding : findings) {
    UNSCOPED_INFO(finding.check << ' ' << finding.figure << ' ' << finding.unit << ' '
                                << finding.where);
    if (finding.check != check) continue;
    CHECK_FALSE(finding.what.empty());
    CHECK_FALSE(finding.where.empty());
    CHECK(finding.why.ends_with('.'));
    CHECK(finding.remedy.ends_with('.'));
    return finding;
  }
  FAIL("no " << check);
  return {};
}

inline void check_found(const Findings& findings, const std::string& check, Severity severity,
                        double figure, const std::string& unit, double margin) {
  const Finding finding = found(findings, check);
  CHECK(finding.severity == severity);
  CHECK(finding.figure == Approx(figure).epsilon(0.0).margin(margin));
  CHECK(finding.unit == unit);
}

}  // namespace fanbeam::tests
