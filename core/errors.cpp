#include "core/errors.h"

#include <array>
#include <charconv>
#include <cmath>

namespace fanbeam::core {
namespace {

std::string summary(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

}  // namespace

std::string_view code(ErrorClass error_class) {
  constexpr std::array<std::string_view, 9> kCodes = {"E-PARSE", "E-RANGE",       "E-NONFINITE",
                                                      "E-REF",   "E-LIMIT",       "E-PATH",
                                                      "E-TIME",  "E-UNSUPPORTED", "E-IO"};
  return kCodes.at(static_cast<std::size_t>(error_class));
}

std::string number_text(double value) {
  std::array<char, 64> buffer{};
  const double size = std::abs(value);
  const bool plain = size >= 1e-4 && size < 1e7;
  char* const end = buffer.data() + buffer.size();
  const auto result = plain ? std::to_chars(buffer.data(), end, value, std::chars_format::fixed)
                            : std::to_chars(buffer.data(), end, value);
  return {buffer.data(), result.ptr};
}

std::string to_string(const Problem& problem) {
  std::string text;
  if (!problem.place.file.empty()) {
    text += problem.place.file;
    if (problem.place.line > 0) text.append(":").append(std::to_string(problem.place.line));
    if (problem.place.line > 0 && problem.place.column > 0)
      text.append(":").append(std::to_string(problem.place.column));
    if (problem.place.byte_offset >= 0)
      text.append(" byte ").append(std::to_string(problem.place.byte_offset));
    text += ": ";
  }
  text += problem.code;
  if (!problem.field.empty()) text += " " + problem.field;
  if (!problem.value.empty()) text += (problem.field.empty() ? " " : " = ") + problem.value;
  if (!problem.expected.empty())
    text += (problem.is_error() ? ": expected " : ": ") + problem.expected;
  return text;
}

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(summary(problems)), problems_(std::move(problems)) {}

bool InputError::has(ErrorClass error_class) const {
  for (const Problem& problem : problems_)
    if (problem.code == code(error_class)) return true;
  return false;
}

void throw_input_error(ErrorClass error_class, std::string field, double value,
                       std::string expected) {
  throw_input_error(error_class, Place{}, std::move(field), number_text(value),
                    std::move(expected));
}

void throw_input_error(ErrorClass error_class, std::string field, std::string value,
                       std::string expected) {
  throw_input_error(error_class, Place{}, std::move(field), std::move(value), std::move(expected));
}

void throw_input_error(ErrorClass error_class, Place place, std::string field, std::string value,
                       std::string expected) {
  throw InputError({Problem{std::string(code(error_class)), std::move(place), std::move(field),
                            std::move(value), std::move(expected)}});
}

void ProblemList::error(ErrorClass error_class, Place place, std::string field, std::string value,
                        std::string expected) {
  ++errors_;
  add(Problem{std::string(code(error_class)), std::move(place), std::move(field), std::move(value),
              std::move(expected)});
}

void ProblemList::warning(std::string_view name, Place place, std::string field, std::string value,
                          std::string done) {
  add(Problem{"W-" + std::string(name), std::move(place), std::move(field), std::move(value),
              std::move(done)});
}

void ProblemList::append(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) {
    if (problem.is_error()) ++errors_;
    add(problem);
  }
}

void ProblemList::add(Problem problem) {
  if (problems_.size() < kMost) {
    problems_.push_back(std::move(problem));
  } else if (problems_.size() == kMost) {
    Problem more;
    more.code = "W-MORE";
    more.expected = "further problems are not listed";
    problems_.push_back(std::move(more));
  }
}

void ProblemList::throw_if_errors() const {
  if (has_errors()) throw InputError(problems_);
}

}  // namespace fanbeam::core
