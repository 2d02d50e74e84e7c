#include "renderer/stages/layer_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/dispatch.h"
#include "core/parallel.h"
#include "core/series.h"

namespace fanbeam::renderer {
namespace {

FANBEAM_HOT(void, arcsines, (float* values, int count), (values, count)) {
  for (int i = 0; i < count; ++i)
    values[i] = static_cast<float>(core::series_arcsine(static_cast<double>(values[i])));
}

// Counting bits is a call on machines of the lowest level: most cells need none.
inline float lit_share(AzimuthMask azimuths) {
  return azimuths == ~AzimuthMask{0} ? 1.0F : static_cast<float>(std::popcount(azimuths)) / 32.0F;
}

}  // namespace

void LayerCells::write(int column, int columns, LayerSet& set) const {
  const auto put = [](std::vector<float>& layer, std::size_t at, double value) {
    if (!layer.empty()) layer[at] = static_cast<float>(value);
  };
  auto to = static_cast<std::size_t>(column);
  for (const Cell& cell : cells_) {
    if (cell.part_W >= 0.0F) {
      set.visibility[to] = lit_share(cell.azimuths);
      set.material[to] = cell.material;
      set.object[to] = cell.object;
      put(set.elevation_rad, to, static_cast<double>(cell.elevation_rad));
    }
    if (cell.azimuths != 0) {
      const double share = 1.0 / cell.weight;
      put(set.range_m, to, cell.range_m * share);
      set.grazing_rad[to] = static_cast<float>(std::min(cell.sin_grazing * share, 1.0));
      set.nrcs[to] = static_cast<float>(cell.nrcs * share);
    }
    to += static_cast<std::size_t>(columns);
  }
}

void find_angles(std::vector<float>& grazing) {
  constexpr std::size_t kPart = 8192;
  core::parallel_for((grazing.size() + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t begin = part * kPart;
    arcsines(grazing.data() + begin, static_cast<int>(std::min(kPart, grazing.size() - begin)));
  });
}

}  // namespace fanbeam::renderer
