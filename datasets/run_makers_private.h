// What a run's record says, and what must be the same of all runs. Private: carries the JSON library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "datasets/campaign.h"
#include "datasets/draw.h"
#include "datasets/run_files.h"

namespace fanbeam::datasets {

inline constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 28U;

// Null where it is damaged.
nlohmann::ordered_json record_in(const RunFiles& files);

// Version and commit.
bool is_of_this_program(const nlohmann::ordered_json& record);

// The scene that a run flew, as the campaign's file names it.
std::string scene_of(const Campaign& campaign, const nlohmann::ordered_json& record);

// What of a campaign's runs is there, and what made most of it: program, libraries and level of
// instructions; of what those made of this file, and of each scene, its usual input. Holds no records.
struct Survey {
  std::vector<int> whole, damaged, missing;
  std::string usual_maker;
  std::map<std::string, std::string> usual_inputs;  // by scene
};
Survey survey(const Campaign& campaign, const std::filesystem::path& output,
              const std::vector<int>& runs);

// Numbers of runs in the folder that the campaign's file does not have, rising.
std::vector<int> runs_beyond(const std::filesystem::path& campaign, int runs);
std::string beyond_text(const Campaign& campaign);

// Empty for a run whose record tells the values that the campaign's file gives it.
std::string wrong_values(const nlohmann::ordered_json& record, const Draw& draw);

// Made before the campaign's file was changed, or by another.
bool is_of_other_file(const nlohmann::ordered_json& record, const Campaign& campaign);

// Empty for a run that goes with the others.
std::string wrong_maker(const nlohmann::ordered_json& record, const Campaign& campaign,
                        const std::string& usual);
// Empty for a run of the scene, sensor and terrain that most of its scene are made of.
std::string wrong_input(const nlohmann::ordered_json& record, const Campaign& campaign,
                        const Survey& found);

}  // namespace fanbeam::datasets
