#include "session/blank_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/median.h"
#include "renderer/frame_renderer.h"
#include "scenes/doctor/scene_doctor.h"
#include "sensors/display/display.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::session {
namespace {

using scenes::Finding;
using scenes::Severity;
using sensors::Display;

// A picture by its levels in dB of the display's mapping, -infinity without power.
struct Picture {
  std::string name;
  std::vector<double> shown_dB;  // with the mean noise
  std::vector<double> noise_dB;  // the noise alone
};

std::vector<double> bscope_levels_dB(const sensors::Sensor& sensor,
                                     const std::vector<double>& power_W, double noise_W) {
  const sensors::GreyScale scale(sensor);
  std::vector<double> levels_dB(power_W.size());
  const auto width = static_cast<std::size_t>(sensor.scan.columns);
  for (std::size_t i = 0; i < power_W.size(); ++i)
    levels_dB[i] = scale.level_dB(power_W[i] + noise_W, static_cast<int>(i / width));
  return levels_dB;
}

std::vector<double> cscope_levels_dB(const sensors::Sensor& sensor,
                                     const std::vector<double>& compensated_W_m3,
                                     double noise_W_m3) {
  const sensors::GreyScale scale(sensor);
  std::vector<double> levels_dB(compensated_W_m3.size());
  std::transform(compensated_W_m3.begin(), compensated_W_m3.end(), levels_dB.begin(),
                 [&](double sum_W_m3) { return scale.cscope_level_dB(sum_W_m3 + noise_W_m3); });
  return levels_dB;
}

std::vector<Picture> pictures(const scenes::Scene& scene, const renderer::FramePose& pose,
                              const renderer::Frame& frame, bool noisy) {
  const sensors::Sensor& sensor = scene.world.sensor;
  const double noise_W = noisy ? sensor.noise_power_W() : 0.0;
  const std::vector<double> nothing_W(frame.bscope_W.size(), 0.0);
  std::vector<Picture> all;
  all.push_back({"B-scope", bscope_levels_dB(sensor, frame.bscope_W, noise_W),
                 bscope_levels_dB(sensor, nothing_W, noise_W)});
  if (sensor.display.cscope_mode == Display::CScopeMode::true_elevation) {
    const double noise_W_m3 = noisy ? sensors::cscope_noise_W_m3(sensor) : 0.0;
    all.push_back(
        {"C-scope", cscope_levels_dB(sensor, frame.cscope_W_m3, noise_W_m3),
         cscope_levels_dB(sensor, std::vector<double>(frame.cscope_W_m3.size()), noise_W_m3)});
  } else {  // drawn from the B-scope with its noise
    const double height_m =
        scene.world.surfaces().height_above_ground_m(renderer::antenna_of(sensor, pose).position_m);
    if (!(height_m > 0.0)) return all;  // no ground below, nothing drawn
    const std::vector<double> noise_W_m3 = sensors::flat_earth_cscope_W_m3(
        sensor, std::vector<double>(frame.bscope_W.size(), noise_W), height_m);
    all.push_back({"C-scope", cscope_levels_dB(sensor, frame.cscope_W_m3, 0.0),
                   cscope_levels_dB(sensor, noise_W_m3, 0.0)});
  }
  return all;
}

struct Look {
  bool like_noise = false;
  bool one_grey = false;
  double darkest_grey = 0.0, brightest_grey = 0.0;  // of one_grey
  double alike = 0.0;                               // share of the pixels that are
};

Look look_at(const sensors::Sensor& sensor, const Picture& picture) {
  const sensors::GreyScale scale(sensor);
  const std::size_t most = picture.shown_dB.size() / kShowing;  // pixels that may stand out
  std::size_t apart = 0;
  std::vector<double> greys;
  for (std::size_t i = 0; i < picture.shown_dB.size(); ++i) {
    greys.push_back(scale.grey_of_level(picture.shown_dB[i]));
    if (std::abs(greys.back() - scale.grey_of_level(picture.noise_dB[i])) > kContrast_grey) ++apart;
  }
  const auto pixels = static_cast<double>(greys.size());
  Look look{.like_noise = apart <= most};
  look.alike = 1.0 - static_cast<double>(apart) / pixels;
  // The narrowest band of greys that holds all pixels but `most`.
  std::sort(greys.begin(), greys.end());
  double narrowest_grey = 256.0;
  for (std::size_t left = 0; left <= most; ++left) {
    const double darkest = greys[left];
    const double brightest = greys[greys.size() - 1 - (most - left)];
    if (brightest - darkest >= narrowest_grey) continue;
    narrowest_grey = brightest - darkest;
    look.darkest_grey = darkest;
    look.brightest_grey = brightest;
  }
  look.one_grey = narrowest_grey <= 2.0 * kContrast_grey;
  if (look.one_grey) {
    const auto in_band = std::upper_bound(greys.begin(), greys.end(), look.brightest_grey) -
                         std::lower_bound(greys.begin(), greys.end(), look.darkest_grey);
    look.alike = static_cast<double>(in_band) / pixels;
  }
  return look;
}

std::string what_is_seen(const Picture& picture, const Look& look) {
  if (!look.one_grey) return "the " + picture.name + " shows nothing but noise";
  const auto whole = [](double grey) { return static_cast<int>(sensors::grey8(grey)); };
  const int darkest = whole(look.darkest_grey), brightest = whole(look.brightest_grey);
  const std::string name = brightest <= kContrast_grey         ? "black"
                           : darkest >= 255.0 - kContrast_grey ? "white"
                                                               : "one grey";
  return fmt::format("the {} is {}: nearly all pixels are {}", picture.name, name,
                     darkest == brightest ? fmt::format("{}", darkest)
                                          : fmt::format("{} to {}", darkest, brightest));
}

constexpr double kUsualWindow_dB = 60.0;

std::string window_for(double noise_dB, double strongest_dB) {
  const double high_dB = std::ceil(strongest_dB);
  const double low_dB = std::isfinite(noise_dB) ? std::min(std::floor(noise_dB), high_dB - 10.0)
                                                : high_dB - kUsualWindow_dB;
  return fmt::format("low_dB = {:.0f} and high_dB = {:.0f}", low_dB, high_dB);
}

// Why, and what to do. Powers below a tenth of the noise do not show in any window.
std::pair<std::string, std::string> cause(const sensors::Sensor& sensor, const Picture& picture,
                                          bool nothing_met) {
  if (nothing_met)
    return {"Nothing lies in the field of view and the window of range.",
            "Look at position, heading and height of the flight, and at the sensor's range and "
            "angles; what follows of the flight may show more."};
  double strongest_dB = picture.shown_dB.front();
  double over_noise_dB = 0.0;
  for (std::size_t i = 0; i < picture.shown_dB.size(); ++i) {
    strongest_dB = std::max(strongest_dB, picture.shown_dB[i]);
    if (std::isfinite(picture.shown_dB[i]))
      over_noise_dB = std::max(over_noise_dB, picture.shown_dB[i] - picture.noise_dB[i]);
  }
  if (over_noise_dB < 0.4)
    return {fmt::format("The strongest pixel is {:.1g} dB above the noise: the echoes drown.",
                        over_noise_dB),
            "No window can show them: take more power, gain or dwell, less noise or weather, or go "
            "nearer."};
  const double noise_dB = core::median(picture.noise_dB);
  const sensors::GreyScale scale(sensor);
  const std::string noise =
      std::isfinite(noise_dB) ? fmt::format(", the noise at {:.1f} dB", noise_dB) : "";
  return {fmt::format("The strongest pixel is at {:.1f} dB{}; the display shows {:.1f} to {:.1f} "
                      "dB.",
                      strongest_dB, noise, scale.low_dB(), scale.high_dB()),
          sensor.display.mapping == Display::Mapping::seed
              ? "The window of \"seed\" is fixed: take [display] mapping = \"stc\" or \"log\"."
              : "Try [display] " + window_for(noise_dB, strongest_dB) + "."};
}

}  // namespace

