#include "session/products/products.h"

#include <string>

namespace fanbeam::session {

renderer::Products wanted_of(const ProductSet& products) {
  const bool both =
      products.contains("pair") || products.contains("figure") || products.contains("preview");
  const bool plan_view =
      products.contains("ppi") || products.contains("ppi_north") || products.contains("ppi_figure");
  const bool labels = products.contains("labels");
  const bool cscope_truth =
      products.contains("cscope_layers") || products.contains("cscope_masks") || labels;
  return {both || plan_view || labels || products.contains("bscope"),
          both || products.contains("cscope"),
          products.contains("detections"),
          products.contains("obstacles"),
          products.contains("layers") || products.contains("masks") || cscope_truth,
          cscope_truth};
}

bool show_heights(const renderer::Products& wanted) {
  return wanted.cscope || wanted.obstacles || wanted.cscope_layers;
}

void plan_for(const ProductSet& products, scenes::BuildOptions& build) {
  build.heights_shown = show_heights(wanted_of(products));
  build.read = {products.contains("power"), products.contains("labels"),
                products.contains("detections"), products.contains("obstacles")};
}

void check_told(const scenes::BuildOptions& needed, const scenes::BuildOptions& told,
                core::ProblemList& problems) {
  const auto check = [&](bool needs, bool knows, const char* what, const std::string& option) {
    if (needs && !knows)
      problems.error(core::ErrorClass::ref, {}, "products", what,
                     "none of it, as the session was opened without BuildOptions::" + option);
  };
  const renderer::Readings &needs = needed.read, &knows = told.read;
  check(needed.heights_shown, told.heights_shown, "C-scope, its layers or obstacles",
        "heights_shown");
  check(needs.power, knows.power, "power", "read.power");
  check(needs.labels, knows.labels, "labels", "read.labels");
  check(needs.detections, knows.detections, "detections", "read.detections");
  check(needs.obstacles, knows.obstacles, "obstacles", "read.obstacles");
}

}  // namespace fanbeam::session
