// F19 without its network: thousands of frames take no more memory, file descriptors or threads
// than the first hundreds.
#include <algorithm>

#include "core/parallel.h"
#include "renderer/frame_renderer.h"
#include "renderer/plan/effects.h"
#include "renderer/plan/plan.h"
#include "scenes/scene.h"
#include "scenes/scene_reader.h"
#include "tests/apps/busy_scene.h"
#include "tests/apps/child.h"

using namespace fanbeam;
using namespace fanbeam::tests;
namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Their own bookkeeping grows: only descriptors and threads count.
constexpr int kManyFrames = 1000;
constexpr bool kMemoryCounts = false;
#else
constexpr int kManyFrames = 20000;
constexpr bool kMemoryCounts = true;
#endif

struct Held {
  std::uint64_t resident_kB = 0, descriptors = 0, threads = 0;
};

Held held_by_this_process() {
  Held held;
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmRSS:") status >> held.resident_kB;
    if (word == "Threads:") status >> held.threads;
  }
  for (const auto& entry : fs::directory_iterator("/proc/self/fd"))
    held.descriptors += entry.path().empty() ? 0 : 1;
  return held;
}

// F19 allows 1 %. What the allocators of two threads hold back besides varies by some 2 MB of 150. A
// leak of one picture of 20 x 20 doubles a frame would be 60 MB after 19 000 frames.
constexpr double kNoise_kB = 2048.0;

void check_flat(const Held& early, const Held& late) {
  CHECK(late.descriptors <= early.descriptors);
  CHECK(late.threads <= early.threads);
  if (kMemoryCounts)
    CHECK(static_cast<double>(late.resident_kB) <=
          1.01 * static_cast<double>(early.resident_kB) + kNoise_kB);
}

// The busy scene through a renderer of its own, `count` times, with as few rays as it takes.
void check_frames(const std::string& effects, int count) {
  const TemporaryFolder folder;
  write_busy_scene(folder, 20);
  core::ProblemList problems;
  scenes::SceneDescription description =
      scenes::read_scene(folder.path(), {FANBEAM_SOURCE_DIR, {}, {}}, problems);
  description.sensor.display.cscope_mode = sensors::Display::CScopeMode::true_elevation;
  scenes::BuildOptions options;
  if (!effects.empty()) options.wishes = renderer::parse_effect_wishes(effects);
  const auto scene = scenes::build_scene(description, options, problems);
  renderer::Sampling sampling;
  sampling.sub_columns = 1;
  sampling.rays_per_cell = 0.5;
  sampling.refinement_depth = 0;
  sampling.largest_step_rad = 0.02;
  sampling.largest_step_rows = 8.0;
  const renderer::FrameRenderer frames(scene->world, sampling, {},
                                       renderer::effects_of(scene->plan, 7));
  const core::ThreadLimit threads(2);
  constexpr int kLoop = 200;
  const int warm = std::max(kLoop, count / 20);  // every pose has been seen
  Held early;
  std::vector<std::vector<double>> loop_W;  // of the first one
  for (int i = 0; i < count; ++i) {
    const renderer::Frame frame = frames.render(scene->frame_pose(i % kLoop));
    if (i < kLoop) loop_W.push_back(frame.bscope_W);
    REQUIRE(frame.bscope_W == loop_W[static_cast<std::size_t>(i % kLoop)]);
    if (i == warm) early = held_by_this_process();
  }
  CHECK(loop_W.front().size() == 400);
  CHECK(loop_W.front() != loop_W.back());
  check_flat(early, held_by_this_process());
}

}  // namespace

TEST_CASE("F19 twenty thousand frames in one process hold no more than the first thousand",
          "[long_run][F19]") {
  check_frames("-side-lobes,-double-bounce,-rain-echo,-range-response", kManyFrames);
}

TEST_CASE("F19 a thousand frames with every effect hold no more than the first two hundred",
          "[long_run][F19]") {
  check_frames("", std::max(kManyFrames / 20, 250));
}

TEST_CASE("F19 a render of hundreds of pictures holds no more than at its start",
          "[long_run][F19]") {
  const TemporaryFolder folder;
  write_busy_scene(folder, 20);
  const fs::path out = folder.path() / "out";
  Child child({"render", folder.path().string(), "-q", "-o", out.string(), "--frames", "0:400",
               "--rays-per-cell", "0.5", "--threads", "2", "--products",
               "bscope,cscope,pair,power,detections,obstacles"});
  const auto held = [&] {
    return Held{child.field("VmRSS:"), child.descriptors(), child.field("Threads:")};
  };
  // While it writes, a file is open now and then, and up to eight frames wait in its queue: the most
  // of many looks, early and late.
  const auto most_until = [&](int frame) {
    Held most;
    char name[32];
    std::snprintf(name, sizeof name, "power/%05d.exr", frame);
    while (child.running() && !fs::exists(out / name)) {
      const Held now = held();
      most.resident_kB = std::max(most.resident_kB, now.resident_kB);
      most.descriptors = std::max(most.descriptors, now.descriptors);
      most.threads = std::max(most.threads, now.threads);
      wait_ms(1.0);
    }
    return most;
  };
  // It took 200 frames until the allocators and the image library's caches had all they want; 700
  // more added nothing.
  const Held early = most_until(220);
  const Held late = most_until(399);
  CHECK(early.resident_kB > 0);
  CHECK(late.descriptors <= early.descriptors + 1);  // the looks may miss a file
  CHECK(late.threads <= early.threads);
  if (kMemoryCounts)
    CHECK(static_cast<double>(late.resident_kB) <=
          1.01 * static_cast<double>(early.resident_kB) + kNoise_kB);
  CHECK(child.wait() == 0);
}
