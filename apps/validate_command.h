// fanbeam validate: every problem of a scene at once.
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

int validate(const std::string& scene, const std::string& data, const std::string& sensor,
             const CommonOptions& common);

}  // namespace fanbeam::apps
