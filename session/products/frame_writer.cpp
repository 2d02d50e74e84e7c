#include "session/products/frame_writer.h"

#include <fmt/core.h>

#include "core/errors.h"
#include "core/files.h"
#include "core/stop.h"
#include "sensors/display/display.h"
#include "sensors/display/ppi.h"
#include "session/figure/frame_figure.h"
#include "session/figure/plan_figure.h"
#include "session/products/detection_product.h"
#include "session/products/frame_table.h"
#include "session/products/layers_product.h"
#include "session/products/mask_product.h"

namespace fanbeam::session {
namespace {

constexpr int kPpiSize_px = 700;

// For whoever cuts the scopes out again.
core::Metadata figure_metadata(const sensors::Sensor& sensor, core::Metadata metadata) {
  const FigureLayout layout = figure_layout(sensor);
  const auto place = [&](const Box& box, int rows) {
    return fmt::format("left {}, top {}, {} x {} pixels per cell", box.left, box.top,
                       box.columns / sensor.scan.columns, box.rows / rows);
  };
  metadata.emplace_back("fanbeam:figure_bscope", place(layout.bscope, sensor.range.cells));
  metadata.emplace_back("fanbeam:figure_cscope", place(layout.cscope, sensor.display.cscope_rows));
  return metadata;
}

}  // namespace

std::vector<double> farthest_on_top(const std::vector<double>& values, int columns) {
  std::vector<double> turned;
  turned.reserve(values.size());
  for (auto row = values.end(); row != values.begin();) {
    row -= columns;
    turned.insert(turned.end(), row, row + columns);
  }
  return turned;
}

std::filesystem::path frame_path(const std::filesystem::path& folder, const std::string& product,
                                 int index) {
  const bool exr = product == "power" || product == "layers" || product == "cscope_layers";
  return folder / product /
         fmt::format("{:05}.{}", index,
                     exr                   ? "exr"
                     : product == "labels" ? "json"
                                           : "png");
}

core::Picture8 side_by_side(const core::Picture8& left, const core::Picture8& right) {
  constexpr int kGap = 8;
  core::Picture8 both;
  both.columns = 2 * left.columns + kGap + 2 * right.columns;
  both.rows = std::max(left.rows, right.rows);
  both.pixels.assign(static_cast<std::size_t>(both.columns) * static_cast<std::size_t>(both.rows),
                     0);
  const auto paste = [&](const core::Picture8& from, int at) {
    for (int row = 0; row < from.rows; ++row)
      for (int column = 0; column < 2 * from.columns; ++column)
        both.pixels[static_cast<std::size_t>(row * both.columns + at + column)] =
            from.pixels[static_cast<std::size_t>(row * from.columns + column / 2)];
  };
  paste(left, 0);
  paste(right, 2 * left.columns + kGap);
  return both;
}

FrameWriter::FrameWriter(std::filesystem::path folder, ProductSet products,
                         const sensors::Sensor& sensor)
    : folder_(std::move(folder)),
      products_(std::move(products)),
      sensor_(sensor),
      stop_(core::StopScope::current()),
      thread_([this] { run(); }) {}

FrameWriter::~FrameWriter() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameWriter::push(FrameOutput output) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return queue_.size() < kMostQueued || failure_; });
  if (failure_) std::rethrow_exception(failure_);
  queue_.push_back(std::move(output));
  changed_.notify_all();
}

void FrameWriter::finish() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return (queue_.empty() && !busy_) || failure_; });
  if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::run() {
  const core::StopScope scope(stop_);
  for (;;) {
    FrameOutput output;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      busy_ = false;
      changed_.notify_all();
      changed_.wait(lock, [&] { return stopping_ || !queue_.empty(); });
      if (queue_.empty() || failure_) return;
      output = std::move(queue_.front());
      queue_.pop_front();
      busy_ = true;
    }
    changed_.notify_all();
    try {
      core::throw_if_stopped();  // what is queued can be rendered again
      write(output);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      failure_ = std::current_exception();
      changed_.notify_all();
      return;
    }
  }
}

