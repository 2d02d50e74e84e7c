// Limits of a number on the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace fanbeam::apps {

// CLI::Range lets NaN pass, which is neither below nor above anything.
inline CLI::Validator number_from(double least, double most) {
  const auto refuse_nan = [](std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && std::isnan(value)
               ? "Value " + text + " is not a number"
               : std::string();
  };
  return CLI::Range(least, most) & CLI::Validator(refuse_nan, "");
}

}  // namespace fanbeam::apps
