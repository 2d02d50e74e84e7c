// What `fanbeam campaign plan` prints.
#pragma once

#include "apps/campaign_command.h"
#include "datasets/campaign.h"

namespace fanbeam::apps {

int plan_campaign(const CampaignOptions& options, const CommonOptions& common,
                  const datasets::Campaign& campaign);

}  // namespace fanbeam::apps
