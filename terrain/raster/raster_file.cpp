#include "terrain/raster/raster_file.h"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "core/files.h"
#include "terrain/crs_definition.h"
#include "terrain/raster/gdal_messages.h"

namespace fanbeam::terrain {
namespace {

constexpr std::array<const char*, 5> kDrivers = {"GTiff", "DTED", "SRTMHGT", "AAIGrid", nullptr};
constexpr std::uint64_t kLargestSideText_bytes = 1 << 20;

bool is_metre(const std::string& unit) {
  constexpr std::array<const char*, 6> kMetres = {"", "m", "metre", "metres", "meter", "meters"};
  return std::any_of(kMetres.begin(), kMetres.end(),
                     [&](const char* metre) { return EQUAL(unit.c_str(), metre); });
}

class BandReader {
 public:
  explicit BandReader(const std::filesystem::path& path) : file_(path.string()) {
    check_readable();
    check_side_files();
    dataset_.reset(GDALDataset::Open(file_.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                     kDrivers.data(), nullptr, nullptr));
    if (!dataset_)
      refuse(core::ErrorClass::parse, "raster",
             messages_.first_error_or("a file of another format"),
             "GeoTIFF, DTED, SRTM .hgt or ESRI ASCII grid");
  }

  RasterBand read() {
    check_shape();
    GDALRasterBand& band = *dataset_->GetRasterBand(1);
    check_kind(band);
    RasterBand result{dataset_->GetRasterXSize(), dataset_->GetRasterYSize(), {}, make_map()};
    result.samples = read_samples(band);
    return result;
  }

  RasterFacts facts() const;

 private:
  [[noreturn]] void refuse(core::ErrorClass error_class, const char* field,
                           const std::string& value, const char* expected) const {
    core::throw_input_error(error_class, core::Place{file_}, field, value, expected);
  }

  void check_readable() const;
  void check_side_files() const;
  void check_side_text(const std::filesystem::path& path) const;
  void check_mask_file(const std::filesystem::path& path) const;
  void check_shape() const;
  void check_size(GDALRasterBand& band) const;
  void check_kind(GDALRasterBand& band) const;
  std::string unit_of(GDALRasterBand& band) const;
  PixelMap make_map() const;
  std::vector<float> read_samples(GDALRasterBand& band) const;
  std::vector<std::uint8_t> read_mask(GDALRasterBand& band) const;

  std::string file_;
  GdalMessages messages_;
  GDALDatasetUniquePtr dataset_;
};

// Also keeps names that GDAL alone would understand ("/vsicurl/...") away from it.
void BandReader::check_readable() const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file_, error) || !std::ifstream(file_).good())
    refuse(core::ErrorClass::io, "raster", "no such file, or not readable", "a readable file");
}

// GDAL reads "dem.prj", "dem.tif.aux.xml" and "dem.tif.msk" beside "dem.tif" unasked, wherever links lead
// it, whole, and opens what they name.
void BandReader::check_side_files() const {
  namespace fs = std::filesystem;
  const fs::path path = fs::absolute(file_);
  const fs::path folder = path.parent_path();
  const std::string start = path.stem().string() + ".";
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name == path.filename()) continue;  // may be a link, where its caller lets it
    const bool is_mask = EQUAL(name.c_str(), (path.filename().string() + ".msk").c_str());
    if (!is_mask && !name.starts_with(start)) continue;
    if (!core::lies_inside(folder, entry.path()))
      refuse(core::ErrorClass::path, "side file", name,
             "files beside the raster that are no links out of its folder");
    const CPLString small = CPLString(name).tolower();  // GDAL takes "dem.PRJ" as well
    if (small.ends_with(".prj") || small.ends_with(".aux.xml")) check_side_text(entry.path());
    if (is_mask) check_mask_file(entry.path());
  }
}

void BandReader::check_side_text(const std::filesystem::path& path) const {
  const std::string text = core::read_file(path, kLargestSideText_bytes);
  // XML may write letters as numbers, which nobody needs here.
  if (names_files(text) || text.find("&#") != std::string::npos)
    refuse(core::ErrorClass::path, "side file", path.filename().string(),
           "a coordinate reference system that names no files");
}

