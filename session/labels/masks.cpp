#include "session/labels/masks.h"

#include <algorithm>
#include <cmath>

namespace fanbeam::session {

std::vector<MaskLabel> masks_of(const renderer::LayerSet& layers, int columns,
                                std::span<const std::uint32_t> label_of, std::size_t labels,
                                bool turned) {
  std::vector<MaskLabel> masks(labels);
  const int rows = static_cast<int>(layers.object.size()) / columns;
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) {
      const int from = turned ? rows - 1 - row : row;
      const auto cell = static_cast<std::size_t>(from) * static_cast<std::size_t>(columns) +
                        static_cast<std::size_t>(column);
      const terrain::ObjectId object = layers.object[cell];
      const std::uint32_t label = object < label_of.size() ? label_of[object] : kUnlabelled;
      if (label == kUnlabelled) continue;
      MaskLabel& mask = masks[label];
      if (mask.cells.empty()) {
        mask.left = column;
        mask.top = row;
      }
      mask.cells.push_back(static_cast<std::uint32_t>(column * rows + row));
      mask.columns = column + 1 - mask.left;
      const int bottom = std::max(mask.top + mask.rows, row + 1);
      mask.top = std::min(mask.top, row);
      mask.rows = bottom - mask.top;
    }
  return masks;
}

std::optional<double> signal_to_clutter_dB(const MaskLabel& mask, std::span<const double> power_W,
                                           int columns, int reach, double noise_W) {
  constexpr int kBeside = 1;  // rows that a point's echo reaches
  const int rows = static_cast<int>(power_W.size()) / columns;
  const auto power = [&](int column, int row) {  // of a picture
    return power_W[static_cast<std::size_t>(rows - 1 - row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  };
  double strongest_W = 0.0;
  std::uint32_t at = mask.cells.front();
  for (const std::uint32_t cell : mask.cells) {
    const double here_W = power(static_cast<int>(cell) / rows, static_cast<int>(cell) % rows);
    if (here_W <= strongest_W) continue;
    strongest_W = here_W;
    at = cell;
  }
  if (!(strongest_W > 0.0)) return std::nullopt;
  const int middle_column = static_cast<int>(at) / rows, middle_row = static_cast<int>(at) % rows;
  const auto reached = [&](int column, int row) {
    for (int c = std::max(0, column - reach); c <= std::min(columns - 1, column + reach); ++c)
      for (int r = std::max(0, row - kBeside); r <= std::min(rows - 1, row + kBeside); ++r)
        if (std::binary_search(mask.cells.begin(), mask.cells.end(),
                               static_cast<std::uint32_t>(c * rows + r)))
          return true;
    return false;
  };
  double clutter_W = 0.0;
  int around = 0;
  for (int column = std::max(0, middle_column - kRing - reach);
       column <= std::min(columns - 1, middle_column + kRing + reach); ++column)
    for (int row = std::max(0, middle_row - kRing); row <= std::min(rows - 1, middle_row + kRing);
         ++row) {
      if (reached(column, row)) continue;
      clutter_W += power(column, row);
      ++around;
    }
  if (around == 0) return std::nullopt;
  const double floor_W = clutter_W / around + noise_W;
  if (!(floor_W > 0.0)) return std::nullopt;
  return 10.0 * std::log10(strongest_W / floor_W);
}

}  // namespace fanbeam::session
