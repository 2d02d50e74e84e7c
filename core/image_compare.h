// How far two images are apart: the figures that image regression is judged by.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace fanbeam::core {

struct LayerDifference {
  std::string layer;
  std::size_t cells = 0;
  std::size_t different = 0;   // values that are not equal; a NaN equals nothing, also no NaN
  std::size_t not_finite = 0;  // of them, those whose B - A is NaN or infinite
  std::size_t changed = 0;     // by more than 1e-4 of the larger one, or of 1 where that is more
  double mean = 0.0;           // of B - A, in the layer's own unit (grey levels for 8-bit pictures)
  double rms = 0.0;
  double largest = 0.0;  // of |B - A|; infinite where that is no finite number
  int largest_column = 0, largest_row = 0;
  // Power layers (positive floats): over cells positive in both, in dB.
  std::size_t both_positive = 0;
  std::size_t only_one_positive = 0;
  double mean_dB = 0.0, rms_dB = 0.0, largest_dB = 0.0;
  int largest_dB_column = 0, largest_dB_row = 0;
};

// Throws InputError E-REF when they differ.
void check_same_size(const ImageSize& a, const ImageSize& b, const std::string& name_a,
                     const std::string& name_b);

// Layer by layer, paired by name. Throws InputError E-REF when sizes or layer names differ.
std::vector<LayerDifference> compare_images(const Image& a, const Image& b,
                                            const std::string& name_a, const std::string& name_b);

}  // namespace fanbeam::core
