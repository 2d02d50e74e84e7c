// Line plots through the gnuplot program, for commands that show curves.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fanbeam::session {

struct PlotSeries {
  enum class Style { line, dashed_line, points, line_points };
  std::string title;  // in the key; empty for none
  std::vector<double> x, y;
  Style style = Style::line;
  std::optional<std::size_t> colour{};  // of eight; otherwise its place among the series
};

// A line across the plot at `x`, from below to above, with its name along it.
struct PlotMark {
  double x = 0.0;
  std::string text;
};

struct PlotLabel {
  double x = 0.0, y = 0.0;
  std::string text;  // right of the point
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
  std::vector<PlotMark> marks{};
  std::vector<PlotLabel> labels{};
  bool key_below = false;  // instead of beside the plot
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

// Draws it with each ending.
inline constexpr std::array<const char*, 2> kPlotEndings = {".svg", ".png"};
void write_plots(const Plot& plot, const std::filesystem::path& name);

// The same for what `script` tells gnuplot to draw into the path that it is given.
void write_plot(const std::function<std::string(const std::filesystem::path&)>& script,
                const std::filesystem::path& file);

// Text in quotes as gnuplot reads it, with nothing inside it special.
std::string gnuplot_text(std::string_view text);

}  // namespace fanbeam::session
