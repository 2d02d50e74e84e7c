#include "renderer/stages/layer_cells.h"

#include <algorithm>
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

}  // namespace

void LayerCells::write(int column, int columns, int azimuths, LayerSet& set) const {
  const auto put = [](std::vector<float>& layer, std::size_t at, double value) {
    if (!layer.empty()) layer[at] = static_cast<float>(value);
  };
  auto to = static_cast<std::size_t>(column);
  for (const Cell& cell : cells_) {
    if (cell.strongest_W >= 0.0F) {
      set.visibility[to] = static_cast<float>(cell.azimuths) / static_cast<float>(azimuths);
      set.material[to] = cell.material;
      set.object[to] = cell.object;
      put(set.elevation_rad, to, static_cast<double>(cell.elevation_rad));
    }
    if (cell.azimuths > 0) {
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
