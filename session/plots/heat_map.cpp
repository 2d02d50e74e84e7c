#include "session/plots/heat_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "session/plots/gnuplot.h"

namespace fanbeam::session {
namespace {

// Perceptually even from dark to light (viridis, nine of its colours).
constexpr const char* kPalette =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', "
    "5 '#28ae80', 6 '#5ec962', 7 '#addc30', 8 '#fde725')\n";

std::string axis_commands(char name, const HeatMapAxis& axis) {
  std::string text =
      fmt::format("set {0}label {1} noenhanced\nset {0}range [{2}:{3}]\n", name,
                  gnuplot_text(axis.label), core::number_text(axis.first - 0.5 * axis.step),
                  core::number_text(axis.first + (axis.cells - 0.5) * axis.step));
  if (axis.ticks.empty()) return text;
  std::string ticks;
  for (const auto& [label, place] : axis.ticks)
    ticks += fmt::format("{}{} {}", ticks.empty() ? "" : ", ", gnuplot_text(label),
                         core::number_text(place));
  return text + fmt::format("set {}tics ({})\n", name, ticks);
}

}  // namespace

std::string gnuplot_script(const HeatMap& map, const std::filesystem::path& output) {
  std::string text = fmt::format(
      "set terminal {} size {},{} font 'sans,12' background rgb 'white'\nset output {}\n",
      output.extension() == ".svg" ? "svg" : "pngcairo", map.width_px, map.height_px,
      gnuplot_text(output.string()));
  text += fmt::format("set title {} noenhanced\n", gnuplot_text(map.title));
  text += axis_commands('x', map.x) + axis_commands('y', map.y) + kPalette;
  text += fmt::format("set cblabel {} noenhanced\nset cbrange [{}:{}]\nset tics out\nunset key\n",
                      gnuplot_text(map.value_label), core::number_text(map.low),
                      core::number_text(map.high));
  if (map.equal_scales) text += "set size ratio -1\n";
  text += "$map << END\n";
  for (int row = 0; row < map.y.cells; ++row) {
    for (int column = 0; column < map.x.cells; ++column) {
      const double value =
          map.values[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.x.cells) +
                     static_cast<std::size_t>(column)];
      text += fmt::format("{:.2f} ",
                          std::isfinite(value) ? std::clamp(value, map.low, map.high) : map.low);
    }
    text += '\n';
  }
  text += "END\n$marks << END\n";
  for (const auto& [x, y] : map.marks)
    text += core::number_text(x) + ' ' + core::number_text(y) + '\n';
  text += fmt::format("END\nplot $map matrix using ({}+$1*{}):({}+$2*{}):3 with image",
                      core::number_text(map.x.first), core::number_text(map.x.step),
                      core::number_text(map.y.first), core::number_text(map.y.step));
  if (!map.marks.empty())
    text += ", $marks using 1:2 with points pt 6 ps 0.8 lw 1 lc rgb '#ff3030'";
  return text + "\nset output\n";
}

void write_heat_map(const HeatMap& map, const std::filesystem::path& file) {
  write_plot([&](const std::filesystem::path& output) { return gnuplot_script(map, output); },
             file);
}

}  // namespace fanbeam::session
