#include "datasets/distribution.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "core/spelling.h"

namespace fanbeam::datasets {
namespace {

using core::ConfigTable;
using core::ErrorClass;

double truncated_normal(const Distribution::Normal& form, double u) {
  const boost::math::normal_distribution<double> normal(form.mean, form.deviation);
  if (form.low > form.mean) {
    // From above: below the bounds is so nearly all that nothing is left of the digits.
    const double at_low = cdf(complement(normal, form.low)),
                 at_high = cdf(complement(normal, form.high));
    const double beyond = at_low + u * (at_high - at_low);
    if (!(beyond > 0.0)) return form.high;
    return std::clamp(quantile(complement(normal, beyond)), form.low, form.high);
  }
  const double below = cdf(normal, form.low), above = cdf(normal, form.high);
  const double p = below + u * (above - below);
  if (!(p > 0.0)) return form.low;
  if (!(p < 1.0)) return form.high;
  return std::clamp(quantile(normal, p), form.low, form.high);
}

void check_word(ConfigTable& table, std::string_view key, const std::string& word,
                const std::vector<std::string>& words) {
  if (words.empty() || std::find(words.begin(), words.end(), word) != words.end()) return;
  table.error(ErrorClass::ref, key, "\"" + word + "\"",
              "a known one" + core::names_there_text(word, words));
}

void check_weights(ConfigTable& table, Distribution::Choice& choice) {
  choice.weights = table.numbers("weights", {0.0, 1e9}, 0, 10'000);
  if (choice.weights.empty()) choice.weights.assign(choice.values.size(), 1.0);
  double sum = 0.0;
  for (const double weight : choice.weights) sum += weight;
  if (choice.weights.size() != choice.values.size() || !(sum > 0.0)) {
    table.error(ErrorClass::range, "weights", std::to_string(choice.weights.size()) + " numbers",
                std::to_string(choice.values.size()) + " numbers, one for each value, not all 0");
    choice.weights.assign(choice.values.size(), 1.0);
    sum = static_cast<double>(choice.values.size());
  }
  for (double& weight : choice.weights) weight /= sum;
}

Distribution read_choice(ConfigTable& table, const Allowed& allowed) {
  Distribution::Choice choice;
  if (const auto* words = std::get_if<std::vector<std::string>>(&allowed)) {
    for (std::string& word : table.texts("values")) {
      check_word(table, "values", word, *words);
      choice.values.emplace_back(std::move(word));
    }
  } else {
    for (const double number :
         table.numbers("values", std::get<core::NumberRange>(allowed), 1, 10'000))
      choice.values.emplace_back(number);
  }
  if (choice.values.empty()) {
    // Of numbers it is told already.
    if (std::holds_alternative<std::vector<std::string>>(allowed))
      table.error(ErrorClass::range, "values", "none", "at least one");
    return {};
  }
  check_weights(table, choice);
  return Distribution(choice);
}

// The two numbers of an interval's form; nothing where they are wrong.
std::optional<std::array<double, 2>> pair_of(ConfigTable& table, std::string_view key,
                                             core::NumberRange range, bool rising) {
  const std::vector<double> numbers = table.numbers(key, range, 2, 2);
  if (numbers.size() != 2) return std::nullopt;
  if (rising && !(numbers[0] < numbers[1])) {
    table.error(ErrorClass::range, key,
                core::number_text(numbers[0]) + ", " + core::number_text(numbers[1]),
                "a lower and a higher bound");
    return std::nullopt;
  }
  return std::array<double, 2>{numbers[0], numbers[1]};
}

Distribution read_normal(ConfigTable& table, const core::NumberRange& allowed) {
  Distribution::Normal form;
  if (const auto told = pair_of(table, "normal", {}, false)) {
    form.mean = (*told)[0];
    form.deviation = (*told)[1];
    if (!(form.deviation > 0.0))
      table.error(ErrorClass::range, "normal", core::number_text(form.deviation),
                  "mean and a standard deviation above 0");
  }
  const auto within = pair_of(table, "within", allowed, true);
  if (!table.has("within"))
    table.error(ErrorClass::ref, "within", "missing",
                "the lowest and the highest value, " + core::to_string(allowed));
  form.low = within ? (*within)[0] : -1.0;
  form.high = within ? (*within)[1] : 1.0;
  if (!(form.deviation > 0.0)) form.deviation = 1.0;
  const double far = 8.0 * form.deviation;
  if (within && (form.high < form.mean - far || form.low > form.mean + far))
    table.error(ErrorClass::range, "within",
                core::number_text(form.low) + ", " + core::number_text(form.high),
                "bounds within 8 standard deviations of the mean");
  return Distribution(form);
}

Distribution read_form(ConfigTable table, const Allowed& allowed) {
  std::vector<std::string> forms;
  for (const char* form : {"values", "uniform", "log_uniform", "normal"})
    if (table.has(form)) forms.emplace_back(form);
  const auto* range = std::get_if<core::NumberRange>(&allowed);
  if (forms.size() != 1 || (range == nullptr && forms[0] != "values")) {
    table.error(ErrorClass::ref, "", std::to_string(forms.size()) + " forms",
                range == nullptr ? "values" : "one of values, uniform, log_uniform, normal");
    for (const char* beside : {"within", "weights"}) static_cast<void>(table.has(beside));
    return {};
  }
  if (forms[0] == "values") return read_choice(table, allowed);
  if (forms[0] == "normal") return read_normal(table, *range);
  const bool logarithmic = forms[0] == "log_uniform";
  core::NumberRange bounds = *range;
  if (logarithmic && bounds.low <= 0.0) {
    bounds.low = 0.0;
    bounds.above_low = true;
  }
  const auto told = pair_of(table, forms[0], bounds, true);
  if (!told) return {};
  return Distribution(Distribution::Uniform{(*told)[0], (*told)[1], logarithmic});
}

}  // namespace

Value Distribution::at(double u) const {
  if (const auto* uniform = std::get_if<Uniform>(&form_)) {
    if (!uniform->logarithmic) return uniform->low + u * (uniform->high - uniform->low);
    const double ratio = std::log(uniform->high / uniform->low);
    return std::clamp(uniform->low * std::exp(u * ratio), uniform->low, uniform->high);
  }
  if (const auto* normal = std::get_if<Normal>(&form_)) return truncated_normal(*normal, u);
  const auto& choice = std::get<Choice>(form_);
  double sum = 0.0;
  for (std::size_t i = 0; i < choice.values.size(); ++i) {
    sum += choice.weights[i];
    if (u < sum && choice.weights[i] > 0.0) return choice.values[i];
  }
  for (std::size_t i = choice.values.size(); i-- > 0;)  // rounding at the end
    if (choice.weights[i] > 0.0) return choice.values[i];
  return choice.values.back();
}

std::size_t Distribution::count() const {
  const auto* choice = std::get_if<Choice>(&form_);
  return choice == nullptr ? 0 : choice->values.size();
}

const Value& Distribution::value(std::size_t i) const { return std::get<Choice>(form_).values[i]; }

Distribution read_distribution(ConfigTable& table, std::string_view key, const Allowed& allowed) {
  const auto* range = std::get_if<core::NumberRange>(&allowed);
  if (table.is_table(key)) return read_form(table.table(key), allowed);
  if (range != nullptr) return Distribution(Value{table.required_number(key, *range)});
  const std::string word = table.required_text(key);
  check_word(table, key, word, std::get<std::vector<std::string>>(allowed));
  return Distribution(Value{word});
}

}  // namespace fanbeam::datasets
