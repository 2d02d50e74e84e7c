#include <CLI/CLI.hpp>

#include "apps/command_line.h"
#include "apps/common.h"
#include "apps/number_check.h"
#include "apps/value_words.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {

// No refinement reaches 0, and past 100 of 255 levels there is no picture left to speak of.
CLI::Option* add_accuracy_option(CLI::App& command, double& accuracy_grey,
                                 const std::string& what) {
  return command.add_option("--accuracy", accuracy_grey, what)
      ->check(number_from(renderer::kAccuracies_grey));
}

void add_caster_option(CLI::App& command, std::string& caster, const std::string& what) {
  const auto& wishes = renderer::kCasterWishes;
  command.add_option("--caster", caster, what)
      ->check(CLI::IsMember(std::vector<std::string>(wishes.begin(), wishes.end())));
}

void add_output_option(CLI::App& command, std::string& folder, const std::string& what) {
  command.add_option("-o,--output", folder, what)->type_name(kFolderValue);
}

CLI::Option* add_frames_option(CLI::App& command, std::string& frames, const std::string& what) {
  return command.add_option("--frames", frames, what)->type_name(kFramesValue);
}

void add_data_option(CLI::App& command, std::string& folder, const std::string& order) {
  command.add_option("--data", folder, "Folder with terrain and flight data, " + order)
      ->type_name(kFolderValue);
}

void add_seed_option(CLI::App& command, std::uint64_t& seed) {
  command.add_option("--seed", seed, "Seed of everything random")
      ->check(any_seed())
      ->capture_default_str();
}

void add_threads_option(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "Threads to use (default: all cores)")
      ->check(whole_number_from(0, 1024));
}

}  // namespace fanbeam::apps
