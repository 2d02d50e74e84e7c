// Measured reflectivity as a text table.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "materials/nrcs/tabulated.h"

namespace fanbeam::materials {

// A CSV with a header line that names the columns grazing_deg (above 0 to 90, increasing) and
// sigma0_dB (+-300); further columns are ignored, so are blank lines and lines that begin with '#'.
// Every problem is reported with its line: E-PARSE for a missing header, column or number and for a
// table without rows, E-NONFINITE, E-RANGE. Rows with a problem are left out.
std::vector<NrcsSample> read_measurements(std::string_view text, const std::string& file_name,
                                          core::ProblemList& problems);

}  // namespace fanbeam::materials
