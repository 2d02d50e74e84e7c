// Noise, threshold and minimum detectable signal of a sensor file.
#include "sensors/receiver/receiver_figures.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "sensors/receiver/detection.h"
#include "tests/sensors/shipped_sensor.h"

using namespace fanbeam;

TEST_CASE("HiVision's noise, threshold and minimum detectable signal", "[receiver]") {
  const sensors::ReceiverFigures figures = sensors::receiver_figures(tests::hivision());
  // k 290 K times 6 dB times 16 Hz x 164 columns.
  CHECK(figures.noise_W == Approx(1.380649e-23 * 290.0 * 3.98107171 * 2624.0).epsilon(1e-8));
  CHECK(figures.threshold_W / figures.noise_W == Approx(6.0 * std::log(10.0)).epsilon(1e-12));
  CHECK(10.0 * std::log10(figures.detectable_steady_W / figures.noise_W) ==
        Approx(13.183).epsilon(0.0).margin(5e-4));
  CHECK(10.0 * std::log10(figures.detectable_swerling1_W / figures.noise_W) ==
        Approx(21.14).epsilon(0.0).margin(5e-3));
  CHECK(figures.false_alarms_per_frame == Approx(164 * 524 * 1e-6));
}

TEST_CASE("Looks share a column's time: each is noisier, and integration wins back most of it",
          "[receiver]") {
  const sensors::Sensor one = tests::hivision();
  const auto with_looks = [](const std::string& looks) {
    core::ProblemList problems;
    const sensors::Sensor sensor = sensors::read_sensor_text(
        tests::hivision_text("looks = 1\n", "looks = " + looks + "\n"), "test.toml", problems);
    CHECK_FALSE(problems.has_errors());
    return sensor;
  };
  const sensors::Sensor four = with_looks("4");
  CHECK(four.receiver.looks == 4);
  CHECK(four.noise_power_W() == Approx(4.0 * one.noise_power_W()).epsilon(1e-12));
  const double loss_dB = 10.0 * std::log10(sensors::receiver_figures(four).detectable_steady_W /
                                           sensors::receiver_figures(one).detectable_steady_W);
  CHECK(loss_dB > 0.5);  // non-coherent against coherent integration of the same energy
  CHECK(loss_dB < 1.5);

  for (const std::string looks : {"0", "1001", "1.5", "\"x\""}) {
    core::ProblemList problems;
    sensors::read_sensor_text(tests::hivision_text("looks = 1\n", "looks = " + looks + "\n"),
                              "test.toml", problems);
    INFO(looks);
    CHECK(problems.has_errors());
  }
  for (const std::string pfa : {"0.0", "1e-16", "0.11"}) {
    core::ProblemList problems;
    sensors::read_sensor_text(
        tests::hivision_text("false_alarm_probability = 1e-6", "false_alarm_probability = " + pfa),
        "test.toml", problems);
    INFO(pfa);
    CHECK(problems.has_errors());
  }
}
