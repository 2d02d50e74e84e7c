#include "session/products/products.h"

namespace fanbeam::session {

renderer::Products wanted_of(const ProductSet& products) {
  const bool both =
      products.contains("pair") || products.contains("figure") || products.contains("preview");
  const bool plan_view =
      products.contains("ppi") || products.contains("ppi_north") || products.contains("ppi_figure");
  return {both || plan_view || products.contains("bscope"),
          both || products.contains("cscope"),
          products.contains("detections"),
          products.contains("obstacles"),
          products.contains("layers"),
          products.contains("cscope_layers")};
}

}  // namespace fanbeam::session
