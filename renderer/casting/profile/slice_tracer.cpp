#include "renderer/casting/profile/slice_tracer.h"

namespace fanbeam::renderer {
namespace {

SweepScratch& scratch_of_thread() {
  thread_local SweepScratch scratch;
  return scratch;
}

}  // namespace

SliceTracer::SliceTracer(const SliceFrame& frame)
    : frame_(frame),
      power_(frame.world, frame.antenna, frame.tables, frame.path_loss),
      sweep_(frame.world, frame.antenna.position_m, frame.edges, frame.dark_below,
             scratch_of_thread()) {}

void SliceTracer::cast(std::size_t i, const SliceBins& bins) {
  thread_local VisiblePieces visible;
  const Slice& slice = frame_.slices[i];
  const auto empty = [&](VisiblePieces& pieces) {
    hits_ += static_cast<std::uint64_t>(pieces.count);
    power_.add(slice, pieces, bins);
  };
  const SightPoint* const points = frame_.points.points.data();
  sweep_.run(slice, frame_.edges.candidates(i / frame_.tile), frame_.world.sensor.range.maximum_m(),
             visible, empty,
             {points + frame_.points.begin[i], points + frame_.points.begin[i + 1], frame_.clear});
  empty(visible);
}

}  // namespace fanbeam::renderer
