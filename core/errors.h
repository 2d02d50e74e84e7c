// What can be wrong with input, and how it is told: all problems together, each with its place, the
// value found and what was expected. Libraries collect Problems and throw; only programs print.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::core {

// Why an input is refused. `code` gives the printed form, "E-RANGE".
enum class ErrorClass { parse, range, nonfinite, ref, limit, path, time, unsupported, io };

std::string_view code(ErrorClass error_class);

// Where in an input a problem sits. Zero or -1 means "not applicable".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  std::int64_t byte_offset = -1;
};

// One thing wrong (code "E-...") or odd (code "W-...") in an input.
struct Problem {
  std::string code;
  Place place;
  std::string field;     // "weather.visibility_m", "mesh 'truck' vertex 17"
  std::string value;     // as found
  std::string expected;  // what would have been right, or for a warning what is done about it

  bool is_error() const { return code.starts_with("E-"); }
};

// "scene.toml:12:5: E-RANGE weather.visibility_m = -3: expected 1 to 100000 m"
std::string to_string(const Problem& problem);

// Numbers in messages: shortest form that reads back to the same value, independent of the locale;
// without an exponent from 1e-4 to 1e7.
std::string number_text(double value);

// In the order of their places: files as first met, then lines and columns; W-MORE last. Answers the list.
std::vector<Problem>& sort_by_place(std::vector<Problem>& problems);

// Thrown when an input has at least one error; carries the warnings found beside it too, in the order of their places.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }
  bool has(ErrorClass error_class) const;

 private:
  std::vector<Problem> problems_;
};

// A broken invariant of ours: never the user's fault. Programs exit with code 5.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

// Throws an InputError of a single problem without a place.
[[noreturn]] void throw_input_error(ErrorClass error_class, std::string field, double value,
                                    std::string expected);
[[noreturn]] void throw_input_error(ErrorClass error_class, std::string field, std::string value,
                                    std::string expected);
[[noreturn]] void throw_input_error(ErrorClass error_class, Place place, std::string field,
                                    std::string value, std::string expected);

// Collects what is wrong while reading goes on. Caps the list, and the texts in it, so that a
// hostile file cannot fill memory; when it is full, errors displace warnings.
class ProblemList {
 public:
  static constexpr std::size_t kMost = 200;

  void error(ErrorClass error_class, Place place, std::string field, std::string value,
             std::string expected);
  // `name` is the part behind "W-", in capitals: "DEGENERATE".
  void warning(std::string_view name, Place place, std::string field, std::string value,
               std::string done);
  void append(const std::vector<Problem>& problems);

  std::size_t errors() const { return errors_; }
  bool has_errors() const { return errors_ > 0; }
  // No further error would be listed.
  bool is_full() const { return errors_ >= kMost; }
  const std::vector<Problem>& all() const { return problems_; }
  // Throws InputError when an error was collected.
  void throw_if_errors() const;

 private:
  void add(Problem problem);
  std::vector<Problem> problems_;
  std::size_t errors_ = 0;
};

}  // namespace fanbeam::core
