// fanbeam compare: are two images, or two folders of images, the same within a tolerance?
#pragma once

#include <string>

#include "apps/common.h"

namespace fanbeam::apps {

struct CompareOptions {
  std::string a, b;
  double rms = 0.0;  // largest allowed RMS difference: grey levels, or dB for power layers
  double largest =
      0.0;  // largest allowed single difference, same units; 0: as the RMS limit allows
  double percent_different = 100.0;
  bool exact = false;
};

// 0 when every pair is within the tolerance, 1 otherwise.
int compare(const CompareOptions& options, const CommonOptions& common);

}  // namespace fanbeam::apps
