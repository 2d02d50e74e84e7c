#include "apps/help/option_text.h"

#include <algorithm>
#include <map>

#include "apps/value_words.h"

namespace fanbeam::apps {
namespace {

// CLI11 joins the type and what its validators say of themselves: "FLOAT:0.1 to 10", "TEXT:{a,b}".
struct Declared {
  std::string type;
  std::string range;
  std::vector<std::string> choices, offered;
};

std::vector<std::string> members(const std::string& set) {
  return CLI::detail::split(set.substr(1, set.size() - 2), ',');
}

Declared declared(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  const std::size_t colon = std::min(text.find(':'), text.size());
  Declared found{text.substr(0, colon), text.substr(std::min(colon + 1, text.size())), {}, {}};
  const std::string offered = kOffered;
  if (found.range.starts_with(offered)) {
    found.offered = members(found.range.substr(offered.size()));
    found.range.clear();
  } else if (found.range.starts_with('{')) {
    found.choices = members(found.range);
    found.range.clear();
  }
  return found;
}

std::string value_word(const CLI::Option& option, const Declared& found) {
  if (option.get_expected_max() == 0) return {};  // a flag
  static const std::map<std::string, std::string> words = {
      {"FLOAT", "NUMBER"}, {"INT", "N"}, {"UINT", "N"}};
  const auto word = words.find(found.type);
  std::string one = word == words.end() ? found.type : word->second;
  if (one.find(',') != std::string::npos) return one;  // says itself how many
  if (one == "TEXT" && !found.choices.empty()) one = "WORD";
  const int most = option.get_items_expected_max();
  const bool list = option.get_delimiter() != '\0';
  if (most == 2) return one + (list ? "," : " ") + one;
  if (list || !found.offered.empty()) return one + ",...";
  return option.get_expected_min() == 0 ? "[" + one + "]" : one;
}

std::string enumerated(const std::vector<std::string>& words, const std::string& last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " " + last + " " : ", ") + words[i];
  return text;
}

std::vector<std::string> names_of(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options)
    if (!option->get_group().empty()) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());
  return names;
}

bool says_all(const std::string& text, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return text.find(word) != std::string::npos; });
}

std::string sentence_of(const CLI::Option& option, const Declared& found) {
  std::string text = option.get_description();
  const auto more = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (text.find(found.range) == std::string::npos) more(found.range);
  if (!says_all(text, found.choices))
    more(option.get_delimiter() == '\0' ? enumerated(found.choices, "or")
                                        : "any of " + enumerated(found.choices, "and"));
  const std::vector<std::string> needs = names_of(option.get_needs());
  const std::vector<std::string> excludes = names_of(option.get_excludes());
  if (!needs.empty()) more("only with " + enumerated(needs, "and"));
  if (!excludes.empty()) more("not with " + enumerated(excludes, "or"));
  std::string standard = option.get_default_str();
  if (standard.starts_with('[')) standard = standard.substr(1, standard.size() - 2);  // of a list
  if (!standard.empty()) more("default " + standard);
  if (option.get_required()) more("required");
  return text;
}

// CLI11 keeps the options of a group in a subcommand without a name.
void add_options(const CLI::App& command, bool arguments, std::vector<OptionText>& texts) {
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty() && option->get_positional() == arguments)
      texts.push_back(text_of(*option));
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* one) { return one->get_name().empty(); }))
    add_options(*group, arguments, texts);
}

}  // namespace

OptionText text_of(const CLI::Option& option) {
  const Declared found = declared(option);
  OptionText text;
  text.argument = option.get_positional();
  if (text.argument) {
    text.names = {option.get_name(true)};
  } else {
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  }
  text.required = option.get_required();
  text.repeats = option.get_expected_max() >= CLI::detail::expected_max_vector_size;
  text.value = value_word(option, found);
  text.choices = found.choices;
  text.offered = found.offered;
  text.sentence = sentence_of(option, found);
  return text;
}

std::vector<OptionText> options_of(const CLI::App& command) {
  std::vector<OptionText> texts;
  for (const bool argument : {true, false}) add_options(command, argument, texts);
  return texts;
}

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  return command.get_subcommands(
      [](const CLI::App* one) { return !one->get_name().empty() && !one->get_group().empty(); });
}

std::string path_of(const CLI::App& command) {
  const std::string& name = command.get_name();
  return command.get_parent() == nullptr ? name : path_of(*command.get_parent()) + " " + name;
}

}  // namespace fanbeam::apps
