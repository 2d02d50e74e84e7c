#include "scenes/airport/airport_reader.h"

#include "scenes/airport/apt_dat_reader.h"
#include "scenes/airport/runway_csv_reader.h"

namespace fanbeam::scenes {

std::optional<Airport> read_airport(const std::filesystem::path& file, const std::string& ident,
                                    core::ProblemList& problems) {
  const std::string extension = file.extension().string();
  return extension == ".csv" || extension == ".CSV" ? read_runway_csv(file, ident, problems)
                                                    : read_apt_dat(file, ident, problems);
}

}  // namespace fanbeam::scenes
