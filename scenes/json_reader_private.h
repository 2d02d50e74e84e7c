// Members of a JSON file's objects, with everything that is wrong with them collected under its
// path ("scenarios[1].targets[0].rcs_m2"). Reading goes on after a problem: what is answered then
// has the right type and lies in the range asked for, and is of no other use. Private: carries
// nlohmann-json's type.
#pragma once

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/errors.h"

namespace fanbeam::scenes {

class JsonReader {
 public:
  // Of what is told of lengths, speeds and times without a range of their own.
  static constexpr double kMost = 1e12;
  static constexpr std::size_t kMostEntries = 1000;

  explicit JsonReader(std::string file) { place_.file = std::move(file); }

  // E-PARSE where `owner` is no object or has no such member; then nothing.
  const nlohmann::json* member(const nlohmann::json& owner, const std::string& path,
                               const char* key);

  // E-PARSE for another type, E-NONFINITE, E-RANGE; then the nearest allowed value.
  double number(const nlohmann::json* value, const std::string& path, double least, double most);
  double number(const nlohmann::json& owner, const std::string& path, const char* key,
                double least = -kMost, double most = kMost);
  // E-RANGE also for a fraction.
  int whole(const nlohmann::json& owner, const std::string& path, const char* key, int least,
            int most);
  bool flag(const nlohmann::json& value, const std::string& path);
  std::string text(const nlohmann::json& owner, const std::string& path, const char* key);
  // E-LIMIT above kMostEntries; empty where there is none.
  const nlohmann::json& list(const nlohmann::json& owner, const std::string& path, const char* key);
  // [x, y] with y to the left, to (forward, right).
  std::array<double, 2> forward_right(const nlohmann::json& owner, const std::string& path,
                                      const char* key);

  // Reports a problem that only the caller can see.
  void error(core::ErrorClass kind, const std::string& path, const std::string& value,
             const std::string& expected);
  const core::ProblemList& problems() const { return problems_; }

  static std::string joined(const std::string& path, const std::string& key);
  static std::string entry(const std::string& path, const char* key, std::size_t index);
  // As it stands in the file, short enough for a message.
  static std::string shown(const nlohmann::json& value);

 private:
  core::Place place_;
  core::ProblemList problems_;
};

}  // namespace fanbeam::scenes
