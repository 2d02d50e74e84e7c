#include "core/image_compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/spelling.h"

namespace fanbeam::core {
namespace {

// A difference that is no finite number is larger than any.
double magnitude_of(double difference) {
  return std::isfinite(difference) ? std::abs(difference) : std::numeric_limits<double>::infinity();
}

LayerDifference compare_layer(const Image::Layer& a, const Image::Layer& b, int columns) {
  LayerDifference result;
  result.layer = a.name;
  result.cells = a.values.size();
  double sum = 0.0, squares = 0.0, sum_dB = 0.0, squares_dB = 0.0;
  for (std::size_t i = 0; i < result.cells; ++i) {
    const bool equal = a.values[i] == b.values[i];  // infinities too, and a NaN to nothing
    const double difference = equal ? 0.0 : b.values[i] - a.values[i];
    if (!equal) ++result.different;
    if (!(std::abs(difference) <=
          1e-4 * std::max({1.0, std::abs(a.values[i]), std::abs(b.values[i])})))
      ++result.changed;
    sum += difference;
    squares += difference * difference;
    const double magnitude = magnitude_of(difference);
    if (!std::isfinite(magnitude)) ++result.not_finite;
    if (magnitude > result.largest) {
      result.largest = magnitude;
      result.largest_column = static_cast<int>(i) % columns;
      result.largest_row = static_cast<int>(i) / columns;
    }
    const bool positive_a = a.values[i] > 0.0;
    const bool positive_b = b.values[i] > 0.0;
    if (positive_a != positive_b) ++result.only_one_positive;
    if (!positive_a || !positive_b) continue;
    ++result.both_positive;
    const double dB = equal ? 0.0 : 10.0 * std::log10(b.values[i] / a.values[i]);
    sum_dB += dB;
    squares_dB += dB * dB;
    if (magnitude_of(dB) > result.largest_dB) {
      result.largest_dB = magnitude_of(dB);
      result.largest_dB_column = static_cast<int>(i) % columns;
      result.largest_dB_row = static_cast<int>(i) / columns;
    }
  }
  const auto cells = static_cast<double>(std::max<std::size_t>(result.cells, 1));
  const auto positive = static_cast<double>(std::max<std::size_t>(result.both_positive, 1));
  result.mean = sum / cells;
  result.rms = std::sqrt(squares / cells);
  result.mean_dB = sum_dB / positive;
  result.rms_dB = std::sqrt(squares_dB / positive);
  return result;
}

}  // namespace

void check_same_size(const ImageSize& a, const ImageSize& b, const std::string& name_a,
                     const std::string& name_b) {
  const auto size_text = [](const ImageSize& size) {
    return std::to_string(size.columns) + " x " + std::to_string(size.rows) + ", " +
           std::to_string(size.layers) + " layers";
  };
  if (a != b)
    throw_input_error(ErrorClass::ref, Place{name_b}, "size", size_text(b),
                      size_text(a) + " as in " + name_a);
}

std::vector<LayerDifference> compare_images(const Image& a, const Image& b,
                                            const std::string& name_a, const std::string& name_b) {
  const auto size_of = [](const Image& image) {
    return ImageSize{image.columns, image.rows, static_cast<int>(image.layers.size())};
  };
  check_same_size(size_of(a), size_of(b), name_a, name_b);
  std::vector<LayerDifference> differences;
  for (const Image::Layer& layer : a.layers) {
    const auto other =
        std::find_if(b.layers.begin(), b.layers.end(),
                     [&](const Image::Layer& candidate) { return candidate.name == layer.name; });
    if (other == b.layers.end()) {
      std::vector<std::string> there;
      for (const Image::Layer& candidate : b.layers) there.push_back(candidate.name);
      throw_input_error(
          ErrorClass::ref, Place{name_b}, "layer", "missing",
          "\"" + layer.name + "\" as in " + name_a + names_there_text(layer.name, there));
    }
    differences.push_back(compare_layer(layer, *other, a.columns));
  }
  return differences;
}

}  // namespace fanbeam::core
