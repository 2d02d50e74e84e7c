#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "measure/cost/cost_markdown.h"
#include "measure/effect_prices.h"
#include "renderer/plan/plan.h"

namespace fanbeam::measure {
namespace {

// A cost of less than twice its uncertainty is none that was measured; a gain is noise too.
bool measurable(const EffectPrice& price) { return price.cost_ms() > 2.0 * price.cost_error_ms(); }

std::string cost_text(const EffectPrice& price) {
  return measurable(price) ? fmt::format("{:.2f} ms", price.cost_ms())
                           : std::string("no measurable time");
}

std::string two_digits(double value) {
  return value < 10.0 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

double largest_grey(const EffectPrice& price) {
  return std::max(price.bscope.largest_grey, price.cscope.largest_grey);
}

std::string effect_sentence(const EffectPrice& price, double dB_per_grey) {
  const double largest = largest_grey(price);
  const std::string change =
      largest > 0.0 ? fmt::format("changes pixels by up to {} grey levels ({} dB)",
                                  two_digits(largest), two_digits(largest * dB_per_grey))
                    : std::string("changes no pixel");
  return price.planned ? fmt::format("* **{}** is in the plan. It costs {}; leaving it out {}.\n",
                                     price.effect, cost_text(price), change)
                       : fmt::format("* **{}** is left out. Forced on it would cost {} and {}.\n",
                                     price.effect, cost_text(price), change);
}

// As changes of power, in dB; an influence below the share counts as the share.
double bound_over_influence_dB(const EffectPrice& price, double share_grey, double dB_per_grey) {
  const auto change = [](double dB) { return std::pow(10.0, dB / 10.0) - 1.0; };
  return 10.0 * std::log10(change(price.bound_dB) /
                           change(std::max(largest_grey(price), share_grey) * dB_per_grey));
}

// Effects that run although they change less than the share that the plan could leave out.
std::string needless_text(const std::vector<EffectPrice>& prices, double share_grey,
                          double dB_per_grey) {
  std::string needless;
  for (const EffectPrice& price : prices)
    if (price.planned && price.possible && largest_grey(price) < share_grey)
      needless +=
          fmt::format("* **{}** runs and changes less; bound over influence {:.1f} dB.\n",
                      price.effect, bound_over_influence_dB(price, share_grey, dB_per_grey));
  if (needless.empty())
    return fmt::format(
        "Every effect of the plan changes more than the {:g} grey levels that it could leave "
        "out.\n\n",
        share_grey);
  return fmt::format("Of the {:g} grey levels that the plan could leave out:\n\n", share_grey) +
         needless + '\n';
}

std::string effect_row(const EffectPrice& price, double dB_per_grey) {
  const auto pair = [](const Change& change, double scale) {
    return fmt::format("{:.3g} / {:.2g}", change.largest_grey * scale, change.rms_grey * scale);
  };
  return fmt::format("| {} | {} | {:+.2f} ± {:.2f} | {} | {} | {} | {:.3g} |\n", price.effect,
                     price.planned ? "on" : "off", price.cost_ms(), price.cost_error_ms(),
                     pair(price.bscope, dB_per_grey), pair(price.bscope, 1.0),
                     pair(price.cscope, 1.0), price.bound_grey);
}

std::string median_text(const core::MedianTime& time) {
  return fmt::format("{:.2f} ± {:.2f}", time.ms, time.error_ms);
}

std::string variant_table(const CostFigures& figures, const std::string& comparison,
                          const std::string& heading) {
  std::string rows;
  for (const Variant& variant : figures.numerics.variants)
    if (variant.comparison == comparison)
      rows += fmt::format("| {} | {} | {} | {:.2f} / {:.2f} | {:.2f} / {:.2f} |\n", variant.frame,
                          variant.name, median_text(variant.time),
                          variant.error.bscope.with_noise.rms, variant.error.bscope.noise_free.rms,
                          variant.error.cscope.with_noise.rms, variant.error.cscope.noise_free.rms);
  if (rows.empty()) return "";
  return "| frame | " + heading +
         " | ms | B-scope | C-scope |\n| ---: | --- | ---: | ---: | ---: |\n" + rows + '\n';
}

std::string range_part(const CostFigures& figures) {
  std::string text =
      "### Float against double range\n\n"
      "The range of a hit is the ray-casting library's float. Beside it the range worked out in "
      "double from the\ntriangle that was hit, and what the rays of a frame cost with and without "
      "that.\n\n"
      "| frame | hits | median error | RMS | largest | hits in another range cell | rays, ms | "
      "rays "
      "and double, ms |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const RangeFigures& range : figures.numerics.ranges)
    text += fmt::format("| {} | {} | {:.2f} mm | {:.2f} mm | {:.1f} mm | {} | {} | {} |\n",
                        range.frame, range.hits, 1000.0 * range.median_m, 1000.0 * range.rms_m,
                        1000.0 * range.largest_m, range.other_cell, median_text(range.cast),
                        median_text(range.cast_and_double));
  return text + '\n';
}

std::string robust_part(const CostFigures& figures) {
  std::string text =
      "### The robust flag\n\n"
      "With it the ray-casting library does not lose rays between two triangles.\n\n";
  for (const RobustFigures& robust : figures.numerics.robust)
    text += fmt::format(
        "Without it, {} of {} rays of frame {} hit nothing, and {} hit something else.\n",
        robust.lost, robust.rays, robust.frame, robust.moved);
  return text + '\n' + variant_table(figures, "robust_flag", "robust flag");
}

}  // namespace

std::string effects_section(const CostFigures& figures) {
  if (figures.effects.empty()) return "";
  std::string sentences, rows, impossible;
  const std::vector<EffectPrice> prices = over_frames(figures.effects);
  for (const EffectPrice& price : prices) {
    if (!price.possible) {
      impossible += fmt::format("* {}: {}\n", price.effect, price.reason);
      continue;
    }
    sentences += effect_sentence(price, figures.dB_per_grey);
    rows += effect_row(price, figures.dB_per_grey);
  }
  std::string text =
      "## What each effect costs and brings\n\n"
      "![Change of the picture over cost of each effect](effects.svg)\n\n" +
      fmt::format(
          "Far up matters, far left is cheap. Planned for an accuracy of {:g} grey levels, "
          "frames cast by {}.\n\n",
          figures.accuracy_grey, figures.caster) +
      sentences + '\n' +
      needless_text(prices, renderer::effects_share_grey(figures.accuracy_grey),
                    figures.dB_per_grey);
  if (!rows.empty())
    text +=
        "Largest / RMS change over the picture:\n\n"
        "| effect | plan | cost, ms | B-scope, dB | B-scope, grey | C-scope, grey | bound, grey |\n"
        "| --- | --- | ---: | ---: | ---: | ---: | ---: |\n" +
        rows + '\n';
  if (!impossible.empty()) text += "Cannot occur in this scene:\n\n" + impossible + '\n';
  return text;
}

std::string numerics_section(const CostFigures& figures) {
  if (figures.numerics.variants.empty()) return "";
  std::string text = "## Arithmetic and beam\n\n" + range_part(figures) + robust_part(figures);
  text +=
      "### Sub-columns of the beam\n\n"
      "The azimuth beam is summed over sub-columns of each picture column. More of them at an "
      "equal "
      "number of\nrays or slices: each has fewer of its own.\n\n";
  return text + variant_table(figures, "sub_columns_rays", "sub-columns, rays") +
         variant_table(figures, "sub_columns_slices", "sub-columns, slices");
}

}  // namespace fanbeam::measure
