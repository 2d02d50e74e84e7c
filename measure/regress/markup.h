// Text inside HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace fanbeam::measure {

// Any bytes as text between tags or in quoted attributes: markup escaped, and U+FFFD for what XML
// 1.0 cannot hold (control characters but tab and line ends, halves of surrogate pairs, bytes that
// are no UTF-8).
std::string markup_text(std::string_view bytes);

}  // namespace fanbeam::measure
