#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/common.h"
#include "apps/option_kinds.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {

// No refinement reaches 0, and past 100 of 255 levels there is no picture left to speak of.
CLI::Option* add_accuracy_option(CLI::App& command, double& accuracy_grey,
                                 const std::string& what) {
  return add_number(command, "--accuracy", accuracy_grey, renderer::kAccuracies_grey, what);
}

void add_caster_option(CLI::App& command, std::string& caster, const std::string& what) {
  const auto& wishes = renderer::kCasterWishes;
  add_word(command, "--caster", caster, std::vector<std::string>(wishes.begin(), wishes.end()),
           what);
}

void add_output_option(CLI::App& command, std::string& folder, const std::string& what) {
  add_folder(command, "-o,--output", folder, what);
}

CLI::Option* add_frames_option(CLI::App& command, std::string& frames, const std::string& what) {
  return command.add_option("--frames", frames, what)->type_name(kFramesValue);
}

void add_data_option(CLI::App& command, std::string& folder, const std::string& order) {
  add_folder(command, "--data", folder, "Folder with terrain and flight data, " + order);
}

void add_seed_option(CLI::App& command, std::uint64_t& seed) {
  add_whole_number(command, "--seed", seed, {0, UINT64_MAX}, "Seed of everything random")
      ->capture_default_str();
}

void add_threads_option(CLI::App& command, int& threads) {
  add_whole_number(command, "--threads", threads, {0, 1024}, "Threads to use (default: all cores)");
}

}  // namespace fanbeam::apps
