// Reading TOML with every problem reported: each question names the key, its unit (in the key) and
// its allowed range; a wrong type or value becomes a Problem with line and column, and the fallback
// is returned so that reading goes on. Keys that nobody asked for are errors too. Used by scenes,
// sensors and material libraries alike.
//
// Limits: files up to 4 MiB, 64 levels of nesting, 10 000 tables in an array (E-LIMIT). A syntax error is one E-PARSE: the
// parser stops there.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/errors.h"
#include "core/number_range.h"

namespace fanbeam::core {

// One value as the program understood it, defaults included: {"weather.visibility_m", 150.0}.
using ConfigValue = std::variant<bool, double, std::string>;
using ResolvedConfig = std::vector<std::pair<std::string, ConfigValue>>;

// Where a key of a file stands by its path, "box[0].wall", or an element, "terrain.fields[1]"; nothing where it is
// not there. Copies share the parsed file, and keep it in memory.
using KeyPlaces = std::function<std::optional<Place>(std::string_view path)>;

class ConfigTable {
 public:
  // Parses the text. When it cannot be read or is no TOML, that is reported and an empty table
  // returned whose `present()` is false.
  static ConfigTable from_file(const std::filesystem::path& file, ProblemList& problems);
  static ConfigTable from_text(std::string_view text, const std::string& file_name,
                               ProblemList& problems);

  // The key counts as asked for, as if it were read: a table of nothing but misspelt keys is told of, with
  // the names that it could have.
  bool has(std::string_view key) const;
  // For keys that take a text or a table.
  bool is_text(std::string_view key) const;
  bool is_table(std::string_view key) const;

  double number(std::string_view key, NumberRange range, double fallback);
  std::optional<double> optional_number(std::string_view key, NumberRange range);
  // Missing is an error (E-REF "missing"); then the low end of the range, or 0, is returned.
  double required_number(std::string_view key, NumberRange range);
  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::int64_t fallback);
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::string_view fallback);
  std::optional<std::string> optional_text(std::string_view key);
  std::string required_text(std::string_view key);
  // The index of the text in `names`; anything else is E-RANGE with the list of names.
  std::size_t choice(std::string_view key, std::span<const std::string_view> names,
                     std::size_t fallback);
  std::size_t choice(std::string_view key, std::initializer_list<std::string_view> names,
                     std::size_t fallback) {
    return choice(key, std::span(names.begin(), names.size()), fallback);
  }
  // An array of numbers with a length in [fewest, most]; empty when the key is missing.
  std::vector<double> numbers(std::string_view key, NumberRange range, std::size_t fewest,
                              std::size_t most);
  std::vector<std::string> texts(std::string_view key);

  // A sub-table; when the key is missing, an empty one that answers with fallbacks (its `present()`
  // is false).
  ConfigTable table(std::string_view key);
  // An array of tables ([[runway]]); empty when the key is missing. More than `most` are E-LIMIT
  // and none is returned.
  std::vector<ConfigTable> tables(std::string_view key, std::size_t most = 10'000);
  // Names of all keys of this table in file order; for free-form maps such as material mappings.
  std::vector<std::string> keys() const;

  bool present() const { return present_; }
  // Of the key, or of the nearest table around it that is there. An empty key stands for this
  // table.
  Place place(std::string_view key) const;
  std::string path(std::string_view key) const;  // "weather.visibility_m"
  // Reports a problem that only the caller can see, at the place of `key`.
  void error(ErrorClass error_class, std::string_view key, std::string value, std::string expected);
  void warning(std::string_view name, std::string_view key, std::string value, std::string done);
  // Keys that mean something with another one alone, which is not there: E-REF for those given, not
  // as unknown keys.
  void only_with(std::span<const std::string_view> keys, const std::string& other);
  void only_with(std::initializer_list<std::string_view> keys, const std::string& other) {
    only_with(std::span(keys.begin(), keys.size()), other);
  }
  ProblemList& problems();

  // Call once everything was asked, on the root: each key never asked for is E-REF, with the
  // nearest known name that its table lacks.
  void report_unknown_keys();
  // Of the whole file.
  KeyPlaces key_places() const;
  // Every answer given so far in the whole file, defaults included, in the order asked.
  const ResolvedConfig& resolved() const;

 private:
  struct Document;
  ConfigTable() = default;
  const void* find(std::string_view key) const;
  template <class T>
  void record(std::string_view key, T value);
  std::optional<double> checked_number(std::string_view key, NumberRange range);

  std::shared_ptr<Document> document_;
  const void* table_ = nullptr;
  std::string prefix_;
  Place nearby_;  // of a missing table: where it would belong
  bool present_ = false;
};

}  // namespace fanbeam::core
