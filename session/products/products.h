// What frames of a sequence can leave on disk.
#pragma once

#include <array>
#include <set>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "renderer/frame.h"
#include "scenes/scene.h"

namespace fanbeam::session {

struct Product {
  std::string_view name, what;
  std::string_view files;  // below the output folder, of frame 0
};
inline constexpr std::array<Product, 16> kProducts = {
    {{"bscope", "range over azimuth, PNG", "bscope/00000.png"},
     {"cscope", "elevation over azimuth, PNG", "cscope/00000.png"},
     {"pair", "both side by side", "pair/00000.png"},
     {"figure", "both with scales and legend", "figure/00000.png"},
     {"ppi", "plan view, track up", "ppi/00000.png"},
     {"ppi_north", "plan view, north up", "ppi_north/00000.png"},
     {"ppi_figure", "ppi with scales and legend", "ppi_figure/00000.png"},
     {"power", "EXR, watts, noise included", "power/00000.exr"},
     {"layers", "EXR, ground truth by B-scope cell", "layers/00000.exr"},
     {"cscope_layers", "EXR, the same by C-scope cell", "cscope_layers/00000.exr"},
     {"labels", "JSON, what is where; and all frames' as labels.json, coco.json, lard.csv",
      "labels/00000.json"},
     {"masks", "PNG, what B-scope cells show", "masks/00000.png"},
     {"cscope_masks", "PNG, the same of C-scope cells", "cscope_masks/00000.png"},
     {"detections", "mask and CSV", "detections/00000.png and .csv"},
     {"obstacles", "CSV, heights from shadows", "obstacles/00000.csv"},
     {"preview", "video", "preview.mp4, .gif or .apng"}}};

using ProductSet = std::set<std::string>;  // names

// What a frame has to hold for them.
renderer::Products wanted_of(const ProductSet& products);
// Whether a plan must count on heights (BuildOptions::heights_shown).
bool show_heights(const renderer::Products& wanted);
// Adds to `build` what a plan must know of them.
void plan_for(const ProductSet& products, scenes::BuildOptions& build);
// E-REF for what a plan must know by `needed` and was not told by `told`: it may have left out what
// decides about it.
void check_told(const scenes::BuildOptions& needed, const scenes::BuildOptions& told,
                core::ProblemList& problems);

}  // namespace fanbeam::session
