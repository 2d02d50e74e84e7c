// Maps as coloured pictures with axes, tick labels and a colour bar, through the gnuplot program.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace fanbeam::session {

struct HeatMapAxis {
  std::string label;
  double first = 0.0;  // centre of the first cell
  double step = 1.0;
  int cells = 0;
  std::vector<std::pair<std::string, double>> ticks{};  // gnuplot's choice where empty
};

struct HeatMap {
  std::string title;
  HeatMapAxis x, y;
  std::string value_label;
  double low = 0.0, high = 1.0;  // of the colours; what lies outside takes the end's
  std::vector<double> values;    // y * x.cells + x
  std::vector<std::pair<double, double>> marks{};  // circles at (x, y)
  bool equal_scales = false;                       // as long to the right as upwards
  int width_px = 800, height_px = 560;
};

// What gnuplot is told to draw into `output`; the same map gives the same text. Values that are not
// finite take the lowest colour.
std::string gnuplot_script(const HeatMap& map, const std::filesystem::path& output);

// As write_plot (session/plots/gnuplot.h).
void write_heat_map(const HeatMap& map, const std::filesystem::path& file);

}  // namespace fanbeam::session
