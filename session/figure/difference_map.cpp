#include "session/figure/difference_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/image_compare.h"
#include "session/figure/axis.h"
#include "session/figure/canvas.h"
#include "session/figure/font.h"

namespace fanbeam::session {
namespace {

using core::Colour;

constexpr Colour kPaper{255, 255, 255}, kMapInk{40, 40, 40}, kUndefined{0, 0, 0};
// From equal to the scale's end. Blue and orange; equal is near white on either side.
constexpr Colour kHigher[] = {{244, 244, 244}, {240, 150, 60}, {120, 45, 0}};
constexpr Colour kLower[] = {{244, 244, 244}, {85, 150, 215}, {10, 40, 110}};
// The least depth of what differs.
constexpr double kLeastDepth = 0.25;

constexpr int kMapMargin = 12, kMapLine = kGlyphRows + 4, kMapLeft = 62, kBarGap = 34, kMapBar = 16,
              kBarText = 64, kMapBelow = 44, kLeastMapRows = 160, kWantedMapColumns = 360;
constexpr int kMostCells = 16384;  // along a side

Colour blend(const Colour& from, const Colour& to, double share) {
  const auto mix = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::floor(a + (b - a) * share + 0.5));
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

// B - A, or 10 log10(B / A); infinite where one is dark, not a number where there is no such thing.
double difference_of(double a, double b, DifferenceUnit unit) {
  if (a == b) return 0.0;
  if (unit != DifferenceUnit::dB) return b - a;
  if (!(a >= 0.0 && b >= 0.0)) return std::nan("");
  return 10.0 * std::log10(b / a);
}

// Of a difference that is not 0.
Colour shade_of(double difference, double limit) {
  const double depth = std::sqrt(std::min(1.0, std::abs(difference) / limit));
  return diverging_colour(std::copysign(std::max(depth, kLeastDepth), difference));
}

struct MapLayer {
  core::LayerDifference figures;
  DifferenceUnit unit = DifferenceUnit::grey;
  const std::vector<double>* a = nullptr;
  const std::vector<double>* b = nullptr;
  double limit = 1.0;
  double worst = 0.0;  // signed; infinite where one is dark
  int worst_column = 0, worst_row = 0;
  int across = 1, down = 1;  // pixels of a cell
};

const std::vector<double>& values_of(const core::Image& image, const std::string& layer) {
  return std::find_if(image.layers.begin(), image.layers.end(),
                      [&](const core::Image::Layer& l) { return l.name == layer; })
      ->values;
}

MapLayer examined(const core::Image& a, const core::Image& b, const core::LayerDifference& figures,
                  DifferenceUnit unit) {
  MapLayer layer{figures, unit, &values_of(a, figures.layer), &values_of(b, figures.layer)};
  double largest = 0.0;  // that is finite: what the scale has to hold
  for (std::size_t i = 0; i < layer.a->size(); ++i) {
    const double difference = difference_of((*layer.a)[i], (*layer.b)[i], unit);
    if (std::isnan(difference)) continue;
    if (std::isfinite(difference)) largest = std::max(largest, std::abs(difference));
    if (std::abs(difference) <= std::abs(layer.worst)) continue;
    layer.worst = difference;
    layer.worst_column = static_cast<int>(i) % a.columns;
    layer.worst_row = static_cast<int>(i) / a.columns;
  }
  layer.limit = difference_limit(largest, unit);
  layer.across = std::clamp(kWantedMapColumns / a.columns, 1, 16);
  layer.down = std::clamp(kWantedMapColumns / a.rows, 1, 16);
  return layer;
}

class DifferenceSheet {
 public:
  DifferenceSheet(const core::Image& a, const core::Image& b, const std::filesystem::path& file,
                  const DifferenceLabels& labels)
      : columns_(a.columns), rows_(a.rows), labels_(labels) {
    for (const core::LayerDifference& figures : core::compare_images(a, b, labels.a, labels.b))
      layers_.push_back(examined(a, b, figures, difference_unit(file, figures.layer)));
  }

  core::ColourPicture draw() const;