void FrameWriter::write_plan_views(const FrameOutput& output) const {
  using Up = sensors::PpiView::Up;
  for (const auto& [product, up] :
       {std::pair{"ppi", Up::track}, std::pair{"ppi_north", Up::north}}) {
    const bool figure = up == Up::track && products_.contains("ppi_figure");
    if (!products_.contains(product) && !figure) continue;
    const sensors::PpiView view =
        sensors::ppi_view(sensor_, up, kPpiSize_px, output.antenna_heading_rad);
    const core::Picture8 picture = sensors::ppi_picture(
        view,
        sensors::ppi_grey(sensor_, output.frame.bscope_grey, output.antenna_heading_rad, view));
    core::Metadata metadata = output.metadata;
    metadata.emplace_back("fanbeam:ppi", fmt::format("{} m per pixel, antenna at column {}, row {}",
                                                     core::number_text(view.metres_per_pixel),
                                                     core::number_text(view.antenna_column),
                                                     core::number_text(view.antenna_row)));
    if (products_.contains(product))
      core::write_png(frame_path(folder_, product, output.index), picture, metadata);
    if (!figure) continue;
    const Box place = plan_figure_layout(view).ppi;
    metadata.emplace_back("fanbeam:figure_ppi",
                          fmt::format("left {}, top {}", place.left, place.top));
    core::write_png(frame_path(folder_, "ppi_figure", output.index),
                    plan_figure(sensor_, output.figure, view, picture), metadata);
  }
}

void FrameWriter::write(const FrameOutput& output) const {
  const renderer::Frame& frame = output.frame;
  if (products_.contains("bscope"))
    core::write_png(frame_path(folder_, "bscope", output.index),
                    sensors::bscope_picture(sensor_, frame.bscope_grey), output.metadata);
  if (products_.contains("cscope"))
    core::write_png(frame_path(folder_, "cscope", output.index),
                    sensors::cscope_picture(sensor_, frame.cscope_grey), output.metadata);
  if (products_.contains("pair"))
    core::write_png(frame_path(folder_, "pair", output.index),
                    side_by_side(sensors::bscope_picture(sensor_, frame.bscope_grey),
                                 sensors::cscope_picture(sensor_, frame.cscope_grey)),
                    output.metadata);
  if (products_.contains("figure"))
    core::write_png(
        frame_path(folder_, "figure", output.index),
        frame_figure(sensor_, output.figure, sensors::bscope_picture(sensor_, frame.bscope_grey),
                     sensors::cscope_picture(sensor_, frame.cscope_grey)),
        figure_metadata(sensor_, output.metadata));
  write_plan_views(output);
  if (products_.contains("detections")) {
    core::write_file_atomically(frame_table_path(folder_, "detections", output.index),
                                output.detection_table);
    core::write_png(frame_path(folder_, "detections", output.index),
                    detection_mask(sensor_, frame.detections), output.metadata);
  }
  if (products_.contains("obstacles"))
    core::write_file_atomically(frame_table_path(folder_, "obstacles", output.index),
                                output.obstacle_table);
  if (products_.contains("labels"))
    core::write_file_atomically(frame_path(folder_, "labels", output.index), output.labels_text);
  if (products_.contains("masks"))
    core::write_png(frame_path(folder_, "masks", output.index), bscope_mask(output.labels, sensor_),
                    output.metadata);
  if (products_.contains("cscope_masks"))
    core::write_png(frame_path(folder_, "cscope_masks", output.index),
                    cscope_mask(output.labels, sensor_), output.metadata);
  if (products_.contains("power")) {
    core::Image image{sensor_.scan.columns, sensor_.range.cells, {}};
    image.layers.push_back({"power_W", farthest_on_top(frame.received_W(), sensor_.scan.columns)});
    core::write_exr(frame_path(folder_, "power", output.index), image, output.metadata);
  }
  if (products_.contains("layers"))
    core::write_exr(frame_path(folder_, "layers", output.index),
                    bscope_layers(frame.layers->bscope, sensor_), output.metadata);
  if (products_.contains("cscope_layers"))
    core::write_exr(frame_path(folder_, "cscope_layers", output.index),
                    cscope_layers(frame.layers->cscope, sensor_), output.metadata);
}

}  // namespace fanbeam::session
