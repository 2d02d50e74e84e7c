// Where two images differ, and by how much: B - A cell by cell in colours, with a scale and the
// worst cell.
//
// Colours go from blue (B lower) through near white (equal) to orange and brown (B higher): a pair
// that the usual colour blindnesses keep apart. The depth of a colour is the square root of
// |difference| over the scale's end, so that one grey level shows beside a hundred; near white means
// equal and nothing else. The scale ends at the largest |difference|, rounded up to 1, 2 or 5 times
// a power of ten, at 1 grey level or 0.1 dB at least.
//
// In decibels, 10 log10(B / A): a cell that is lit in one image only takes the scale's end; cells
// that differ and have no decibels (both at or below 0, not a number) are black.
#pragma once

#include <filesystem>
#include <string>

#include "core/colour_picture.h"
#include "core/image.h"

namespace fanbeam::session {

enum class DifferenceUnit { grey, dB, own };

// Grey levels for PNG. In EXR decibels, but for layers of ground truth, whose names end in the unit
// that they are compared in: _deg, _m, _dB, _id, _share.
DifferenceUnit difference_unit(const std::filesystem::path& image, const std::string& layer);
// "grey", "dB", or the end of the layer's name.
std::string unit_text(DifferenceUnit unit, const std::string& layer);

// `depth` from -1 to 1, clamped: blue, near white, orange.
core::Colour diverging_colour(double depth);

// The end of a layer's scale and of its colours.
double difference_limit(double largest, DifferenceUnit unit);
// Of one cell; `limit` as above.
core::Colour difference_colour(double a, double b, DifferenceUnit unit, double limit);

struct DifferenceLabels {
  std::string title;
  std::string a = "A", b = "B";  // short names of the images: "approved", "new"
};

// One panel per layer, side by side, the cells untouched by marks. `file` tells the layers' units. Images that are equal give a near
// white map that says "identical". Throws InputError: E-REF as core::compare_images, E-LIMIT
// beyond 16384 columns or rows.
core::ColourPicture difference_map(const core::Image& a, const core::Image& b,
                                   const std::filesystem::path& file,
                                   const DifferenceLabels& labels);

}  // namespace fanbeam::session
