#include "signal/detection/map_peaks.h"

#include "signal/fourier/peak_fit.h"

namespace fanbeam::signal {
namespace {

class Neighbours {
 public:
  Neighbours(const PowerMap& map, bool rows_wrap) : map_(map), rows_wrap_(rows_wrap) {}

  // False where the map ends.
  bool at(int row, int column, double& power_W) const {
    if (rows_wrap_) row = (row + map_.rows) % map_.rows;
    if (row < 0 || row >= map_.rows || column < 0 || column >= map_.columns) return false;
    power_W = map_.at(row, column);
    return true;
  }

  bool is_peak(const CfarCell& cell) const {
    for (int dr = -1; dr <= 1; ++dr)
      for (int dc = -1; dc <= 1; ++dc) {
        double other_W = 0.0;
        if ((dr == 0 && dc == 0) || !at(cell.row + dr, cell.column + dc, other_W)) continue;
        const bool earlier = dr < 0 || (dr == 0 && dc < 0);
        if (other_W > cell.power_W || (earlier && other_W == cell.power_W)) return false;
      }
    return true;
  }

  double offset(const CfarCell& cell, int row_step, int column_step) const {
    double left_W = 0.0;
    double right_W = 0.0;
    if (!at(cell.row - row_step, cell.column - column_step, left_W) ||
        !at(cell.row + row_step, cell.column + column_step, right_W))
      return 0.0;
    return log_parabola_peak(left_W, cell.power_W, right_W).offset;
  }

 private:
  const PowerMap& map_;
  bool rows_wrap_;
};

}  // namespace

std::vector<MapPeak> map_peaks(const PowerMap& map, const std::vector<CfarCell>& detected,
                               bool rows_wrap) {
  const Neighbours neighbours(map, rows_wrap);
  std::vector<MapPeak> peaks;
  for (const CfarCell& cell : detected)
    if (neighbours.is_peak(cell))
      peaks.push_back({cell, cell.row + neighbours.offset(cell, 1, 0),
                       cell.column + neighbours.offset(cell, 0, 1)});
  return peaks;
}

}  // namespace fanbeam::signal
