#include "session/signal/file_order.h"

#include <string>
#include <string_view>

namespace fanbeam::session {
namespace {

bool is_digit(char one) { return one >= '0' && one <= '9'; }

// The number that begins at `at`, without zeros in front; `at` is then behind it.
std::string_view number_at(std::string_view text, std::size_t& at) {
  std::size_t first = at;
  while (at < text.size() && is_digit(text[at])) ++at;
  while (first < at && text[first] == '0') ++first;
  return text.substr(first, at - first);
}

// In a number behind a point between digits: a decimal, which goes digit by digit.
bool is_decimal(std::string_view text, std::size_t at) {
  while (at > 0 && is_digit(text[at - 1])) --at;
  return at >= 2 && text[at - 1] == '.' && is_digit(text[at - 2]);
}

bool is_before(std::string_view a, std::string_view b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j]) && !is_decimal(a, i) && !is_decimal(b, j)) {
      const std::string_view left = number_at(a, i), right = number_at(b, j);
      if (left.size() != right.size()) return left.size() < right.size();
      if (left != right) return left < right;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;
}

}  // namespace

bool comes_before(const std::filesystem::path& a, const std::filesystem::path& b) {
  return is_before(a.filename().string(), b.filename().string());
}

}  // namespace fanbeam::session
