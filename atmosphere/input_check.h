// Range checks and named choices shared by the models of this folder.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/errors.h"

namespace fanbeam::atmosphere {

// Closed interval of accepted values with the unit that messages print.
struct Range {
  double lowest;
  double highest;
  std::string_view unit;
};

// Adds E-NONFINITE or E-RANGE with the allowed interval in the text when `value` lies outside.
void check_range(core::ProblemList& problems, std::string_view field, double value,
                 const Range& range);

// The same for a single input: throws InputError.
void require_range(std::string_view field, double value, const Range& range);

// The same for a frequency, whose field is "frequency" and whose value and range are told in GHz,
// as everybody gives them. `whose` tells what has this range: "the fog law centimetre".
void check_frequency(core::ProblemList& problems, double frequency_Hz, double lowest_Hz,
                     double highest_Hz, std::string_view whose = {});
void require_frequency(double frequency_Hz, double lowest_Hz, double highest_Hz,
                       std::string_view whose = {});

// "35 GHz".
std::string GHz_text(double frequency_Hz);

// A closed set of choices and the names that scene files use for them.
template <typename Choice, std::size_t count>
using NameTable = std::array<std::pair<std::string_view, Choice>, count>;

// Throws InputError E-REF that lists the known names.
template <typename Choice, std::size_t count>
Choice choice_named(const NameTable<Choice, count>& table, std::string_view field,
                    std::string_view name) {
  std::string known;
  for (const auto& [entry_name, choice] : table) {
    if (entry_name == name) return choice;
    known += (known.empty() ? "one of " : ", ") + std::string(entry_name);
  }
  core::throw_input_error(core::ErrorClass::ref, std::string(field), std::string(name), known);
}

template <typename Choice, std::size_t count>
std::string_view name_in(const NameTable<Choice, count>& table, Choice wanted) {
  for (const auto& [entry_name, choice] : table)
    if (choice == wanted) return entry_name;
  throw core::InternalError("choice without a name");
}

}  // namespace fanbeam::atmosphere