 private:
  int panel_columns(const MapLayer& layer) const;
  int panel_rows(const MapLayer& layer) const {
    return std::max(kLeastMapRows, rows_ * layer.down);
  }
  std::vector<std::string> words_of(const MapLayer& layer) const;
  void draw_cells(Canvas& canvas, const MapLayer& layer, const Box& cells) const;
  void draw_bar(Canvas& canvas, const MapLayer& layer, const Box& bar) const;
  void draw_panel(Canvas& canvas, const MapLayer& layer, int left, int top) const;

  int columns_, rows_;
  const DifferenceLabels& labels_;
  std::vector<MapLayer> layers_;
};

// Three lines that say it in words.
std::vector<std::string> DifferenceSheet::words_of(const MapLayer& layer) const {
  const core::LayerDifference& figures = layer.figures;
  const bool in_dB = layer.unit == DifferenceUnit::dB;
  const std::string unit = unit_text(layer.unit, figures.layer);
  if (figures.different == 0) return {"identical", fmt::format("{} cells", figures.cells), ""};
  const std::string worst =
      std::isinf(layer.worst)
          ? fmt::format("lit in {} only", layer.worst > 0.0 ? labels_.b : labels_.a)
          : fmt::format("{:+.{}f} {}", layer.worst, layer.unit == DifferenceUnit::grey ? 0 : 3,
                        unit);
  std::string count = fmt::format("{} of {} cells differ", figures.different, figures.cells);
  if (in_dB && figures.only_one_positive > 0)
    count += fmt::format(", {} lit in one only", figures.only_one_positive);
  return {fmt::format("worst: {} at column {}, row {}", worst, layer.worst_column, layer.worst_row),
          fmt::format("mean {:+.4f}, RMS {:.4f} {}", in_dB ? figures.mean_dB : figures.mean,
                      in_dB ? figures.rms_dB : figures.rms, unit),
          count};
}

int DifferenceSheet::panel_columns(const MapLayer& layer) const {
  int words = 0;
  for (const std::string& line : words_of(layer)) words = std::max(words, text_width(line));
  return std::max(kMapMargin + words,
                  kMapLeft + columns_ * layer.across + kBarGap + kMapBar + kBarText);
}

void DifferenceSheet::draw_cells(Canvas& canvas, const MapLayer& layer, const Box& cells) const {
  for (std::size_t i = 0; i < layer.a->size(); ++i)
    canvas.fill({cells.left + static_cast<int>(i) % columns_ * layer.across,
                 cells.top + static_cast<int>(i) / columns_ * layer.down, layer.across, layer.down},
                difference_colour((*layer.a)[i], (*layer.b)[i], layer.unit, layer.limit));
  canvas.frame(cells, kMapInk);
  const AxisStyle style{kMapInk, 50};
  draw_axis_below(canvas, {0.0, static_cast<double>(columns_), cells.columns, "column"}, cells.left,
                  cells.bottom() + 1, style);
  draw_axis_left(canvas, {0.0, static_cast<double>(rows_), cells.rows, "row"}, cells.left - 1,
                 cells.top, kMapLeft - kMapMargin, style);
  if (layer.worst == 0.0) return;
  // Wedges above and beside the picture point at the worst cell.
  constexpr int kSize = 5;
  canvas.wedge(cells.left + layer.worst_column * layer.across + layer.across / 2, cells.top - 3,
               kSize, Canvas::Widens::up, kMapInk);
  canvas.wedge(cells.right() + 2, cells.top + layer.worst_row * layer.down + layer.down / 2, kSize,
               Canvas::Widens::right, kMapInk);
}

// Differences are evenly spaced in the bar: the square root shows in its colours.
void DifferenceSheet::draw_bar(Canvas& canvas, const MapLayer& layer, const Box& bar) const {
  for (int row = 0; row < bar.rows; ++row) {
    const double share = 1.0 - 2.0 * (row + 0.5) / bar.rows;
    const bool middle = std::abs(share) * bar.rows < 2.5;
    canvas.fill({bar.left, bar.top + row, bar.columns, 1},
                middle ? diverging_colour(0.0) : shade_of(share, 1.0));
  }
  canvas.frame(bar, kMapInk);
  draw_axis_right(canvas, {layer.limit, -layer.limit, bar.rows}, bar.right() + 1, bar.top,
                  {kMapInk, 30});
  canvas.text(
      bar.right() + kBarText, bar.top - kMapLine - 6,
      fmt::format("{} - {}, {}", labels_.b, labels_.a, unit_text(layer.unit, layer.figures.layer)),
      {kMapInk, Align::right});
}

void DifferenceSheet::draw_panel(Canvas& canvas, const MapLayer& layer, int left, int top) const {
  if (layers_.size() > 1) {
    canvas.text(left + kMapMargin, top, layer.figures.layer, {kMapInk, Align::left, 1, true});
    top += kMapLine;
  }
  for (const std::string& line : words_of(layer)) {
    canvas.text(left + kMapMargin, top, line, {kMapInk});
    top += kMapLine;
  }
  const Box cells{left + kMapLeft, top + kMapLine + 8, columns_ * layer.across, rows_ * layer.down};
  draw_cells(canvas, layer, cells);
  draw_bar(canvas, layer, {cells.right() + kBarGap, cells.top, kMapBar, panel_rows(layer)});
}

core::ColourPicture DifferenceSheet::draw() const {
  const std::string foot =
      fmt::format("orange: {} higher   blue: {} lower   near white: equal", labels_.b, labels_.b);
  int columns = 0, rows = 0;
  for (const MapLayer& layer : layers_) {
    columns += panel_columns(layer) + kMapMargin;
    rows = std::max(rows, panel_rows(layer));
  }
  columns = std::max(
      {columns, text_width(labels_.title) + 2 * kMapMargin, text_width(foot) + 2 * kMapMargin});
  const int top = kMapMargin + kMapLine + 4;
  const int lines = layers_.size() > 1 ? 5 : 4;
  rows += top + lines * kMapLine + 8 + kMapBelow + kMapLine + kMapMargin;
  Canvas canvas(columns, rows, kPaper);
  canvas.text(kMapMargin, kMapMargin, labels_.title, {kMapInk, Align::left, 1, true});
  int left = 0;
  for (const MapLayer& layer : layers_) {
    draw_panel(canvas, layer, left, top);
    left += panel_columns(layer) + kMapMargin;
  }
  canvas.text(kMapMargin, rows - kMapMargin - kGlyphRows, foot, {kMapInk});
  return canvas.picture();
}

}  // namespace

DifferenceUnit difference_unit(const std::filesystem::path& image, const std::string& layer) {
  if (image.extension() != ".exr") return DifferenceUnit::grey;
  for (const char* end : {"_deg", "_m", "_dB", "_id", "_share"})
    if (layer.ends_with(end)) return DifferenceUnit::own;
  return DifferenceUnit::dB;
}

std::string unit_text(DifferenceUnit unit, const std::string& layer) {
  if (unit == DifferenceUnit::own) return layer.substr(layer.rfind('_') + 1);
  return unit == DifferenceUnit::grey ? "grey" : "dB";
}

Colour diverging_colour(double depth) {
  const Colour* colours = depth < 0.0 ? kLower : kHigher;
  const double share = 2.0 * std::min(1.0, std::abs(depth));
  return share <= 1.0 ? blend(colours[0], colours[1], share)
                      : blend(colours[1], colours[2], share - 1.0);
}

double difference_limit(double largest, DifferenceUnit unit) {
  const double least = unit == DifferenceUnit::grey ? 1.0 : unit == DifferenceUnit::dB ? 0.1 : 1e-3;
  return rounded_up(std::max(largest, least));
}

Colour difference_colour(double a, double b, DifferenceUnit unit, double limit) {
  if (a == b) return diverging_colour(0.0);
  const double difference = difference_of(a, b, unit);
  return std::isnan(difference) ? kUndefined : shade_of(difference, limit);
}

core::ColourPicture difference_map(const core::Image& a, const core::Image& b,
                                   const std::filesystem::path& file,
                                   const DifferenceLabels& labels) {
  if (std::max(a.columns, a.rows) > kMostCells)
    core::throw_input_error(core::ErrorClass::limit, core::Place{labels.title}, "image size",
                            fmt::format("{} x {}", a.columns, a.rows),
                            fmt::format("at most {} columns and rows", kMostCells));
  return DifferenceSheet(a, b, file, labels).draw();
}

}  // namespace fanbeam::session