// GDAL takes a mask of any format, also one that names files; all writers make a TIFF.
void BandReader::check_mask_file(const std::filesystem::path& path) const {
  std::error_code error;
  char start[4] = {};
  if (std::filesystem::is_regular_file(path, error))
    std::ifstream(path, std::ios::binary).read(start, sizeof(start));
  const std::string_view order(start, 2);
  if ((order != "II" || start[3] != 0) && (order != "MM" || start[2] != 0))
    refuse(core::ErrorClass::path, "side file", path.filename().string(), "a mask that is a TIFF");
}

void BandReader::check_shape() const {
  if (dataset_->GetRasterCount() != 1)
    refuse(core::ErrorClass::unsupported, "bands", std::to_string(dataset_->GetRasterCount()),
           "one band");
  check_size(*dataset_->GetRasterBand(1));
}

void BandReader::check_size(GDALRasterBand& band) const {
  const std::int64_t width = band.GetXSize();
  const std::int64_t height = band.GetYSize();
  int block_width = 0;
  int block_height = 0;
  band.GetBlockSize(&block_width, &block_height);
  const std::int64_t block = static_cast<std::int64_t>(block_width) * block_height;
  if (width * height > kMostSamples || block > kMostSamples)
    refuse(core::ErrorClass::limit, "size",
           std::to_string(width) + " x " + std::to_string(height) + " in blocks of " +
               std::to_string(block_width) + " x " + std::to_string(block_height),
           "at most 100 million samples");
}

void BandReader::check_kind(GDALRasterBand& band) const {
  if (GDALDataTypeIsComplex(band.GetRasterDataType()))
    refuse(core::ErrorClass::unsupported, "sample type",
           GDALGetDataTypeName(band.GetRasterDataType()), "real numbers");
  const std::string unit = unit_of(band);
  if (!is_metre(unit)) refuse(core::ErrorClass::unsupported, "unit", unit, "metres");
  // Blocks that a writer never wrote read as zeros unless the file says what stands for "no value".
  int has_nodata = 0;
  band.GetNoDataValue(&has_nodata);
  const int coverage =
      band.GetDataCoverageStatus(0, 0, band.GetXSize(), band.GetYSize(), 0, nullptr);
  if (has_nodata == 0 && (coverage & GDAL_DATA_COVERAGE_STATUS_EMPTY) != 0)
    refuse(core::ErrorClass::parse, "samples", "blocks that were never written", "a complete file");
}

// Of the heights, empty where nothing tells it. GDAL gives bands of a GeoTIFF the unit of its system; those
// of an ESRI grid get none, neither from its system nor from the "Zunits" of an older .prj.
std::string BandReader::unit_of(GDALRasterBand& band) const {
  const std::string own = band.GetUnitType();
  if (!own.empty()) return own;
  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  const char* name = nullptr;
  if (crs != nullptr && crs->IsCompound() != 0 &&
      std::abs(crs->GetTargetLinearUnits("COMPD_CS|VERT_CS", &name) - 1.0) > 1e-9)
    return name;
  const CPLStringList files(dataset_->GetFileList());
  for (int i = 0; i < files.size(); ++i) {
    if (!EQUAL(CPLGetExtension(files[i]), "prj")) continue;
    std::istringstream words(core::read_file(files[i], kLargestSideText_bytes));
    for (std::string word; words >> word;)
      if (EQUAL(word.c_str(), "Zunits") && words >> word && !EQUAL(word.c_str(), "no")) return word;
  }
  return "";
}

PixelMap BandReader::make_map() const {
  std::array<double, 6> geotransform{};
  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  const bool has_geotransform = dataset_->GetGeoTransform(geotransform.data()) == CE_None;
  const bool has_crs = crs != nullptr && !crs->IsEmpty();
  if (!has_geotransform)
    refuse(core::ErrorClass::ref, "georeference", "no geotransform",
           has_crs ? "a geotransform" : "a geotransform and a coordinate reference system");
  if (!has_crs) {
    // An ESRI ASCII grid has no place for one in itself.
    const bool is_grid = EQUAL(dataset_->GetDriver()->GetDescription(), "AAIGrid");
    refuse(core::ErrorClass::ref, "georeference", "no coordinate reference system",
           is_grid ? "one in a .prj file beside the grid, of its name" : "one in the file");
  }
  char* text = nullptr;
  crs->exportToWkt(&text);
  const std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  return {geotransform, wkt, dataset_->GetRasterXSize(), dataset_->GetRasterYSize(), file_};
}

