#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "apps/track/own_data.h"
#include "core/errors.h"
#include "core/files.h"

namespace fanbeam::apps {
namespace {

namespace fs = std::filesystem;
using Inputs = std::vector<TrackInput>;

constexpr std::uint64_t kLargest_bytes = 1ULL << 30U;

constexpr std::array<const char*, 4> kWords = {"highway scenarios", "a scene", "detections",
                                               "samples"};

struct Belongs {
  const char* option;
  Inputs inputs;
};
const Belongs kBelong[] = {
    {"--scenario", {TrackInput::scenarios}},
    {"--waveform", {TrackInput::scenarios}},
    {"--detection-probability", {TrackInput::scenarios}},
    {"--false-measurements", {TrackInput::scenarios}},
    {"--noise-figure", {TrackInput::scenarios}},
    {"--range-only", {TrackInput::scenarios}},
    {"--samples", {TrackInput::scenarios}},
    {"--study", {TrackInput::scenarios}},
    {"--run", {TrackInput::scenarios}},
    {"--seed", {TrackInput::scenarios, TrackInput::scene}},
    {"--frames", {TrackInput::scene}},
    {"--sensor", {TrackInput::scene}},
    {"--data", {TrackInput::scene}},
    {"--radar", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--radar-speed", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--body-errors", {TrackInput::scene, TrackInput::detections, TrackInput::samples}},
    {"--frame-period", {TrackInput::samples}},
};

std::string words_of(const Inputs& inputs) {
  std::string text;
  for (const TrackInput input : inputs)
    text += (text.empty() ? "" : " or ") + std::string(kWords[static_cast<std::size_t>(input)]);
  return text;
}

// What a run of `fanbeam track` leaves says one of these.
bool is_ours(const fs::path& record) {
  const nlohmann::json json = nlohmann::json::parse(core::read_file(record, kLargest_bytes),
                                                    nullptr, /*allow_exceptions=*/false);
  return json.is_object() && (json.contains("scenarios") || json.contains("confirmed_tracks"));
}

}  // namespace

void refuse_other_options(const TrackOptions& options, TrackInput input) {
  core::ProblemList problems;
  for (const Belongs& one : kBelong)
    if (options.given.contains(one.option) &&
        std::find(one.inputs.begin(), one.inputs.end(), input) == one.inputs.end())
      problems.error(
          core::ErrorClass::unsupported, {}, one.option, "given",
          words_of(one.inputs) + " as INPUT, which is " + kWords[static_cast<std::size_t>(input)]);
  problems.throw_if_errors();
}

void check_output(const fs::path& folder) {
  std::error_code status;
  const fs::path record = folder / "run.json";
  if (fs::is_regular_file(record, status) && !is_ours(record))
    core::throw_input_error(core::ErrorClass::range, "--output", "\"" + folder.string() + "\"",
                            "a folder without the record of another command (run.json)");
}

}  // namespace fanbeam::apps
