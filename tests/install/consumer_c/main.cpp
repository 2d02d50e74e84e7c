// A program in C++17 that uses the C interface: watts and ground truth of the first pose of a flight.
//
//   consumer SHIPPED SCENE
#include <fanbeam/fanbeam.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

namespace {

int failed(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, fanbeam_last_error());
  return 1;
}

int look(fanbeam_session* session) {
  fanbeam_facts facts{};
  facts.size = sizeof facts;
  fanbeam_pose pose{};
  pose.size = sizeof pose;
  if (fanbeam_get_facts(session, &facts) < 0) return failed("facts");
  if (fanbeam_flown_pose(session, 0, &pose) < 0) return failed("pose");
  const std::size_t columns = facts.columns;
  std::vector<double> watts(columns * facts.bscope_rows);
  fanbeam_output output{};
  output.size = sizeof output;
  output.layers = FANBEAM_BSCOPE;
  output.bscope_W = watts.data();
  output.bscope_W_count = watts.size();
  if (fanbeam_render(session, &pose, 0, &output) < 0) return failed("render");
  const double strongest_W = *std::max_element(watts.begin(), watts.end());

  std::vector<std::uint32_t> materials(watts.size());
  if (fanbeam_layer_ids(output.truth, FANBEAM_BSCOPE, "material", materials.data(),
                        materials.size()) < 0)
    return failed("materials");
  const char* const name =
      fanbeam_layer_id_name(output.truth, "material", materials[100 * columns + columns / 2]);
  std::printf("%.3g W, %s\n", strongest_W, name == nullptr ? "nothing" : name);
  const bool grass = name != nullptr && std::strstr(name, "grass") != nullptr;
  fanbeam_free_layers(output.truth);
  return grass && strongest_W > 0.0 && strongest_W < 1.0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  if (fanbeam_version_number() != FANBEAM_VERSION_NUMBER) return 1;
  fanbeam_setup setup{};
  setup.size = sizeof setup;
  setup.shipped_folder = argv[1];
  fanbeam_session* session = nullptr;
  if (fanbeam_open(argv[2], &setup, &session) < 0) return failed(argv[2]);
  const int result = look(session);
  fanbeam_close(session);
  return result;
}
