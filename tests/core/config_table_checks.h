// What reading a TOML text reports.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "core/config_table.h"

namespace fanbeam::tests {

using Ask = std::function<void(core::ConfigTable&)>;

// What reading `text` and asking it reports.
inline std::vector<core::Problem> problems_of(const std::string& text, const Ask& ask) {
  core::ProblemList problems;
  core::ConfigTable root = core::ConfigTable::from_text(text, "test.toml", problems);
  ask(root);
  return problems.all();
}

inline void check(const std::vector<core::Problem>& found,
                  const std::vector<std::string>& expected) {
  std::vector<std::string> texts;
  texts.reserve(found.size());
  for (const core::Problem& problem : found) texts.push_back(core::to_string(problem));
  CHECK(texts == expected);
}

// The single problem that a text has before anything is asked.
inline core::Problem refusal_of(const std::string& text) {
  const std::vector<core::Problem> found =
      problems_of(text, [](core::ConfigTable& root) { CHECK_FALSE(root.present()); });
  REQUIRE(found.size() == 1);
  return found[0];
}

}  // namespace fanbeam::tests
