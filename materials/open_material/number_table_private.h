// Look-up tables of the standard: rows of numbers, sorted by their columns.
#pragma once

#include <vector>

#include "core/json_node.h"

namespace fanbeam::materials {

inline constexpr std::uint64_t kLargestTableFile_bytes = 16u << 20;
inline constexpr std::size_t kMostTableRows = 200000;

// What the schemas allow: up to 17.16 mm, which is 17.5 GHz.
inline constexpr core::NumberRange kTableWavelength_m{1e-9, 17.16e-3};
// The schemas print pi/2 as 1.570796.
inline constexpr core::NumberRange kTableZenith_rad{0.0, 1.570797};

using TableRow = std::vector<std::optional<double>>;  // nothing where the file has null

// E-PARSE (no array, a row of another length, a value that is no number or null), E-RANGE (a value
// outside its column, a row that belongs before the one above it), E-LIMIT (kMostTableRows). Rows
// with a problem are left out.
std::vector<TableRow> read_number_table(const core::JsonNode& table,
                                        const std::vector<core::NumberRange>& columns);

}  // namespace fanbeam::materials
