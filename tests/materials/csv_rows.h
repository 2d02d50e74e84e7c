// Rows of a committed oracle table: comment lines begin with '#', the first other line names the
// columns.
#pragma once

#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/text.h"

namespace fanbeam::tests {

class CsvRow {
 public:
  CsvRow(const std::vector<std::string>& columns, const std::string& line) {
    std::istringstream stream(line);
    for (const std::string& column : columns) std::getline(stream, cells_[column], ',');
  }
  const std::string& text(const std::string& column) const { return cells_.at(column); }
  double number(const std::string& column) const {
    const core::ParsedNumber parsed = core::parse_number(text(column));
    REQUIRE(parsed.error == core::NumberError::none);
    return parsed.value;
  }

 private:
  std::map<std::string, std::string> cells_;
};

inline std::vector<CsvRow> csv_rows(const std::string& file_in_test_data) {
  std::ifstream file(std::string(FANBEAM_SOURCE_DIR) + "/tests/data/" + file_in_test_data);
  REQUIRE(file.good());
  std::vector<std::string> columns;
  std::vector<CsvRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!columns.empty()) {
      rows.emplace_back(columns, line);
      continue;
    }
    std::istringstream header(line);
    for (std::string column; std::getline(header, column, ',');) columns.push_back(column);
  }
  REQUIRE_FALSE(rows.empty());
  return rows;
}

}  // namespace fanbeam::tests
