// Reads the committed reference tables of tests/data: '#' comments, one header line, no quoting.
#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/files.h"
#include "core/text.h"

namespace fanbeam::tests {

class OracleRow {
 public:
  OracleRow(const std::vector<std::string>& columns, const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      cells_[columns[i]] = i < cells.size() ? cells[i] : "";
  }
  const std::string& text(const std::string& column) const { return cells_.at(column); }
  bool has(const std::string& column) const { return !text(column).empty(); }
  double number(const std::string& column) const {
    const core::ParsedNumber parsed = core::parse_number(text(column));
    INFO("column " << column << ": '" << text(column) << "'");
    REQUIRE(parsed.error == core::NumberError::none);
    return parsed.value;
  }

 private:
  std::map<std::string, std::string> cells_;
};

inline std::vector<OracleRow> oracle_rows(const std::string& file_name) {
  const auto path = std::filesystem::path(FANBEAM_SOURCE_DIR) / "tests/data" / file_name;
  std::istringstream lines(core::read_file(path, 1u << 20));
  std::vector<OracleRow> rows;
  std::vector<std::string> columns;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    if (columns.empty())
      columns = cells;
    else
      rows.emplace_back(columns, cells);
  }
  return rows;
}

// Relative comparison; where the expected value is 0 the result must be 0 too.
inline Approx within(double expected, double relative) {
  return Approx(expected).epsilon(relative).scale(0.0).margin(0.0);
}

}  // namespace fanbeam::tests
