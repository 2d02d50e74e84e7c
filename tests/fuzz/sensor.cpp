// Sensor files: antenna, waveform, scan, receiver, display.
#include "sensors/sensor_file.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = fuzz::scratch_file("sensor.toml", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) { sensors::read_sensor(file, problems); });
  return 0;
}
