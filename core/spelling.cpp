#include "core/spelling.h"

#include <algorithm>
#include <utility>

namespace fanbeam::core {
namespace {

// The distance costs the product of both lengths, and a hostile file may hold very long names.
constexpr std::size_t kLongestCompared = 100;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& known, std::size_t most) {
  const std::string_view start = wanted.substr(0, kLongestCompared);
  std::vector<std::pair<std::size_t, std::size_t>> ranked;  // distance, index
  for (std::size_t i = 0; i < known.size(); ++i) {
    const std::string_view candidate = std::string_view(known[i]).substr(0, kLongestCompared);
    ranked.emplace_back(edit_distance(start, candidate), i);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i)
    names.push_back(known[ranked[i].second]);
  return names;
}

}  // namespace fanbeam::core
