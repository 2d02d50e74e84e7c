#include "apps/help/help_formatter.h"

#include "apps/help/command_notes.h"
#include "apps/help/option_text.h"
#include "apps/text_table.h"

namespace fanbeam::apps {
namespace {

constexpr std::size_t kHelpWidth = 80;
constexpr std::size_t kLead = 26;

// The text on lines of the help's width; nothing of none.
std::string lines_of(const std::string& text) {
  std::string all;
  if (text.empty()) return all;
  for (const std::string& line : wrapped(text, kHelpWidth)) all += line + '\n';
  return all;
}

// The text beside the lead; below it where the lead is long.
std::string entry(const std::string& lead, const std::string& text) {
  std::string all = "  " + lead;
  const std::string indent(kLead, ' ');
  bool beside = all.size() + 2 <= kLead;
  if (beside) all.append(kLead - all.size(), ' ');
  for (const std::string& line : wrapped(text, kHelpWidth - kLead)) {
    all += (beside ? "" : "\n" + indent) + line;
    beside = false;
  }
  return all + '\n';
}

std::string exit_codes_text(const CLI::App& command) {
  std::string text;
  for (const ExitCode& code : exit_codes_of(key_of(command)))
    text += (text.empty() ? "Exit codes: " : ", ") + code.codes + " " + code.meaning;
  return lines_of(text);
}

}  // namespace

HelpFormatter::HelpFormatter() {
  label("Positionals", "Arguments");
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_description(const CLI::App* command) const {
  return lines_of(command->get_description()) + "\n";
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool) const {
  const OptionText text = text_of(*option);
  std::string lead = text.argument || text.names.front().size() == 2 ? "" : "    ";
  for (std::size_t i = 0; i < text.names.size(); ++i) lead += (i == 0 ? "" : ", ") + text.names[i];
  if (text.argument && text.repeats) lead += "...";
  if (!text.argument && !text.value.empty()) lead += " " + text.value;
  return entry(lead, text.sentence);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_expanded(const CLI::App* group) const {
  std::string text = "\n" + group->get_group() + ":\n";
  for (const CLI::Option* option : group->get_options())
    if (!option->get_group().empty()) text += make_option(option, false);
  return text;
}

std::string HelpFormatter::make_footer(const CLI::App* command) const {
  const std::string footer =
      lines_of(command->get_parent() == nullptr
                   ? "\"fanbeam help COMMAND\" tells how a command is used, with examples."
                   : command->get_footer());
  return footer + (footer.empty() ? "" : "\n") + exit_codes_text(*command);
}

std::string examples_text(const CLI::App& command) {
  std::string text;
  for (const Example& example : examples_of(key_of(command)))
    text.append("  ").append(example.line).append("\n      ").append(example.what).append("\n");
  return text.empty() ? text : "\nExamples:\n" + text;
}

std::string key_of(const CLI::App& command) {
  const std::string path = path_of(command);
  const std::size_t blank = path.find(' ');
  return blank == std::string::npos ? std::string() : path.substr(blank + 1);
}

}  // namespace fanbeam::apps
