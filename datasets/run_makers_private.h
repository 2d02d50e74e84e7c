// What a run's record says, and what must be the same of all runs. Private: carries the JSON library.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "datasets/campaign.h"
#include "datasets/run_files.h"

namespace fanbeam::datasets {

inline constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 28U;

// Null where it is damaged.
nlohmann::ordered_json record_in(const RunFiles& files);

// Program, libraries and level of instructions.
std::string made_by(const nlohmann::ordered_json& record);
// Of most runs, which have one each; by their numbers.
std::string usual_maker(const std::map<std::string, int>& runs_of_maker);
// Empty for a run that goes with the others.
std::string wrong_maker(const nlohmann::ordered_json& record, const Campaign& campaign,
                        const std::string& usual);

}  // namespace fanbeam::datasets
