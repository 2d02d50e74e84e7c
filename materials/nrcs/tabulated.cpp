#include "materials/nrcs/tabulated.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/constants.h"
#include "core/errors.h"

namespace fanbeam::materials {
namespace {

constexpr double kLargestSigma0 = 1e6;

void check(const std::vector<NrcsSample>& rows, core::ProblemList& problems) {
  using core::ErrorClass;
  if (rows.empty())
    problems.error(ErrorClass::parse, {}, "table", "no rows", "at least one grazing angle");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto report = [&](const char* quantity, double value, const std::string& expected) {
      problems.error(std::isfinite(value) ? ErrorClass::range : ErrorClass::nonfinite, {},
                     "table row " + std::to_string(i + 1) + " " + quantity,
                     core::number_text(value), expected);
    };
    const NrcsSample& row = rows[i];
    if (!(row.grazing_rad > 0.0 && row.grazing_rad <= core::kPi / 2.0))
      report("grazing_rad", row.grazing_rad, "above 0, at most pi/2");
    else if (i > 0 && !(row.grazing_rad > rows[i - 1].grazing_rad))
      report("grazing_rad", row.grazing_rad, "more than the row before");
    if (!(row.sigma0 >= 0.0 && row.sigma0 <= kLargestSigma0))
      report("sigma0", row.sigma0, "0 to 1e6");
  }
}

}  // namespace

TabulatedNrcs::TabulatedNrcs(std::vector<NrcsSample> rows) : rows_(std::move(rows)) {
  core::ProblemList problems;
  check(rows_, problems);
  problems.throw_if_errors();
}

double TabulatedNrcs::sigma0(double grazing_rad) const {
  if (!(grazing_rad > 0.0)) return 0.0;
  const auto above =
      std::upper_bound(rows_.begin(), rows_.end(), grazing_rad,
                       [](double angle, const NrcsSample& row) { return angle < row.grazing_rad; });
  if (above == rows_.begin()) return rows_.front().sigma0;
  if (above == rows_.end()) return rows_.back().sigma0;
  const NrcsSample& low = *(above - 1);
  const NrcsSample& high = *above;
  if (low.sigma0 == 0.0 || high.sigma0 == 0.0) {
    const double share = (grazing_rad - low.grazing_rad) / (high.grazing_rad - low.grazing_rad);
    return low.sigma0 + share * (high.sigma0 - low.sigma0);
  }
  const double share =
      std::log(grazing_rad / low.grazing_rad) / std::log(high.grazing_rad / low.grazing_rad);
  return low.sigma0 * std::pow(high.sigma0 / low.sigma0, share);
}

}  // namespace fanbeam::materials
