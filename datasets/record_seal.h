// A run's record vouches for itself: its last entry is the SHA-256 of all bytes before it.
//
//   {
//    "fanbeam_run": 1,
//    ...
//    "record_sha256": "ba78..."
//   }
#pragma once

#include <string>
#include <string_view>

namespace fanbeam::datasets {

// The text of a record with its seal. `object`: of JSON, indented, with one entry at least.
std::string sealed(std::string_view object);
bool has_seal(std::string_view record);
// Whether the text is as it was sealed; true of one without a seal, as versions before seals wrote them.
bool is_intact(std::string_view record);

}  // namespace fanbeam::datasets
