// Tables of loss and echo for other programs to read.
#pragma once

#include <string>
#include <vector>

#include "atmosphere/loss_table.h"

namespace fanbeam::atmosphere {

// A line of column names, then one for each range of each frequency. The equivalent sigma0 of no echo is empty.
std::string loss_csv(const std::vector<AtmosphereTable>& tables);

// {"models": [{"cause", "model", "source"}], "frequencies": [{"frequency_GHz", "rain": {"k", "alpha"}, "rows"}]}: rows have
// the columns of loss_csv by their names, and no equivalent sigma0 of no echo; "rain" is there in rain of the law
// itu-p838.
std::string loss_json(const std::vector<AtmosphereTable>& tables,
                      const std::vector<AtmosphereModel>& models);

}  // namespace fanbeam::atmosphere
