// Line plots through the gnuplot program, for commands that show curves.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fanbeam::apps {

struct PlotSeries {
  enum class Style { line, dashed_line, points };
  std::string title;  // in the key; empty for none
  std::vector<double> x, y;
  Style style = Style::line;
};

struct PlotAxis {
  std::string label;
  bool logarithmic = false;
  std::optional<double> low, high;  // gnuplot's choice where missing
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<PlotSeries> series;
  int width_px = 960;
  int height_px = 640;
};

// What gnuplot is told, so that it draws into `output`: SVG or PNG, by its ending. Values that are
// not finite leave a gap in their curve. The same plot gives the same text.
std::string gnuplot_script(const Plot& plot, const std::filesystem::path& output);

// Draws the plot; a file of that name is replaced only by a complete one. Throws InputError
// E-UNSUPPORTED for another ending than .svg and .png, E-IO when gnuplot is missing (the message
// names the package) or fails.
void write_plot(const Plot& plot, const std::filesystem::path& file);

}  // namespace fanbeam::apps
