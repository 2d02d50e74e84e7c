// A host program with oneTBB loops and an Embree scene of its own: the C library, called from inside
// and outside of its tasks and beside its rays, gives the bytes that it gives alone, and the host's
// loops and rays are what they were.
//
//   test_bindings_host SHIPPED SCENE
#include <embree3/rtcore.h>
#include <fanbeam/fanbeam.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <thread>
#include <vector>

namespace {

constexpr std::size_t kPoses = 4;

// A triangle 5 m ahead of the origin.
class HostScene {
 public:
  HostScene() : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const corners = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3));
    auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), 1));
    const float places[9] = {5.0F, -1.0F, -1.0F, 5.0F, 1.0F, -1.0F, 5.0F, 0.0F, 1.0F};
    for (int i = 0; i < 9; ++i) corners[i] = places[i];
    for (unsigned i = 0; i < 3; ++i) indices[i] = i;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~HostScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  HostScene(const HostScene&) = delete;
  HostScene& operator=(const HostScene&) = delete;

  bool sees_triangle() const {
    RTCRayHit ray{};
    ray.ray.dir_x = 1.0F;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xFFFFFFFFU;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &ray);
    return ray.hit.geomID == 0 && std::abs(ray.ray.tfar - 5.0F) < 1e-5F;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

using Picture = std::vector<std::uint8_t>;

// Pictures are the B-scope's bytes and then the C-scope's.
class Radar {
 public:
  Radar() = default;
  ~Radar() { fanbeam_close(session_); }
  Radar(const Radar&) = delete;
  Radar& operator=(const Radar&) = delete;

  bool open(const char* shipped, const char* scene) {
    fanbeam_setup setup{};
    setup.size = sizeof setup;
    setup.shipped_folder = shipped;
    setup.realisation = FANBEAM_SAMPLE;
    setup.samples_per_cell = 1.0;
    if (!good(fanbeam_open(scene, &setup, &session_))) return false;
    facts_.size = sizeof facts_;
    pose_.size = sizeof pose_;
    return good(fanbeam_get_facts(session_, &facts_)) &&
           good(fanbeam_flown_pose(session_, 0, &pose_));
  }

  // Nothing where it fails.
  Picture render(std::size_t i) const {
    Picture picture(bscope() + cscope());
    fanbeam_output output{};
    output.size = sizeof output;
    output.bscope = picture.data();
    output.bscope_count = bscope();
    output.cscope = picture.data() + bscope();
    output.cscope_count = cscope();
    const fanbeam_pose at = pose(i);
    return good(fanbeam_render(session_, &at, i, &output)) ? picture : Picture();
  }
  // By the library's thread, whose first frame has the number 1.
  bool submit(std::size_t i) const {
    const fanbeam_pose at = pose(i);
    return good(fanbeam_submit_pose(session_, &at));
  }
  Picture latest() const {
    Picture picture(bscope() + cscope());
    fanbeam_frame frame{};
    frame.size = sizeof frame;
    for (int turn = 0; turn < 60000; ++turn) {
      const fanbeam_status status = fanbeam_latest_frame(session_, &frame, picture.data(), bscope(),
                                                         picture.data() + bscope(), cscope());
      if (status == FANBEAM_OK) return picture;
      if (!good(status)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return {};
  }

 private:
  static bool good(fanbeam_status status) {
    if (status < 0) std::fprintf(stderr, "%s\n", fanbeam_last_error());
    return status >= 0;
  }
  fanbeam_pose pose(std::size_t i) const {
    fanbeam_pose higher = pose_;
    higher.height_m += 5.0 * static_cast<double>(i);
    return higher;
  }
  std::size_t bscope() const { return std::size_t{facts_.columns} * facts_.bscope_rows; }
  std::size_t cscope() const { return std::size_t{facts_.columns} * facts_.cscope_rows; }

  fanbeam_session* session_ = nullptr;
  fanbeam_facts facts_{};
  fanbeam_pose pose_{};
};

bool told(const char* what, int wrong) {
  std::printf("%s: %d wrong\n", what, wrong);
  return wrong == 0;
}

// Frames from tasks of a loop of the host's, which goes on with its own rays in nested loops.
int wrong_in_tasks(const Radar& radar, const HostScene& own, const std::vector<Picture>& alone) {
  std::atomic<int> wrong{0};
  tbb::parallel_for(std::size_t{0}, 4 * kPoses, [&](std::size_t i) {
    if (radar.render(i % kPoses) != alone[i % kPoses]) ++wrong;
    tbb::parallel_for(0, 100, [&](int) {
      if (!own.sees_triangle()) ++wrong;
    });
  });
  return wrong;
}

// From a thread without tasks, while the host's tasks cast rays.
int wrong_beside_tasks(const Radar& radar, const HostScene& own,
                       const std::vector<Picture>& alone) {
  std::atomic<int> wrong{0};
  std::thread outside([&] {
    for (std::size_t i = 0; i < 2 * kPoses; ++i)
      if (radar.render(i % kPoses) != alone[i % kPoses]) ++wrong;
  });
  tbb::parallel_for(0, 20000, [&](int) {
    if (!own.sees_triangle()) ++wrong;
  });
  outside.join();
  return wrong;
}

// Inside an arena of the host's of one thread, which is to stay one of one thread.
int wrong_in_arena(const Radar& radar, const std::vector<Picture>& alone) {
  int wrong = 0;
  tbb::task_arena arena(1);
  arena.execute([&] {
    for (std::size_t i = 0; i < kPoses; ++i)
      if (radar.render(i) != alone[i]) ++wrong;
    if (tbb::this_task_arena::max_concurrency() != 1) ++wrong;
  });
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const HostScene own;
  Radar radar;
  if (!radar.open(argv[1], argv[2])) return 3;
  std::vector<Picture> alone;
  for (std::size_t i = 0; i < kPoses; ++i) {
    alone.push_back(radar.render(i));
    if (alone.back().empty()) return 3;
  }
  const bool differ = alone[0] != alone[1];
  if (!differ) std::printf("two poses look the same: nothing would be noticed\n");
  bool good = differ && told("in tasks", wrong_in_tasks(radar, own, alone));
  good = told("beside tasks", wrong_beside_tasks(radar, own, alone)) && good;
  good = told("in an arena", wrong_in_arena(radar, alone)) && good;
  // Its pose and its number are those of the second.
  if (!radar.submit(1)) return 3;
  good = told("in the background", radar.latest() == alone[1] ? 0 : 1) && good;
  return good ? 0 : 1;
}
