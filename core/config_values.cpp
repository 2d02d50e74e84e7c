// What a ConfigTable answers when asked for a value: of the right type and in its range, or the
// fallback after a problem.
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "core/config_document_private.h"
#include "core/text.h"

namespace fanbeam::core {
namespace {

// Texts become names on terminals, in pages and in records.
constexpr const char* kPrintable = "a text without control characters";

}  // namespace

std::string value_text(const toml::node& node) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  node.visit([&](const auto& value) {
    if constexpr (toml::is_table<decltype(value)>) {
      stream << "a table";
    } else if constexpr (toml::is_array<decltype(value)>) {
      stream << "an array of " << value.size();
    } else if constexpr (toml::is_string<decltype(value)>) {
      stream << '"' << value.get().substr(0, 200) << '"';
    } else if constexpr (toml::is_floating_point<decltype(value)>) {
      stream << number_text(value.get());
    } else {
      stream << std::boolalpha << value.get();
    }
  });
  return stream.str();
}

template <class T>
void ConfigTable::record(std::string_view key, T value) {
  document_->resolved.emplace_back(path(key), ConfigValue(std::move(value)));
}

std::optional<double> ConfigTable::checked_number(std::string_view key, NumberRange range) {
  const auto* node = static_cast<const toml::node*>(find(key));
  if (node == nullptr) return std::nullopt;
  if (!node->is_number()) {
    error(ErrorClass::parse, key, value_text(*node), "a number, " + to_string(range));
    return std::nullopt;
  }
  const double value = node->is_integer() ? static_cast<double>(node->as_integer()->get())
                                          : node->as_floating_point()->get();
  if (!std::isfinite(value)) {
    error(ErrorClass::nonfinite, key, number_text(value), to_string(range));
    return std::nullopt;
  }
  if (!range.holds(value)) {
    error(ErrorClass::range, key, number_text(value), to_string(range));
    return std::nullopt;
  }
  return value;
}

double ConfigTable::number(std::string_view key, NumberRange range, double fallback) {
  const double value = checked_number(key, range).value_or(fallback);
  record(key, value);
  return value;
}

std::optional<double> ConfigTable::optional_number(std::string_view key, NumberRange range) {
  const std::optional<double> value = checked_number(key, range);
  if (value) record(key, *value);
  return value;
}

double ConfigTable::required_number(std::string_view key, NumberRange range) {
  if (!has(key)) error(ErrorClass::ref, key, "missing", to_string(range));
  const double low = range.low > -std::numeric_limits<double>::max() ? range.low : 0.0;
  return number(key, range, low);
}

std::int64_t ConfigTable::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                  std::int64_t fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  const std::string expected =
      "a whole number, " + std::to_string(low) + " to " + std::to_string(high);
  std::int64_t value = fallback;
  if (node != nullptr && !node->is_integer()) {
    error(ErrorClass::parse, key, value_text(*node), expected);
  } else if (node != nullptr &&
             (node->as_integer()->get() < low || node->as_integer()->get() > high)) {
    error(ErrorClass::range, key, value_text(*node), expected);
  } else if (node != nullptr) {
    value = node->as_integer()->get();
  }
  record(key, static_cast<double>(value));
  return value;
}

bool ConfigTable::boolean(std::string_view key, bool fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  bool value = fallback;
  if (node != nullptr && !node->is_boolean()) {
    error(ErrorClass::parse, key, value_text(*node), "true or false");
  } else if (node != nullptr) {
    value = node->as_boolean()->get();
  }
  record(key, value);
  return value;
}

std::optional<std::string> ConfigTable::optional_text(std::string_view key) {
  const auto* node = static_cast<const toml::node*>(find(key));
  if (node == nullptr) return std::nullopt;
  if (!node->is_string()) {
    error(ErrorClass::parse, key, value_text(*node), "a text in quotes");
    return std::nullopt;
  }
  const std::string& text = node->as_string()->get();
  if (!is_printable_text(text)) {
    error(ErrorClass::range, key, value_text(*node), kPrintable);
    return std::nullopt;
  }
  record(key, text);
  return text;
}

std::string ConfigTable::text(std::string_view key, std::string_view fallback) {
  const std::optional<std::string> value = optional_text(key);
  if (!value) record(key, std::string(fallback));
  return value.value_or(std::string(fallback));
}

std::string ConfigTable::required_text(std::string_view key) {
  if (!has(key)) error(ErrorClass::ref, key, "missing", "a text in quotes");
  return optional_text(key).value_or("");
}

std::size_t ConfigTable::choice(std::string_view key, std::span<const std::string_view> names,
                                std::size_t fallback) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::size_t index = fallback;
  if (node != nullptr) {
    const std::string value = node->is_string() ? node->as_string()->get() : "";
    const auto found = std::find(names.begin(), names.end(), value);
    if (found != names.end()) {
      index = static_cast<std::size_t>(found - names.begin());
    } else {
      std::string list;
      for (const std::string_view name : names)
        list += (list.empty() ? "\"" : ", \"") + std::string(name) + "\"";
      error(node->is_string() ? ErrorClass::range : ErrorClass::parse, key, value_text(*node),
            "one of " + list);
    }
  }
  record(key, std::string(names.begin()[index]));
  return index;
}

std::vector<double> ConfigTable::numbers(std::string_view key, NumberRange range,
                                         std::size_t fewest, std::size_t most) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::vector<double> values;
  if (node == nullptr) return values;
  const std::string expected =
      (fewest == most ? std::to_string(fewest)
                      : std::to_string(fewest) + " to " + std::to_string(most)) +
      " numbers, each " + to_string(range);
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() < fewest || array->size() > most) {
    error(array == nullptr ? ErrorClass::parse : ErrorClass::range, key, value_text(*node),
          expected);
    return values;
  }
  for (const toml::node& element : *array) {
    const std::optional<double> value =
        element.is_number() ? element.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value) || !range.holds(*value)) {
      const bool nonfinite = value && !std::isfinite(*value);
      document_->problems->error(!value      ? ErrorClass::parse
                                 : nonfinite ? ErrorClass::nonfinite
                                             : ErrorClass::range,
                                 place_of(element.source(), document_->file), path(key),
                                 value_text(element), expected);
      return {};
    }
    values.push_back(*value);
    record(std::string(key) + "[" + std::to_string(values.size() - 1) + "]", *value);
  }
  return values;
}

std::vector<std::string> ConfigTable::texts(std::string_view key) {
  const auto* node = static_cast<const toml::node*>(find(key));
  std::vector<std::string> values;
  if (node == nullptr) return values;
  const toml::array* array = node->as_array();
  const bool all_text = array != nullptr &&
                        std::all_of(array->begin(), array->end(),
                                    [](const toml::node& element) { return element.is_string(); });
  if (!all_text) {
    error(ErrorClass::parse, key, value_text(*node), "an array of texts");
    return values;
  }
  for (const toml::node& element : *array) {
    const std::string& text = element.as_string()->get();
    if (!is_printable_text(text)) {
      document_->problems->error(ErrorClass::range, place_of(element.source(), document_->file),
                                 path(key), value_text(element), kPrintable);
      return {};
    }
    values.push_back(text);
    record(std::string(key) + "[" + std::to_string(values.size() - 1) + "]", values.back());
  }
  return values;
}

}  // namespace fanbeam::core
