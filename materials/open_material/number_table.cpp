#include "materials/open_material/number_table_private.h"

namespace fanbeam::materials {
namespace {

using core::ErrorClass;

// Compares up to the first null: from there on the order says nothing.
bool belongs_before(const TableRow& row, const TableRow& above) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!row[i] || !above[i] || *row[i] > *above[i]) return false;
    if (*row[i] < *above[i]) return true;
  }
  return false;
}

// Whether the row can be used.
bool read_row(const core::JsonNode& node, const std::vector<core::NumberRange>& columns,
              TableRow& row) {
  if (node.elements() != columns.size()) {
    node.problems().error(ErrorClass::parse, node.place(), node.pointer(), "another row",
                          "an array of " + std::to_string(columns.size()) + " numbers or nulls");
    return false;
  }
  bool usable = true;
  row.clear();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const core::JsonNode cell = node.element(i);
    row.push_back(cell.number(columns[i]));
    usable = usable && (row.back() || !cell.present());
  }
  return usable;
}

}  // namespace

std::vector<TableRow> read_number_table(const core::JsonNode& table,
                                        const std::vector<core::NumberRange>& columns) {
  std::vector<TableRow> rows;
  TableRow row;
  bool sorted = true;
  const std::size_t count = table.size(kMostTableRows);
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const core::JsonNode node = table.element(i);
    if (!read_row(node, columns, row)) continue;
    if (sorted && !rows.empty() && belongs_before(row, rows.back())) {
      sorted = false;  // told once
      node.problems().error(ErrorClass::range, node.place(), node.pointer(), "out of order",
                            "rows sorted by their columns from the first on");
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace fanbeam::materials
