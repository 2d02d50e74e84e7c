// Tables that a product writes per frame, DIR/<product>/00000.csv: the first line is a comment that
// ends with the fingerprint of the run's input.
#pragma once

#include <filesystem>
#include <string>

namespace fanbeam::apps {

// "# obstacles of the input 0123456789abcdef"
std::string table_comment(const std::string& what, const std::string& fingerprint);

std::filesystem::path frame_table_path(const std::filesystem::path& folder,
                                       const std::string& product, int frame);

// Whether the table of a frame is there and of this input.
bool has_frame_table(const std::filesystem::path& folder, const std::string& product, int frame,
                     const std::string& fingerprint);

}  // namespace fanbeam::apps
