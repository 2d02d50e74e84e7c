#include "apps/help/man_page.h"

#include <algorithm>
#include <vector>

#include "apps/common.h"
#include "apps/help/command_notes.h"
#include "apps/help/help_formatter.h"
#include "apps/help/option_text.h"
#include "core/files.h"
#include "session/version.h"

namespace fanbeam::apps {
namespace {

// Text that roff sets as it is: no escape, no request, and hyphens that can be copied.
std::string plain(std::string_view text) {
  std::string roff;
  bool line_begins = true;
  for (const char letter : text) {
    if (line_begins && (letter == '.' || letter == '\'')) roff += "\\&";
    if (letter == '\\') {
      roff += "\\e";
    } else if (letter == '-') {
      roff += "\\-";
    } else if (letter == '~') {
      roff += "\\(ti";
    } else if (letter == '^') {
      roff += "\\(ha";
    } else {
      roff += letter;
    }
    line_begins = letter == '\n';
  }
  return roff;
}

std::string bold(std::string_view text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + plain(text) + "\\fR"; }

std::string section(const std::string& heading) { return ".SH " + heading + "\n"; }

std::string tagged(const std::string& tag, std::string_view text) {
  return ".TP\n" + tag + "\n" + plain(text) + "\n";
}

std::string page_name(const CLI::App& command) {
  std::string name = path_of(command);
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::string synopsis(const CLI::App& command) {
  std::string line = bold(path_of(command)) + " [\\fIOPTION\\fR...]";
  for (const OptionText& option : options_of(command)) {
    if (!option.argument) continue;
    const std::string word = italic(option.names.front()) + (option.repeats ? "..." : "");
    line += option.required ? " " + word : " [" + word + "]";
  }
  if (!commands_of(command).empty())
    line += command.get_require_subcommand_min() > 0 ? " " + italic("COMMAND")
                                                     : " [" + italic("COMMAND") + "]";
  return section("SYNOPSIS") + line + "\n";
}

std::string tag_of(const OptionText& option) {
  std::string tag;
  for (const std::string& name : option.names)
    tag += (tag.empty() ? "" : ", ") + (option.argument ? italic(name) : bold(name));
  if (!option.argument && !option.value.empty()) tag += " " + italic(option.value);
  return tag;
}

std::string options_sections(const CLI::App& command) {
  std::string roff;
  for (const bool argument : {true, false}) {
    std::string entries;
    for (const OptionText& option : options_of(command))
      if (option.argument == argument) entries += tagged(tag_of(option), option.sentence);
    if (!entries.empty()) roff += section(argument ? "ARGUMENTS" : "OPTIONS") + entries;
  }
  return roff;
}

std::string commands_section(const CLI::App& command) {
  std::string roff, heading;
  for (const CLI::App* one : commands_of(command)) {
    if (roff.empty()) roff = section("COMMANDS");
    if (command.get_parent() == nullptr && one->get_group() != heading) {
      heading = one->get_group();
      roff += ".SS " + plain(heading) + "\n";
    }
    roff += tagged("\\fB" + plain(page_name(*one)) + "\\fR(1)", one->get_description());
  }
  return roff;
}

std::string notes_sections(const CLI::App& command) {
  const std::string key = key_of(command);
  std::string roff;
  for (const Example& example : examples_of(key)) {
    if (roff.empty()) roff = section("EXAMPLES");
    roff += tagged(bold(example.line), example.what);
  }
  roff += section("EXIT STATUS");
  for (const ExitCode& code : exit_codes_of(key))
    roff +=
        tagged(bold(code.codes), code.meaning + (code.detail.empty() ? "" : ": ") + code.detail);
  return roff;
}

std::string see_also(const CLI::App& command) {
  std::vector<std::string> pages;
  if (command.get_parent() != nullptr) pages.push_back(page_name(*command.get_parent()));
  for (const CLI::App* one : commands_of(command)) pages.push_back(page_name(*one));
  std::string line;
  for (const std::string& page : pages) line += (line.empty() ? "" : ", ") + bold(page) + "(1)";
  return section("SEE ALSO") + line + "\n";
}

std::string in_capitals(std::string text) {
  for (char& letter : text) letter = letter >= 'a' && letter <= 'z' ? char(letter - 32) : letter;
  return text;
}

}  // namespace

std::string man_page(const CLI::App& command) {
  const std::string description = command.get_description();
  const bool is_program = command.get_parent() == nullptr;
  std::string page = ".\\\" Written by \"fanbeam help --man-pages\".\n.TH " +
                     plain(in_capitals(page_name(command))) + " 1 \"" +
                     plain(session::date_text()) + "\" \"fanbeam " +
                     plain(session::version_text()) + "\" \"User Commands\"\n.nh\n.ad l\n";
  page += section("NAME") + plain(page_name(command)) + " \\- " +
          (is_program ? "renderer of imaging millimetre\\-wave radar" : plain(description)) + "\n";
  page += synopsis(command) + section("DESCRIPTION") +
          plain(description + (description.ends_with('.') ? "" : ".")) + "\n";
  if (!command.get_footer().empty()) page += ".PP\n" + plain(command.get_footer()) + "\n";
  page += commands_section(command) + options_sections(command) + notes_sections(command);
  page += section("ENVIRONMENT") +
          tagged(bold("FANBEAM_DATA"), "Folder with terrain and flight data of scenes");
  return page + see_also(command);
}

void write_man_pages(const CLI::App& program, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  core::write_file_atomically(folder / (page_name(program) + ".1"), man_page(program));
  for (const CLI::App* command : commands_of(program)) write_man_pages(*command, folder);
}

}  // namespace fanbeam::apps