void add_blank_pictures(const scenes::Scene& scene, scenes::Findings& findings) {
  if (scene.frame_count() == 0) return;
  const sensors::Sensor& sensor = scene.world.sensor;
  const renderer::Effects effects = renderer::without_draws(renderer::effects_of(scene.plan, 0));
  const auto kind = scene.caster.chosen;
  const renderer::FrameRenderer frames(scene.world, renderer::default_sampling(kind),
                                       {.bscope = true, .cscope = true}, effects);
  const int middle = scene.frame_count() / 2;
  const renderer::FramePose pose = scene.frame_pose(middle);
  const renderer::Frame frame = frames.render(pose);
  const auto happened = [&](const char* event) {
    return std::find(frame.events.begin(), frame.events.end(), event) != frame.events.end();
  };
  if (happened("below_terrain")) return;
  const bool noisy = effects.runs(core::EffectId::thermal_noise);
  for (const Picture& picture : pictures(scene, pose, frame, noisy)) {
    const Look look = look_at(sensor, picture);
    if (!look.like_noise && !look.one_grey) continue;
    const auto [why, remedy] = cause(sensor, picture, happened("empty_view"));
    scenes::add_in_order(findings, {Severity::wrong, "blank-picture", what_is_seen(picture, look),
                                    fmt::format("frame {}, the middle one", middle),
                                    100.0 * look.alike, "%", why, remedy});
  }
}

}  // namespace fanbeam::session
