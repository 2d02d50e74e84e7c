// The text of a material library with all fitted values made again from their references: what
// `fanbeam materials fit --library` prints. Everything but the figures stays as it was, comments
// and order included.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::materials {

// Replaces the values of a, b and c of every row with a `reference`, and its frequency_exponent
// where the reference derives it. These keys must stand on lines of their own below the row's
// header. Problems of the library go to `problems`; then the text comes back unchanged.
std::string with_fits_made_again(std::string_view text, const std::string& file_name,
                                 core::ProblemList& problems);

}  // namespace fanbeam::materials
