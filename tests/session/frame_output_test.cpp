// What is told beside a frame's pictures is true of them.
#include "session/products/frame_output.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "core/files.h"
#include "core/units.h"
#include "sensors/display/seed_signal.h"
#include "session/products/frame_table.h"
#include "session/records/frame_metadata.h"
#include "tests/comma_locale.h"
#include "tests/scenes/built_scene.h"

using namespace fanbeam;

TEST_CASE("A plan view north up turns with an antenna that is mounted askance", "[products]") {
  for (const bool stabilised : {true, false}) {
    INFO(stabilised);
    const tests::TemporaryFolder folder;
    const auto scene = tests::good_scene(
        folder, tests::standing() +
                    "heading_deg = 20.0\n\n[sensor]\nyaw_deg = 30.0\nstabilised = " +
                    (stabilised ? "true\n" : "false\n"));
    const sensors::Sensor& sensor = scene->description.sensor;
    const int columns = sensor.scan.columns;
    renderer::Frame frame;
    frame.bscope_grey.assign(static_cast<std::size_t>(columns * sensor.range.cells), 0.0);
    for (std::size_t i = 0; i < frame.bscope_grey.size(); ++i)
      if (std::abs(static_cast<int>(i) % columns - columns / 2) < 2) frame.bscope_grey[i] = 200.0;
    session::FrameRecord record;
    record.pose = scene->trajectory->at(0.0);
    const session::ProductSet products = {"ppi_north"};
    session::FrameOutput output =
        session::frame_output(*scene, {products, "0123"}, std::move(frame), record);
    CHECK(core::degrees(output.antenna_heading_rad) == Approx(50.0).epsilon(0.0).margin(0.01));

    std::filesystem::create_directories(folder.path() / "ppi_north");
    session::FrameWriter writer(folder.path(), products, sensor);
    writer.push(std::move(output));
    writer.finish();
    const core::Image image = core::read_image(session::frame_path(folder.path(), "ppi_north", 0));
    int left = image.columns, right = -1, top = image.rows, bottom = -1;
    for (int row = 0; row < image.rows; ++row)
      for (int column = 0; column < image.columns; ++column) {
        if (image.layers.at(0).values[static_cast<std::size_t>(row * image.columns + column)] < 100)
          continue;
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    REQUIRE(right > left);
    CHECK(core::degrees(std::atan2(right - left, bottom - top)) ==
          Approx(50.0).epsilon(0.0).margin(2.0));
  }
}

TEST_CASE("Metadata tell the grey window that pictures are drawn with, of the seed's mapping too",
          "[products]") {
  const tests::TemporaryFolder folder;
  const auto scene =
      tests::good_scene(folder, tests::standing() + "\n[sensor]\nfile = \"hivision-seed.toml\"\n");
  session::FrameRecord record;
  record.pose = scene->trajectory->at(0.0);
  const core::Metadata metadata = session::frame_metadata(*scene, {}, record, "0123");
  const auto told = [&](const std::string& name) {
    const auto found = std::find_if(metadata.begin(), metadata.end(),
                                    [&](const auto& entry) { return entry.first == name; });
    return found == metadata.end() ? std::string() : found->second;
  };
  const sensors::SignalLimits limits = sensors::seed_signal_limits(scene->description.sensor);
  CHECK(told("fanbeam:display_mapping") == "seed");
  CHECK(told("fanbeam:display_dB") == core::number_text(10.0 * std::log10(limits.minimum_W)) +
                                          " to " +
                                          core::number_text(10.0 * std::log10(limits.maximum_W)));
}

TEST_CASE("F18 what a picture says of its error is read back under a decimal comma", "[products]") {
  const tests::CommaLocale comma;
  if (!comma.made()) return;
  const tests::TemporaryFolder folder;
  const auto scene = tests::good_scene(folder, tests::standing());
  session::FrameRecord record;
  record.pose = scene->trajectory->at(0.0);
  record.rays = 1234;
  record.events = {"empty_view", "outside_volume"};
  std::filesystem::create_directories(folder.path() / "power");
  for (const bool reached : {true, false}) {
    INFO(reached);
    record.error = renderer::ErrorEstimate{0.75, 1.25, 3, reached};
    core::write_exr(session::frame_path(folder.path(), "power", 0), {1, 1, {{"power_W", {0.0}}}},
                    session::frame_metadata(*scene, {}, record, "0123"));
    const tests::HeldCommaLocale held(comma);
    session::FrameRecord again;
    REQUIRE(session::take_over(folder.path(), {"power"}, "0123", again));
    CHECK(again.rays == 1234);
    CHECK(again.events == record.events);
    REQUIRE(again.error);
    CHECK(again.error->rms_grey == 0.75);
    CHECK(again.error->cscope_rms_grey == 1.25);
    CHECK(again.error->levels == 3);
    CHECK(again.error->reached == reached);
  }
}

// Only its head was looked at, and a number there that is none ended --resume with an internal error.
TEST_CASE("A table that was damaged or cut off is not taken over", "[products][resume]") {
  const tests::TemporaryFolder folder;
  const auto scene = tests::good_scene(folder, tests::standing());
  session::FrameRecord record;
  record.pose = scene->trajectory->at(0.0);
  record.rays = 1234;
  const std::filesystem::path file = session::frame_table_path(folder.path(), "obstacles", 0);
  std::filesystem::create_directories(file.parent_path());
  const std::string head =
      session::table_head("obstacles", session::frame_metadata(*scene, {}, record, "0123"));
  const std::string whole = head + "range_m,height_m\n2084.28,8.09\n2100.00,\n";
  const auto taken = [&](const std::string& text) {
    core::write_file_atomically(file, text);
    session::FrameRecord again;
    const bool took = session::take_over(folder.path(), {"obstacles"}, "0123", again);
    CHECK((!took || again.rays == 1234));
    return took;
  };
  CHECK(taken(whole));
  CHECK(taken(head + "range_m,height_m\n"));              // nothing stands there
  CHECK_FALSE(taken(head));                               // the names are gone
  CHECK_FALSE(taken(whole.substr(0, whole.size() - 1)));  // cut within the last row's end
  CHECK_FALSE(taken(whole.substr(0, whole.rfind("00.00")) + "\n"));  // a field is missing
  for (const char* rays : {"99999999999999999999999", "-1", "12x", ""}) {
    INFO(rays);
    CHECK_FALSE(
        taken(tests::replaced(whole, "fanbeam:rays 1234", std::string("fanbeam:rays ") + rays)));
  }
}
