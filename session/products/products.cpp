#include "session/products/products.h"

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

}  // namespace fanbeam::session
