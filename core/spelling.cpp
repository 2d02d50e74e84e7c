#include "core/spelling.h"

#include <algorithm>
#include <utility>

namespace fanbeam::core {
namespace {

// The distance costs the product of both lengths, and a hostile file may hold very long names.
constexpr std::size_t kLongestCompared = 100;
// Of names in messages.
constexpr std::size_t kMostListed = 20;
constexpr std::size_t kMostLookedAt = 1000;
constexpr std::size_t kLongestListed = 60;

// Two letters lie in many words.
constexpr std::size_t kShortestInside = 3;

std::size_t unlikeness(std::string_view wanted, std::string_view candidate) {
  if (candidate.empty() || wanted.empty()) return std::max(candidate.size(), wanted.size());
  if (candidate.find(wanted) != std::string_view::npos) return 0;
  // "lon" for longitude is nearer than altitude, but "radar" for radar_overides no nearer than radar_overrides.
  if (candidate.size() >= kShortestInside && wanted.find(candidate) != std::string_view::npos)
    return (wanted.size() - candidate.size() + 2) / 3;
  return edit_distance(wanted, candidate);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1), above = row, two_above = row;
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_above, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_above[j - 2] + 1);
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

std::string names_there_text(std::string_view wanted, const std::vector<std::string>& known) {
  if (known.empty()) return "; there are none";
  const std::string_view start = wanted.substr(0, kLongestListed);
  std::size_t least = kLongestListed + 1, likeliest = 0;
  for (std::size_t i = 0; i < std::min(kMostLookedAt, known.size()); ++i) {
    const std::string_view candidate = std::string_view(known[i]).substr(0, kLongestListed);
    const std::size_t unlike = unlikeness(start, candidate);
    if (2 * unlike > std::max(start.size(), candidate.size()) || unlike >= least) continue;
    least = unlike;
    likeliest = i;
  }
  std::string text = "; there are ";
  if (least <= kLongestListed)
    text = "; perhaps " + known[likeliest].substr(0, kLongestListed) + " of ";
  for (std::size_t i = 0; i < std::min(kMostListed, known.size()); ++i)
    text += (i == 0 ? "" : ", ") + known[i].substr(0, kLongestListed);
  if (known.size() > kMostListed)
    text += " and " + std::to_string(known.size() - kMostListed) + " more";
  return text;
}

}  // namespace fanbeam::core
