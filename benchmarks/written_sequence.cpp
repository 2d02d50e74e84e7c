#include "benchmarks/written_sequence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/scratch_folder.h"

namespace fanbeam::benchmarks {

namespace fs = std::filesystem;

std::optional<SequenceFigures> measure_sequence(const View& view, const SequenceWish& wish,
                                                int frames, int threads) {
  const std::string& name = view.scene->name;
  const fs::path program = program_beside();
  const ScratchFolder scratch;
  const int first = std::max(0, view.frame - frames / 2);
  std::string options = fmt::format("--caster {}", renderer::name_of(wish.caster));
  if (!wish.isa.empty()) options += " --isa " + wish.isa;
  const std::string command =
      fmt::format("'{}' render '{}' --quiet {} --frames {}:{} --threads {} -o '{}'",
                  program.string(), (fs::path(FANBEAM_SOURCE_DIR) / "scenes" / name).string(),
                  options, first, first + frames, threads, scratch.path().string());
  fmt::print(stderr, "{}: a sequence of {} frames to disk, {}\n", name, frames, options);
  if (!fs::exists(program) || std::system(command.c_str()) != 0) {
    fmt::print(stderr, "[skipped] sequence: no success with {}\n", command);
    return std::nullopt;
  }
  const auto record = [&](const char* file) {
    std::ifstream stream(scratch.path() / file);
    return nlohmann::json::parse(stream);
  };
  const nlohmann::json summary = record("timing.json").at("summary");
  return SequenceFigures{options,
                         wish.isa,
                         record("run.json").at("caster").at("chosen").get<std::string>(),
                         frames,
                         summary.at("frame_ms_median").get<double>(),
                         summary.at("frames_per_s_written").get<double>()};
}

}  // namespace fanbeam::benchmarks
