// What fanbeam plan tells as a table of at most 100 columns.
#pragma once

#include <string>

#include "measure/plan_report.h"

namespace fanbeam::apps {

// `notes`: with the lines that explain the columns.
std::string plan_table(const measure::PlanReport& report, bool notes);

}  // namespace fanbeam::apps
