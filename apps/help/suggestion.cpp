#include "apps/help/suggestion.h"

#include <algorithm>

#include "apps/help/help_formatter.h"
#include "apps/help/option_text.h"
#include "core/spelling.h"

namespace fanbeam::apps {
namespace {

// The nearest name, if a slip of the finger or a word left out may have made the other of it.
std::string meant(const std::string& word, const std::vector<std::string>& known) {
  const std::size_t letters = word.size() - std::min(word.find_first_not_of('-'), word.size());
  for (const std::string& name : known)
    if (letters >= 3 && name.starts_with(word)) return name;
  const std::vector<std::string> nearest = core::nearest_names(word, known, 1);
  if (nearest.empty()) return {};
  const bool swapped =
      std::is_permutation(word.begin(), word.end(), nearest.front().begin(), nearest.front().end());
  const std::size_t most = std::max<std::size_t>(swapped ? 2 : 1, letters / 3);
  return core::edit_distance(word, nearest.front()) <= most ? nearest.front() : std::string();
}

std::string question(const std::string& name, const std::string& otherwise) {
  return name.empty() ? otherwise : "; did you mean " + name + "?";
}

// The command that the words led to.
const CLI::App& chosen(const CLI::App& program) {
  for (const CLI::App* command : program.get_subcommands())
    if (!command->get_name().empty()) return chosen(*command);
  return program;
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const OptionText& option : options_of(command))
    if (!option.argument) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::string no_such_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const std::vector<std::string> names = names_of_options(command);
  if (std::find(names.begin(), names.end(), name) != names.end())  // but given before the command
    return path_of(command) + ": " + name + " belongs after the command: " + path_of(command) +
           " " + name + "\n";
  return path_of(command) + ": no option " + name + question(meant(name, names), "") + "\n";
}

// Options by names that do not exist; else words that nothing takes.
std::string unknown_words(const CLI::App& program) {
  const CLI::App& command = chosen(program);
  std::string text;
  for (const std::string& word : program.remaining(true))
    if (word.size() > 1 && word.front() == '-') text += no_such_option(command, word);
  if (!text.empty() || program.remaining(true).empty()) return text;
  const std::string word = program.remaining(true).front();
  return commands_of(command).empty() ? path_of(command) + ": nothing to do with \"" + word + "\"\n"
                                      : no_such_command(command, word);
}

// "takes 1 or 2 values, N[,N]: 3 given"
std::string count_text(const CLI::Option& option, const std::string& value) {
  const int least = option.get_items_expected_min(), most = option.get_items_expected_max();
  return " takes " + (least == most ? "" : std::to_string(least) + " or ") + std::to_string(most) +
         " values, " + value + ": " + std::to_string(option.results().size()) + " given";
}

// Fewer values than the option takes, or more; of one value more: given more than once.
std::string wrong_count(const CLI::App& command, const CLI::ParseError& error) {
  const std::string what = error.what();
  const std::string name = what.substr(0, what.find(':'));
  const CLI::Option* const given = command.get_option_no_throw(name);
  const std::size_t count = given == nullptr ? 0 : given->results().size();
  for (const OptionText& option : options_of(command)) {
    if (std::find(option.names.begin(), option.names.end(), name) == option.names.end()) continue;
    if (count > 0 && given->get_items_expected_max() > 1)
      return name + count_text(*given, option.value);
    return count > 1 ? name + " is given more than once: one " + option.value
                     : name + " needs " + option.value + ": " + option.sentence;
  }
  return what;
}

}  // namespace

std::string no_such_command(const CLI::App& parent, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::App* one : commands_of(parent)) names.push_back(one->get_name());
  std::string all;
  for (const std::string& name : names) all += " " + name;
  return path_of(parent) + ": no command " + word +
         question(meant(word, names), "; there are" + all) + "\n";
}

std::string usage_error_text(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = chosen(program);
  const std::string unknown = unknown_words(program);
  if (unknown.empty() && &command == &program && error.get_name() == "RequiredError")
    return program.help() + examples_text(program) + "\nfanbeam: a command is missing\n";
  const std::string more = &command == &program
                               ? "\"fanbeam help\" lists the commands\n"
                               : "\"fanbeam help " + key_of(command) + "\" lists its options\n";
  if (!unknown.empty()) return unknown + more;
  const bool miscounted = error.get_name() == "ArgumentMismatch";
  return path_of(command) + ": " + (miscounted ? wrong_count(command, error) : error.what()) +
         "\n" + more;
}

}  // namespace fanbeam::apps
