#include "terrain/gltf/gltf_data_uri.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/relative_uri.h"

namespace fanbeam::terrain {
namespace {

constexpr std::string_view kScheme = "data:";
constexpr std::string_view kBase64Mark = ";base64";
constexpr std::string_view kBase64Digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// Small and capital letters alike, in every locale.
bool is_same_word(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

[[noreturn]] void refuse(const core::Place& place, const std::string& field, std::string value,
                         std::string expected) {
  core::throw_input_error(core::ErrorClass::parse, place, field, std::move(value),
                          std::move(expected));
}

// tinygltf's decoder ends at the first byte that is no digit, without a word.
void check_base64(std::string_view digits, const core::Place& place, const std::string& field) {
  const std::size_t end = std::min(digits.find_last_not_of('=') + 1, digits.size());
  const std::size_t wrong = digits.substr(0, end).find_first_not_of(kBase64Digits);
  if (wrong != std::string_view::npos)
    refuse(place, field, "character " + std::to_string(wrong + 1) + " of the data",
           "base64: letters, digits, + and /");
  if (digits.size() - end > 2 || end % 4 == 1)
    refuse(place, field, std::to_string(end) + " digits of base64", "whole bytes");
}

}  // namespace

bool is_data_uri(std::string_view uri) { return is_same_word(uri.substr(0, 5), kScheme); }

std::string data_uri_bytes(std::string_view uri, const core::Place& place,
                           const std::string& field) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos)
    refuse(place, field, "a data: URI without a comma", "data:[type][;base64],data");
  const std::string_view type = uri.substr(kScheme.size(), comma - kScheme.size());
  const std::string_view encoded = uri.substr(comma + 1);
  core::PercentDecoded decoded = core::percent_decoded(encoded);
  if (decoded.wrong != std::string::npos)
    refuse(place, field, "\"" + std::string(encoded.substr(decoded.wrong, 3)) + "\"",
           "\"%\" with two hexadecimal digits");
  std::string data = std::move(decoded.bytes);
  const bool is_base64 = type.size() >= kBase64Mark.size() &&
                         is_same_word(type.substr(type.size() - kBase64Mark.size()), kBase64Mark);
  if (!is_base64) return data;
  check_base64(data, place, field);
  // The decoder knows few media types.
  data.insert(0, "data:application/octet-stream;base64,");
  std::string media_type;
  std::vector<unsigned char> bytes;
  tinygltf::DecodeDataURI(&bytes, media_type, data, 0, false);
  return {bytes.begin(), bytes.end()};
}

}  // namespace fanbeam::terrain
