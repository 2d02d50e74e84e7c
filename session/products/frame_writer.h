// Writes the products of frames while the next frames are rendered.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/image.h"
#include "core/stop.h"
#include "renderer/frame.h"
#include "sensors/sensor.h"
#include "session/figure/figure_facts.h"
#include "session/labels/frame_labels.h"
#include "session/products/products.h"

namespace fanbeam::session {

// What one frame leaves on disk, and how it is described there.
struct FrameOutput {
  int index = 0;
  double antenna_heading_rad = 0.0;  // true, of the antenna's forward axis
  renderer::Frame frame;
  core::Metadata metadata;
  std::string detection_table{};  // of the product "detections"
  std::string obstacle_table{};   // of the product "obstacles"
  FigureFacts figure{};           // of the products "figure" and "ppi_figure"
  std::string labels_text{};      // of the product "labels"
  FrameLabels labels{};           // of the products "masks" and "cscope_masks"
};

std::filesystem::path frame_path(const std::filesystem::path& folder, const std::string& product,
                                 int index);

// Rows of a B-scope array [cell][column] turned so that the farthest range is on top.
std::vector<double> farthest_on_top(const std::vector<double>& values, int columns);

// The B-scope and the C-scope side by side, each pixel doubled in width.
core::Picture8 side_by_side(const core::Picture8& left, const core::Picture8& right);

class FrameWriter {
 public:
  FrameWriter(std::filesystem::path folder, ProductSet products, const sensors::Sensor& sensor);
  ~FrameWriter();

  // Waits while too many frames are queued. Rethrows what went wrong with an earlier frame.
  void push(FrameOutput output);
  // Waits until everything is on disk. Rethrows as push.
  void finish();

 private:
  void run();
  void write(const FrameOutput& output) const;
  void write_plan_views(const FrameOutput& output) const;

  static constexpr std::size_t kMostQueued = 8;
  std::filesystem::path folder_;
  ProductSet products_;
  const sensors::Sensor& sensor_;
  core::StopToken stop_;  // of whoever made the writer
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FrameOutput> queue_;
  bool busy_ = false;
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace fanbeam::session
