#include "apps/text_table.h"

#include <algorithm>

namespace fanbeam::apps {
namespace {

constexpr std::size_t kWidth = 100;

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t blank = std::min(text.find(' ', from), text.size());
    std::string word = text.substr(from, blank - from);
    from = blank + 1;
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width)
      lines.emplace_back();
    for (; word.size() > width; word.erase(0, width)) {  // a path, say
      lines.back() = word.substr(0, width);
      lines.emplace_back();
    }
    if (!lines.back().empty()) lines.back() += ' ';
    lines.back() += word;
  }
  return lines;
}

std::string beside(const std::string& lead, const std::string& text) {
  std::string all;
  for (const std::string& line : wrapped(text, kWidth - lead.size())) {
    all += all.empty() ? lead : std::string(lead.size(), ' ');
    all += line + '\n';
  }
  return all;
}

}  // namespace fanbeam::apps
