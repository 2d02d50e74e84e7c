#include "session/signal/tracks/track_plots.h"

#include <cstdint>
#include <system_error>
#include <utility>

#include "core/errors.h"
#include "core/json_node.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

}  // namespace

TrackPlots::TrackPlots(fs::path folder) : folder_(std::move(folder)) {
  constexpr std::uint64_t kLargest_bytes = 1ULL << 30U;
  constexpr core::JsonLimits kLimits{64, 20'000'000};
  constexpr std::size_t kMostPlots = 1'000'000;
  const fs::path record = folder_ / "run.json";
  std::error_code status;
  if (!fs::is_regular_file(record, status)) return;
  core::ProblemList ignored;
  const auto file = core::read_json_file(record, kLargest_bytes, kLimits, ignored);
  if (!file) return;
  for (std::string& name : core::JsonNode(*file, ignored).member("plots").texts(kMostPlots))
    files_.insert(std::move(name));
}

void TrackPlots::remove_earlier(const std::string& name) {
  std::error_code ignored;
  for (const char* ending : kPlotEndings)
    if (files_.erase(name + ending) > 0) fs::remove(folder_ / (name + ending), ignored);
}

void TrackPlots::draw(const Plot& plot, const std::string& name) {
  write_plots(plot, folder_ / name);
  for (const char* ending : kPlotEndings) files_.insert(name + ending);
}

}  // namespace fanbeam::session
