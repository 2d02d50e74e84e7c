// From a rendered frame to all that is written of it.
#pragma once

#include <string>

#include "renderer/casting/sampling.h"
#include "session/labels/frame_labels.h"
#include "session/products/frame_writer.h"
#include "session/products/products.h"
#include "session/records/run_record.h"

namespace fanbeam::session {

struct OutputSettings {
  const ProductSet& products;
  std::string fingerprint;  // of the input: stands in every file
  renderer::Sampling sampling{};
  std::string range_unit{};            // of figures
  const Labeller* labeller = nullptr;  // where labels or masks are among the products
};

// Products that need a Labeller.
bool want_labels(const ProductSet& products);

// `record` has index, time, pose and effects left out; what the frame says of itself is added. `scene` is
// the one that it was rendered of, with what the products need (wanted_of).
FrameOutput frame_output(const scenes::Scene& scene, const OutputSettings& settings,
                         renderer::Frame frame, FrameRecord& record);

}  // namespace fanbeam::session
