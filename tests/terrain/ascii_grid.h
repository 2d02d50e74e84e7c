// Writes small ESRI ASCII grids for tests, in a folder that goes away with the object.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

namespace fanbeam::tests {

inline constexpr const char* kWgs84Wkt =
    "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
    "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
inline constexpr const char* kUtm32NorthWkt =
    "PROJCS[\"WGS 84 / UTM zone 32N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\","
    "SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
    "UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
    "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],"
    "PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],"
    "PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "fanbeam_test_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// Posts are pixel middles: the first at (west + cell / 2, south + (rows - 0.5) cell).
struct AsciiGrid {
  int columns = 0;
  int rows = 0;
  double west = 0.0;
  double south = 0.0;
  double cell = 0.0;
  std::string nodata = "-9999";
  std::string wkt = kWgs84Wkt;

  double post_x(int column) const { return west + (column + 0.5) * cell; }
  double post_y(int row) const { return south + (rows - row - 0.5) * cell; }

  // `value` gets column and row, row 0 in the north, and answers with the text of the sample.
  std::filesystem::path write(const TemporaryFolder& folder, const std::string& name,
                              const std::function<std::string(int, int)>& value) const {
    std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                       "\nxllcorner " + std::to_string(west) + "\nyllcorner " +
                       std::to_string(south) + "\ncellsize " + std::to_string(cell) +
                       "\nNODATA_value " + nodata + "\n";
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) text += value(column, row) + " ";
      text += "\n";
    }
    if (!wkt.empty()) folder.write(name + ".prj", wkt);
    return folder.write(name + ".asc", text);
  }
};

}  // namespace fanbeam::tests
