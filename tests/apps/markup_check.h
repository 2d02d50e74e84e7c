// Whether tags are balanced and quoted as HTML 5 without optional end tags, or XML, wants it.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace fanbeam::tests {

// Empty when every tag is closed in order and no markup stands where text belongs; else what is
// wrong. `names` collects the elements met.
inline std::string markup_fault(const std::string& text, std::set<std::string>& names) {
  static const std::set<std::string> kVoid = {"meta", "img", "br"};
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '>') return "a '>' outside of a tag";
    if (text[at] != '<') {
      ++at;
      continue;
    }
    std::size_t end = at + 1;
    bool quoted = false;
    for (; end < text.size() && (quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '<') return "a '<' inside of a tag";
    }
    if (end == text.size()) return "a tag without an end";
    const std::string tag = text.substr(at + 1, end - at - 1);
    at = end + 1;
    if (tag.starts_with('!') || tag.starts_with('?')) continue;
    const bool closes = tag.starts_with('/');
    const std::string name =
        tag.substr(closes ? 1 : 0, tag.find_first_of(" /\n", 1) - (closes ? 1 : 0));
    names.insert(name);
    if (closes) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (!tag.ends_with('/') && !kVoid.contains(name)) {
      open.push_back(name);
      if (name == "style") at = text.find("</style>", at);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> stays open";
}

}  // namespace fanbeam::tests
