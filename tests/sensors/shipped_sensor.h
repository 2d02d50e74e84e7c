// Shipped sensor files, whole or with one line changed.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "core/errors.h"
#include "core/files.h"
#include "sensors/sensor_file.h"

namespace fanbeam::tests {

inline std::filesystem::path sensor_path(const std::string& name) {
  return std::filesystem::path(FANBEAM_SOURCE_DIR) / "sensors" / name;
}

inline sensors::Sensor shipped_sensor(const std::string& name) {
  core::ProblemList problems;
  const sensors::Sensor sensor = sensors::read_sensor(sensor_path(name), problems);
  for (const core::Problem& problem : problems.all()) UNSCOPED_INFO(core::to_string(problem));
  REQUIRE(problems.all().empty());
  return sensor;
}

inline sensors::Sensor hivision() { return shipped_sensor("hivision.toml"); }

// The text with the one place where `from` stands replaced.
inline std::string replaced_once(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO(from);
  REQUIRE(at != std::string::npos);
  REQUIRE(text.find(from, at + 1) == std::string::npos);
  return text.replace(at, from.size(), to);
}

inline std::string hivision_text(const std::string& from, const std::string& to) {
  return replaced_once(core::read_file(sensor_path("hivision.toml"), 1U << 20U), from, to);
}

}  // namespace fanbeam::tests
