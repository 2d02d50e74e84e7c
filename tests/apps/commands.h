// What the program says of its own commands, read from its man pages.
#pragma once

#include <string>
#include <vector>

#include "tests/apps/program.h"

namespace fanbeam::tests {

struct ManOption {
  std::string tag;  // "-o, --output FOLDER", "SCENE"
  std::string text;

  std::string name() const {  // "--output", "SCENE"
    const std::size_t at = tag.find("--");
    const std::string from = at == std::string::npos ? tag : tag.substr(at);
    return from.substr(0, from.find_first_of(", "));
  }
  bool takes(const std::string& value) const { return tag.ends_with(" " + value); }
};

struct ManPage {
  std::string command;             // "materials plot"; empty for the program
  std::string text;                // without roff
  std::vector<ManOption> options;  // and arguments
};

// Without the escapes that the pages use.
inline std::string without_roff(std::string text) {
  const std::pair<const char*, const char*> escapes[] = {
      {"\\fB", ""},   {"\\fI", ""},   {"\\fR", ""}, {"\\-", "-"},
      {"\\(ti", "~"}, {"\\(ha", "^"}, {"\\&", ""},  {"\\e", "\\"}};
  for (const auto& [from, to] : escapes)
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;)
      text.replace(at, std::string(from).size(), to);
  return text;
}

inline ManPage read_man_page(const std::filesystem::path& file) {
  ManPage page;
  page.text = without_roff(bytes_of(file));
  std::istringstream lines(page.text);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(".SH ")) section = line.substr(4);
    if (section == "SYNOPSIS" && line.starts_with("fanbeam "))
      page.command = line.substr(8, std::max<std::size_t>(line.find(" ["), 8) - 8);
    if (line == ".TP" && (section == "OPTIONS" || section == "ARGUMENTS")) {
      ManOption option;
      std::getline(lines, option.tag);
      std::getline(lines, option.text);
      page.options.push_back(option);
    }
  }
  if (page.command.starts_with("[")) page.command.clear();
  return page;
}

// Of the program, every command and every subcommand.
inline std::vector<ManPage> man_pages() {
  const TemporaryFolder folder;
  const Result written = run_fanbeam("help --man-pages " + quoted(folder.path() / "man1"));
  INFO(written.output);
  REQUIRE(written.exit_code == 0);
  std::vector<ManPage> pages;
  for (const auto& [name, text] : contents(folder.path() / "man1"))
    pages.push_back(read_man_page(folder.path() / "man1" / name));
  return pages;
}

}  // namespace fanbeam::tests
