// From a pose to pictures: cast, beam, targets, receiver, display.
#pragma once

#include <memory>

#include "renderer/frame.h"

namespace fanbeam::renderer {

class Caster;

class FrameRenderer {
 public:
  // `world` must outlive the renderer. Throws InputError E-UNSUPPORTED for C-scope layers of a mode
  // other than true_elevation: the others draw what a receiver knows, not what stands there.
  FrameRenderer(const World& world, const Sampling& sampling, const Products& products,
                const Effects& effects);
  // The same around a caster of the caller's; of `sampling` it is asked for the sub-columns that
  // `caster` fills, and for the rays of bounces.
  FrameRenderer(const World& world, const Sampling& sampling, const Products& products,
                const Effects& effects, std::unique_ptr<Caster> caster);
  FrameRenderer(FrameRenderer&&) noexcept;
  ~FrameRenderer();

  // Thread-safe. Throws InputError E-NONFINITE or E-RANGE for an impossible pose.
  Frame render(const FramePose& pose) const;

 private:
  class Stages;
  std::unique_ptr<const Stages> stages_;
};

}  // namespace fanbeam::renderer
