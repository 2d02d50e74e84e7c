#include "core/errors.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "core/text.h"

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

std::vector<Problem>& sort_by_place(std::vector<Problem>& problems) {
  std::map<std::string, std::size_t> met;
  for (const Problem& problem : problems) met.try_emplace(problem.place.file, met.size());
  const auto key = [&](const Problem& problem) {
    return std::make_tuple(problem.code == "W-MORE", met.at(problem.place.file), problem.place.line,
                           problem.place.column);
  };
  std::stable_sort(problems.begin(), problems.end(),
                   [&](const Problem& a, const Problem& b) { return key(a) < key(b); });
  return problems;
}

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
  return printable_text(text);
}

namespace {

// At most `most` bytes of UTF-8, and dots where some were cut off.
void shorten(std::string& text, std::size_t most) {
  if (text.size() <= most) return;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  text.resize(most);
  text += "...";
}

// Names and values come from the input, which may hold megabytes of them.
Problem shortened(Problem problem) {
  shorten(problem.field, 300);
  shorten(problem.value, 500);
  shorten(problem.expected, 2000);
  return problem;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(summary(sort_by_place(problems))), problems_(std::move(problems)) {}

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
  throw InputError({shortened(Problem{std::string(code(error_class)), std::move(place),
                                      std::move(field), std::move(value), std::move(expected)})});
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
  problem = shortened(std::move(problem));
  if (problems_.size() < kMost) {
    problems_.push_back(std::move(problem));
    return;
  }
  if (problems_.size() == kMost) {
    Problem more;
    more.code = "W-MORE";
    more.expected = "further problems are not listed";
    problems_.push_back(std::move(more));
  }
  // With more errors than have a place, all places hold errors.
  if (!problem.is_error() || errors_ > kMost) return;
  // Warnings make room: a refusal has to show its reason.
  const auto warning = std::find_if(problems_.rbegin() + 1, problems_.rend(),
                                    [](const Problem& listed) { return !listed.is_error(); });
  if (warning == problems_.rend()) return;
  problems_.erase(std::next(warning).base());
  problems_.insert(problems_.end() - 1, std::move(problem));
}

void ProblemList::throw_if_errors() const {
  if (has_errors()) throw InputError(problems_);
}

}  // namespace fanbeam::core
