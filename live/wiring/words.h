// Words of an option's value with ",key=value" behind it, in any order.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fanbeam::live {

struct Worded {
  std::string head;
  std::vector<std::pair<std::string_view, std::string>> options;  // key without comma and sign

  // Whether a key but `several` stands there twice.
  bool repeats(std::string_view several = {}) const {
    for (auto one = options.begin(); one != options.end(); ++one)
      if (one->first != several &&
          std::any_of(std::next(one), options.end(),
                      [&](const auto& other) { return other.first == one->first; }))
        return true;
    return false;
  }
};

// Of the text's end: what is no ",key=value" of one of the keys stays in the head, commas and all.
inline Worded worded(std::string text, std::span<const std::string_view> keys) {
  Worded found;
  for (std::size_t at = text.rfind(','); at != std::string::npos; at = text.rfind(',')) {
    const std::string_view last = std::string_view(text).substr(at + 1);
    const std::size_t sign = last.find('=');
    std::string_view known;
    for (const std::string_view key : keys)
      if (sign != std::string_view::npos && last.substr(0, sign) == key) known = key;
    if (known.empty()) break;
    found.options.emplace_back(known, last.substr(sign + 1));
    text.resize(at);
  }
  found.head = std::move(text);
  return found;
}

}  // namespace fanbeam::live
