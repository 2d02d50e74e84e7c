// Rows of the published tables in tests/data: '#' comments, one header line, no quoting.
#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/text.h"

namespace fanbeam::tests {

// Unknown columns and cells that hold no number throw: a test then fails with the column's name.
class DataRow {
 public:
  DataRow(const std::vector<std::string>& columns, const std::string& line) {
    std::istringstream stream(line);
    for (const std::string& column : columns) std::getline(stream, cells_[column], ',');
  }
  const std::string& text(const std::string& column) const { return cells_.at(column); }
  bool has(const std::string& column) const { return !text(column).empty(); }
  double number(const std::string& column) const {
    const core::ParsedNumber parsed = core::parse_number(text(column));
    if (parsed.error != core::NumberError::none)
      throw std::runtime_error("column " + column + " holds \"" + text(column) + "\"");
    return parsed.value;
  }

 private:
  std::map<std::string, std::string> cells_;
};

// At least one row, else an exception.
inline std::vector<DataRow> data_rows(const std::string& file_in_test_data) {
  const std::string path = std::string(FANBEAM_SOURCE_DIR) + "/tests/data/" + file_in_test_data;
  std::ifstream file(path);
  std::vector<std::string> columns;
  std::vector<DataRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (!columns.empty()) {
      rows.emplace_back(columns, line);
      continue;
    }
    std::istringstream header(line);
    for (std::string column; std::getline(header, column, ',');) columns.push_back(column);
  }
  if (rows.empty()) throw std::runtime_error(path + " holds no rows or cannot be read");
  return rows;
}

}  // namespace fanbeam::tests
