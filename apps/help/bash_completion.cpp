#include "apps/help/bash_completion.h"

#include <fmt/format.h>

#include <string_view>

#include "apps/common.h"
#include "apps/help/help_formatter.h"
#include "apps/help/option_text.h"
#include "apps/value_words.h"
#include "session/version.h"

namespace fanbeam::apps {
namespace {

// How the value of an option is completed, in the words of the script below.
std::string kind_of(const OptionText& option) {
  const auto begins = [&](std::string_view word) { return option.value.starts_with(word); };
  if (!option.offered.empty()) return fmt::format("list {}", fmt::join(option.offered, " "));
  if (!option.choices.empty())
    return fmt::format("{} {}", option.value.find(',') == std::string::npos ? "words" : "list",
                       fmt::join(option.choices, " "));
  if (begins(kSceneValue)) return "names scenes folder";
  if (begins(kSensorValue)) return "names sensors file";
  if (begins(kMaterialValue)) return "names materials";
  if (begins(kCommandValue)) return "commands";
  if (begins(kFolderValue)) return "folder";
  if (begins(kInputValue)) return "names scenes file";
  if (begins(kFileValue)) return "file";
  return "nothing";
}

// The branches of the script's tables for a command and those below it.
struct Tables {
  std::string commands, options, kinds;
};

void add(const CLI::App& command, Tables& tables) {
  const std::string key = key_of(command);
  std::vector<std::string> commands, options;
  for (const CLI::App* one : commands_of(command)) commands.push_back(one->get_name());
  int place = 0;
  for (const OptionText& option : options_of(command)) {
    std::vector<std::string> patterns;
    if (option.argument) {
      patterns.push_back("\"" + key + ":\"" +
                         (option.repeats ? "[0-9]*" : std::to_string(place++)));
    } else {
      options.insert(options.end(), option.names.begin(), option.names.end());
      if (option.value.empty()) continue;
      for (const std::string& name : option.names)
        patterns.push_back("\"" + key + ":" + name + "\"");
    }
    tables.kinds +=
        fmt::format("    {}) kind=\"{}\" ;;\n", fmt::join(patterns, " | "), kind_of(option));
  }
  if (!commands.empty())
    tables.commands +=
        fmt::format("    \"{}\") commands=\"{}\" ;;\n", key, fmt::join(commands, " "));
  tables.options += fmt::format("    \"{}\") options=\"{}\" ;;\n", key, fmt::join(options, " "));
  for (const CLI::App* one : commands_of(command)) add(*one, tables);
}

// `command` is what was typed of the path, `kind` how a value is completed.
// clang-format off
constexpr const char* kScript = R"bash(
_fanbeam_names() {
  local program
  program=$(type -P -- "$1") && "$program" list "$2" --names 2>/dev/null
}

_fanbeam() {
  local current="${COMP_WORDS[COMP_CWORD]}" command="" option="" kind="" commands="" options=""
  local word words="" prefix="" place=0 i
  local -a files=()
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word="${COMP_WORDS[i]}"
    if [[ $word == "=" ]]; then continue; fi
    if [[ $word == :* ]]; then i=$((i + 1)); continue; fi  # 0:10 comes as three words
    if [[ -n $option ]]; then option=""; continue; fi
    commands=""
    _fanbeam_commands "$command"
    kind=""
    if [[ $word == -* ]]; then
      _fanbeam_kind "$command:$word"
      if [[ -n $kind ]]; then option="$word"; fi
    elif [[ " $commands " == *" $word "* ]]; then
      command="${command:+$command }$word"
    else
      place=$((place + 1))
    fi
  done
  if [[ $current == "=" ]]; then current=""; fi

  kind=""
  if [[ -n $option ]]; then
    _fanbeam_kind "$command:$option"
  elif [[ $current == -* ]]; then
    _fanbeam_options "$command"
    kind="words $options"
  else
    commands=""
    _fanbeam_commands "$command"
    _fanbeam_kind "$command:$place"
    if [[ $place -eq 0 ]]; then words="$commands"; fi
  fi

  case "$kind" in
    words\ *) words="${kind#words }" ;;
    list\ *)
      words="${kind#list }"
      if [[ $current == *,* ]]; then prefix="${current%,*},"; fi
      compopt -o nospace 2>/dev/null
      ;;
    names\ *)
      read -r _ word kind <<<"$kind"
      words="$words $(_fanbeam_names "${COMP_WORDS[0]}" "$word")"
      ;;
    commands) _fanbeam_commands "" && words="$commands" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -P "$prefix" -W "$words" -- "${current#"$prefix"}")
  case "$kind" in
    file) mapfile -t files < <(compgen -f -- "$current") ;;
    folder) mapfile -t files < <(compgen -d -- "$current") ;;
  esac
  if [[ ${#files[@]} -gt 0 ]]; then
    COMPREPLY+=("${files[@]}")
    compopt -o filenames 2>/dev/null
  fi
}
complete -F _fanbeam fanbeam
)bash";
// clang-format on

std::string table(const std::string& name, const std::string& branches) {
  return "\n_fanbeam_" + name + "() {\n  case \"$1\" in\n" + branches + "  esac\n}\n";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  Tables tables;
  add(program, tables);
  return "# bash completion for fanbeam " + session::version_text() +
         ", written by \"fanbeam help --bash-completion\"\n" + table("commands", tables.commands) +
         table("options", tables.options) + table("kind", tables.kinds) + kScript;
}

}  // namespace fanbeam::apps
