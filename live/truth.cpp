#include "live/truth.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"

namespace fanbeam::live {
namespace {

constexpr std::size_t kKeptFrames = 4;

int rows_of(const sensors::Sensor& sensor, Scope scope) {
  return scope == Scope::bscope ? sensor.range.cells : sensor.display.cscope_rows;
}

}  // namespace

void check_cell(const sensors::Sensor& sensor, std::optional<Scope> scope,
                std::optional<int> column, std::optional<int> row, core::ProblemList& problems) {
  if (column) core::check_range(problems, "column", *column, {0.0, sensor.scan.columns - 1.0});
  if (scope && row) core::check_range(problems, "row", *row, {0.0, rows_of(sensor, *scope) - 1.0});
}

std::shared_ptr<const Truth::Known> Truth::known(std::uint64_t frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [&](const auto& one) { return one->frame == frame; });
  if (found != kept_.end()) return *found;
  const std::optional<FrameOrigin> shown = hub_.origin(frame);
  if (!shown || !shown->scene) return nullptr;
  auto known = std::make_shared<Known>();
  known->frame = frame;
  known->scene = shown->scene;
  // What stages hold is shared while conditions stand.
  if (!under_ || session_.scene(under_) != shown->scene) under_ = session_.moment(shown->scene);
  const bool elevations = known->scene->description.sensor.display.cscope_mode ==
                          sensors::Display::CScopeMode::true_elevation;
  renderer::Frame made = session_.render(
      under_, shown->pose, frame,
      {.bscope = false, .cscope = false, .layers = true, .cscope_layers = elevations});
  known->layers = std::move(*made.layers);
  kept_.push_back(known);
  if (kept_.size() > kKeptFrames) kept_.pop_front();
  return known;
}

std::optional<CellTruth> Truth::at(std::uint64_t frame, Scope scope, int column, int row) const {
  const std::shared_ptr<const Known> known = this->known(frame);
  if (!known) return std::nullopt;
  const sensors::Sensor& sensor = known->scene->description.sensor;
  const bool bscope = scope == Scope::bscope;
  core::ProblemList problems;
  check_cell(sensor, scope, column, row, problems);
  problems.throw_if_errors();
  const renderer::LayerSet& set = bscope ? known->layers.bscope : known->layers.cscope;
  if (set.visibility.empty()) return std::nullopt;
  // Layers begin with the nearest range cell, pictures with the farthest.
  const int from_first = bscope ? rows_of(sensor, scope) - 1 - row : row;
  const auto i =
      static_cast<std::size_t>(from_first) * static_cast<std::size_t>(sensor.scan.columns) +
      static_cast<std::size_t>(column);
  const renderer::World& world = known->scene->world;
  const std::vector<std::string>& materials = world.geometry->material_names;
  CellTruth cell;
  cell.visibility = static_cast<double>(set.visibility[i]);
  cell.grazing_rad = static_cast<double>(set.grazing_rad[i]);
  cell.nrcs = static_cast<double>(set.nrcs[i]);
  cell.double_bounce = static_cast<double>(set.double_bounce[i]);
  if (bscope)
    cell.elevation_rad = static_cast<double>(set.elevation_rad[i]);
  else
    cell.range_m = static_cast<double>(set.range_m[i]);
  if (set.material[i] < materials.size()) cell.material = materials[set.material[i]];
  cell.seen = set.material[i] != renderer::kNoMaterial || set.object[i] != terrain::kTerrainObject;
  const std::string* object = renderer::object_name(world, set.object[i]);
  if (cell.seen && object != nullptr) cell.object = *object;
  return cell;
}

}  // namespace fanbeam::live
