// Options by what their values are: each with its check and what stands for its value in help.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/number_check.h"
#include "apps/value_words.h"
#include "core/number_range.h"

namespace fanbeam::apps {

template <class Value>
CLI::Option* add_number(CLI::App& command, const std::string& name, Value& value,
                        const core::NumberRange& range, const std::string& what) {
  return command.add_option(name, value, what)->check(number_from(range));
}

struct WholeNumbers {
  std::uint64_t least, most;
};

template <class Value>
CLI::Option* add_whole_number(CLI::App& command, const std::string& name, Value& value,
                              WholeNumbers range, const std::string& what) {
  return command.add_option(name, value, what)->check(whole_number_from(range.least, range.most));
}

template <class Value>
CLI::Option* add_word(CLI::App& command, const std::string& name, Value& value,
                      const std::vector<std::string>& words, const std::string& what) {
  return command.add_option(name, value, what)->check(CLI::IsMember(words));
}

inline CLI::Option* add_file(CLI::App& command, const std::string& name, std::string& file,
                             const std::string& what) {
  return command.add_option(name, file, what)->type_name(kFileValue);
}

inline CLI::Option* add_folder(CLI::App& command, const std::string& name, std::string& folder,
                               const std::string& what) {
  return command.add_option(name, folder, what)->type_name(kFolderValue);
}

}  // namespace fanbeam::apps
