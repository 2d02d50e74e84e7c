// A scene for each airport of a campaign, made from public data as `fanbeam init` makes one.
#pragma once

#include <filesystem>
#include <vector>

#include "datasets/campaign.h"

namespace fanbeam::datasets {

// Writes DIR/scenes/NAME/scene.toml below `output`, unless it is there with these bytes already, and answers
// its folder. The airport's files are looked for beside the campaign's file, then in `data_folders`; the
// scene names them by their place there. A pure function of the campaign's file and of theirs. Throws
// InputError as scenes::make_new_scene; E-IO for a file that is nowhere.
std::filesystem::path airport_scene(const Campaign& campaign, const CampaignAirport& airport,
                                    const std::filesystem::path& output,
                                    const std::vector<std::filesystem::path>& data_folders);

}  // namespace fanbeam::datasets