std::vector<float> BandReader::read_samples(GDALRasterBand& band) const {
  const int width = band.GetXSize();
  const int height = band.GetYSize();
  std::vector<float> samples(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const CPLErr status = band.RasterIO(GF_Read, 0, 0, width, height, samples.data(), width, height,
                                      GDT_Float32, 0, 0, nullptr);
  if (status != CE_None || messages_.has_errors())
    refuse(core::ErrorClass::parse, "samples", messages_.first_error_or("unreadable"),
           "a complete file");

  const std::vector<std::uint8_t> mask = read_mask(band);
  int has_nodata = 0;
  const auto nodata = static_cast<float>(band.GetNoDataValue(&has_nodata));
  const double scale = band.GetScale();
  const double offset = band.GetOffset();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    float& sample = samples[i];
    const bool masked = !mask.empty() && mask[i] == 0;
    if (masked || (has_nodata != 0 && sample == nodata) || !std::isfinite(sample)) {
      sample = std::numeric_limits<float>::quiet_NaN();
    } else {
      sample = static_cast<float>(offset + scale * static_cast<double>(sample));
    }
  }
  return samples;
}

// By sample, 0 where the file says that there is no value; empty where it has no mask but what its
// nodata value makes.
std::vector<std::uint8_t> BandReader::read_mask(GDALRasterBand& band) const {
  const int flags = band.GetMaskFlags();
  if (messages_.has_errors())
    refuse(core::ErrorClass::parse, "mask", messages_.first_error_or(""), "a complete file");
  if (flags == GMF_NODATA || (flags & GMF_ALL_VALID) != 0) return {};
  GDALRasterBand& mask = *band.GetMaskBand();
  const int width = band.GetXSize(), height = band.GetYSize();
  if (mask.GetXSize() != width || mask.GetYSize() != height)
    refuse(core::ErrorClass::parse, "mask",
           std::to_string(mask.GetXSize()) + " x " + std::to_string(mask.GetYSize()),
           "the raster's size");
  check_size(mask);
  std::vector<std::uint8_t> values(static_cast<std::size_t>(width) *
                                   static_cast<std::size_t>(height));
  const CPLErr status = mask.RasterIO(GF_Read, 0, 0, width, height, values.data(), width, height,
                                      GDT_Byte, 0, 0, nullptr);
  if (status != CE_None || messages_.has_errors())
    refuse(core::ErrorClass::parse, "mask", messages_.first_error_or("unreadable"),
           "a complete file");
  return values;
}

RasterFacts BandReader::facts() const {
  RasterFacts facts;
  facts.format = dataset_->GetDriver()->GetDescription();
  const CPLStringList files(dataset_->GetFileList());
  for (int i = 0; i < files.size(); ++i) facts.files.emplace_back(files[i]);
  const OGRSpatialReference* crs = dataset_->GetSpatialRef();
  if (facts.format == "SRTMHGT" || facts.format == "DTED") {
    facts.heights = RasterFacts::Heights::gravity;
    facts.heights_name = "EGM96";
  } else if (crs != nullptr && crs->IsCompound() != 0) {
    const char* name = crs->GetAttrValue("COMPD_CS|VERT_CS");
    facts.heights_name = name != nullptr ? name : "";
    // Type 2002 of WKT 1, and how GeoTIFF names heights over an ellipsoid.
    const char* type = crs->GetAttrValue("VERT_DATUM", 1);
    const bool ellipsoidal = (type != nullptr && std::string_view(type) == "2002") ||
                             facts.heights_name.find("llipsoid") != std::string::npos;
    facts.heights = ellipsoidal ? RasterFacts::Heights::ellipsoid : RasterFacts::Heights::gravity;
  } else if (crs != nullptr && crs->IsGeographic() != 0 && crs->GetAxesCount() == 3) {
    facts.heights = RasterFacts::Heights::ellipsoid;
    facts.heights_name = crs->GetName();
  }
  return facts;
}

}  // namespace

RasterFacts read_raster_facts(const std::filesystem::path& path) {
  // GDAL keeps the vertical part of older GeoTIFFs to itself otherwise.
  const CPLConfigOptionSetter whole_system("GTIFF_REPORT_COMPD_CS", "YES", false);
  return BandReader(path).facts();
}

RasterBand read_raster_band(const std::filesystem::path& path) { return BandReader(path).read(); }

}  // namespace fanbeam::terrain
