// Checks of frequencies, and named choices, shared by the models of this folder.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/errors.h"

namespace fanbeam::atmosphere {

// Adds E-NONFINITE or E-RANGE for a frequency, whose field is "frequency" and whose value and range
// are told in GHz, as everybody gives them. `whose` tells what has this range: "the fog law
// centimetre". The other one throws.
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
