// Bytes that stand in a URI itself: RFC 2397 (Masinter 1998), "data:[type][;base64],data".
// The data are percent-encoded (RFC 3986, section 2.1), or base64 (RFC 4648, section 4) with or
// without its padding; the media type is not looked at.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.h"

namespace fanbeam::terrain {

bool is_data_uri(std::string_view uri);

// Never longer than the URI. Errors: E-PARSE (no comma, "%" without two digits, what base64 does not
// have); `place` and `field` go into the message.
std::string data_uri_bytes(std::string_view uri, const core::Place& place,
                           const std::string& field);

}  // namespace fanbeam::terrain
