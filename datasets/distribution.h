// How a parameter varies over the runs of a campaign: a pure function from a number in (0, 1) to a value.
//
//   rain_rate_mm_per_h = 4                                        the same in every run
//   { values = [0, 2, 10], weights = [2, 1, 1] }                  one of these; weights equal unless given;
//                                                                 none in a grid
//   { uniform = [100, 2000] }                                     even between two bounds
//   { log_uniform = [100, 2000] }                                 even in the logarithm; bounds above 0
//   { normal = [0, 15], within = [-40, 40] }                      mean and standard deviation, cut off:
//                                                                 the share beyond is drawn again (by the
//                                                                 inverse of the truncated distribution)
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/config_table.h"
#include "core/number_range.h"

namespace fanbeam::datasets {

using Value = std::variant<double, std::string>;

class Distribution {
 public:
  struct Choice {
    std::vector<Value> values;
    std::vector<double> weights;  // sum 1
  };
  struct Uniform {
    double low = 0.0, high = 0.0;
    bool logarithmic = false;
  };
  struct Normal {
    double mean = 0.0, deviation = 0.0, low = 0.0, high = 0.0;
  };

  Distribution() = default;
  explicit Distribution(Value constant) : form_(Choice{{std::move(constant)}, {1.0}}) {}
  explicit Distribution(std::variant<Choice, Uniform, Normal> form) : form_(std::move(form)) {}

  // u in (0, 1), rising: a larger one gives a value that is not smaller, of a choice a later one.
  Value at(double u) const;
  // Of a choice; 0 for what is drawn from an interval.
  std::size_t count() const;
  const Value& value(std::size_t i) const;  // of a choice
  bool is_constant() const { return count() == 1; }

 private:
  std::variant<Choice, Uniform, Normal> form_ = Choice{{Value{0.0}}, {1.0}};
};

// What a number may be, or which words.
using Allowed = std::variant<core::NumberRange, std::vector<std::string>>;

// Reads `key`, which is there. Every problem is reported: E-RANGE for values outside `allowed`, E-REF for
// words that are not, for weights that do not match, for none or more than one form.
Distribution read_distribution(core::ConfigTable& table, std::string_view key,
                               const Allowed& allowed);

}  // namespace fanbeam::datasets
