// Tables that a product writes per frame, DIR/<product>/00000.csv: comment lines with what stands in
// pictures as metadata, then the column names.
#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"

namespace fanbeam::session {

// "# obstacles\n# fanbeam:input 0123456789abcdef\n...".
std::string table_head(const std::string& what, const core::Metadata& metadata);

// What table_head wrote; nothing where there is no such file or it has no head.
core::Metadata table_metadata(const std::filesystem::path& table);

// Whether every line ends, and every row has as many fields as there are column names. A table that was cut
// between two rows looks whole: nothing in it says how many there were.
bool is_whole_table(const std::filesystem::path& table);

std::filesystem::path frame_table_path(const std::filesystem::path& folder,
                                       const std::string& product, int frame);

}  // namespace fanbeam::session
