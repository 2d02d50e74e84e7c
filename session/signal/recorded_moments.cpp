#include "session/signal/recorded_moments.h"

#include <map>
#include <system_error>

#include "core/json_node.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

// What the run.json of a folder that `fanbeam fmcw` wrote says of its files, by name relative to it.
std::map<std::string, RecordedMoment> moments_in(const core::JsonNode& record) {
  constexpr core::NumberRange kMoments_s{-1e12, 1e12};
  std::map<std::string, RecordedMoment> known;
  const core::JsonNode frames = record.member("frames");
  for (std::size_t i = 0; i < frames.elements(); ++i) {
    const core::JsonNode frame = frames.element(i);
    const auto time_s = frame.member("time_s").number(kMoments_s);
    if (!time_s) continue;
    const RadarVelocity_mps velocity_mps = radar_velocity_in(frame).value_or(RadarVelocity_mps{});
    for (const std::string& name : frame.member("files").texts(1000))
      known[name] = {*time_s, velocity_mps};
  }
  return known;
}

}  // namespace

std::vector<RecordedMoment> recorded_moments(const std::vector<fs::path>& files,
                                             const std::string& instead,
                                             core::ProblemList& warnings) {
  const fs::path own = fs::absolute(files.front()).lexically_normal().parent_path();
  const fs::path record = own.parent_path() / "run.json";
  std::error_code status;
  if (!fs::is_regular_file(record, status)) return {};
  const auto refused = [&](const std::string& why) {
    warnings.warning("TIMES", {record.string()}, "frames", why, instead);
    return std::vector<RecordedMoment>();
  };
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  core::ProblemList problems;
  const auto file = core::read_json_file(record, 256ULL << 20U, kLimits, problems);
  if (!file) return refused("cannot be read: " + problems.all().front().value);
  const auto known = moments_in(core::JsonNode(*file, problems));
  std::vector<RecordedMoment> moments;
  if (known.empty()) return moments;  // another program's
  for (const fs::path& one : files) {
    const auto found = known.find((own.filename() / one.filename()).generic_string());
    if (found == known.end() || !(moments.empty() || found->second.time_s > moments.back().time_s))
      return refused("no later time of " + one.filename().string());
    moments.push_back(found->second);
  }
  return moments;
}

}  // namespace fanbeam::session
