// Ground truth of the cells of live frames, for whoever points at one (renderer/stages/frame_layers.h
// tells what it is). Rendered when somebody first asks for a frame, which takes about as long as the
// frame did and is kept for the last few that were asked for. Thread-safe.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "live/hub.h"
#include "renderer/stages/frame_layers.h"
#include "session/session.h"

namespace fanbeam::live {

enum class Scope { bscope, cscope };

struct CellTruth {
  bool seen = false;  // else in shadow, or nothing but air
  std::string material, object;
  double visibility = 0.0, grazing_rad = 0.0, double_bounce = 0.0;
  double nrcs = 0.0;  // mean sigma0, linear
  // Of the B-scope's cells and of the C-scope's: what the other picture's axis would say.
  std::optional<double> elevation_rad, range_m;
};

// Reports a column or row, of those that are told, beyond the picture; of a row only where the picture
// is told, too.
void check_cell(const sensors::Sensor& sensor, std::optional<Scope> scope,
                std::optional<int> column, std::optional<int> row, core::ProblemList& problems);

class Truth {
 public:
  // Both must outlive it.
  Truth(const session::Session& session, const Hub& hub) : session_(session), hub_(hub) {}

  // Of the picture's `row` from the top. Nothing where the hub has the frame no more, or the scope
  // draws no elevations (C-scopes of other modes than true_elevation). Throws InputError E-RANGE for a
  // cell that the picture does not have.
  std::optional<CellTruth> at(std::uint64_t frame, Scope scope, int column, int row) const;

 private:
  struct Known {
    std::uint64_t frame = 0;
    std::shared_ptr<const scenes::Scene> scene;
    renderer::FrameLayers layers;
  };
  std::shared_ptr<const Known> known(std::uint64_t frame) const;

  const session::Session& session_;
  const Hub& hub_;
  mutable std::mutex mutex_;
  mutable std::deque<std::shared_ptr<const Known>> kept_;
  mutable session::Session::Moment under_;  // of the frame that was rendered last
};

}  // namespace fanbeam::live
