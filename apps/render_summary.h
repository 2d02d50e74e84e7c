// What fanbeam render tells when it is done.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/run_record.h"

namespace fanbeam::apps {

struct ProductPlace {
  std::string name;
  std::filesystem::path path;
};

// How many frames, cast how and why, what accuracy or time was reached, which effects ran and why,
// and `places`: where products and record lie.
void print_render_summary(const RunRecord& record, const scenes::Scene& scene, double accuracy_grey,
                          const std::vector<ProductPlace>& places);

}  // namespace fanbeam::apps
