#include "terrain/raster/elevation_raster.h"

#include <gdal_alg.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/parallel.h"
#include "terrain/raster/gdal_messages.h"

namespace fanbeam::terrain {
namespace {

constexpr double kLowest_m = -1.0e3;
constexpr double kHighest_m = 10.0e3;
constexpr double kLargestStep_m = 100.0;
constexpr double kFillDistance_posts = 100.0;
// Each pass spreads a height by 0.5 posts^2 of variance: 64 passes bridge terraces some 11 posts
// wide, slopes down to 0.3 % for metres at 30 m.
constexpr int kSmoothingPasses = 64;

[[noreturn]] void refuse_range(const std::string& file, const std::string& field,
                               const std::string& value, const std::string& expected) {
  core::throw_input_error(core::ErrorClass::range, core::Place{file}, field, value, expected);
}

std::string post_name(std::size_t index, int width) {
  const auto columns = static_cast<std::size_t>(width);
  return "column " + std::to_string(index % columns) + ", row " + std::to_string(index / columns);
}

// A GDAL view of memory that stays ours.
GDALDatasetUniquePtr memory_view(void* samples, int width, int height, GDALDataType type) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr view(driver->Create("", width, height, 0, type, nullptr));
  std::array<char, 64> address{};
  CPLPrintPointer(address.data(), samples, static_cast<int>(address.size()) - 1);
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", address.data());
  if (view->AddBand(type, options.List()) != CE_None)
    throw core::InternalError("GDAL refused a raster in memory");
  return view;
}

void fill_voids(RasterBand& band) {
  const GdalMessages messages;
  std::vector<std::uint8_t> valid(band.samples.size());
  std::transform(band.samples.begin(), band.samples.end(), valid.begin(),
                 [](float sample) { return static_cast<std::uint8_t>(!std::isnan(sample)); });
  const auto heights = memory_view(band.samples.data(), band.width, band.height, GDT_Float32);
  const auto mask = memory_view(valid.data(), band.width, band.height, GDT_Byte);
  CPLStringList options;
  options.SetNameValue("TEMP_FILE_DRIVER", "MEM");
  const CPLErr status = GDALFillNodata(heights->GetRasterBand(1), mask->GetRasterBand(1),
                                       kFillDistance_posts, 0, 0, options.List(), nullptr, nullptr);
  if (status != CE_None)
    throw core::InternalError("filling voids: " + messages.first_error_or("GDAL failed"));
}

// The 3 x 3 binomial average around a post, whose neighbours are those of the rows above, here and
// below. A hole counts as the post itself.
float binomial_average(const float* above, const float* here, const float* below) {
  const float post = here[0];
  const auto known = [post](float sample) { return std::isnan(sample) ? post : sample; };
  float sum = known(above[-1]) + 2.0F * known(above[0]) + known(above[1]);
  sum = sum + 2.0F * known(here[-1]) + 4.0F * post + 2.0F * known(here[1]);
  sum = sum + known(below[-1]) + 2.0F * known(below[0]) + known(below[1]);
  return sum / 16.0F;
}

// The same beside an edge, beyond which posts count as this one.
float average_at_edge(const RasterBand& band, int column, int row) {
  float rows[3][3];
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int x = column + dx, y = row + dy;
      const bool inside = x >= 0 && x < band.width && y >= 0 && y < band.height;
      rows[dy + 1][dx + 1] = inside ? band.at(x, y) : band.at(column, row);
    }
  return binomial_average(rows[0] + 1, rows[1] + 1, rows[2] + 1);
}

// Repeated averages, each post held within half a step of where it began.
void smooth_within_steps(RasterBand& band, double step_m) {
  const std::vector<float> original = band.samples;
  std::vector<float> smoothed = original;
  const auto half_step_m = static_cast<float>(0.5 * step_m);
  const int last_row = band.height - 1, last_column = band.width - 1;
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    core::parallel_for(static_cast<std::size_t>(band.height), [&](std::size_t row_index) {
      const int row = static_cast<int>(row_index);
      const auto width = static_cast<std::size_t>(band.width);
      const float* const here = band.samples.data() + row_index * width;
      const float* const began = original.data() + row_index * width;
      float* const becomes = smoothed.data() + row_index * width;
      const auto hold = [&](int column, float average) {
        becomes[column] =
            std::clamp(average, began[column] - half_step_m, began[column] + half_step_m);
      };
      if (row == 0 || row == last_row) {
        for (int column = 0; column <= last_column; ++column)
          hold(column, average_at_edge(band, column, row));
        return;
      }
      hold(0, average_at_edge(band, 0, row));
      for (int column = 1; column < last_column; ++column)
        hold(column, binomial_average(here - width + column, here + column, here + width + column));
      hold(last_column, average_at_edge(band, last_column, row));
    });
    band.samples.swap(smoothed);
  }
}

std::array<double, 4> catmull_rom_weights(double t) {
  return {((-0.5 * t + 1.0) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1.0,
          ((-1.5 * t + 2.0) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
}

std::array<double, 4> b_spline_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0,
          (4.0 + 3.0 * s * s * (s - 2.0)) / 6.0, t * t * t / 6.0};
}

}  // namespace

ElevationRaster::ElevationRaster(const std::filesystem::path& file, const ElevationOptions& options)
    : band_(read_raster_band(file)), interpolation_(options.interpolation) {
  const std::string name = file.string();
  if (!(options.quantisation_step_m >= 0.0 && options.quantisation_step_m <= kLargestStep_m))
    refuse_range(name, "quantisation_step_m", core::number_text(options.quantisation_step_m),
                 "0 to 100 m");
  if (band_.width < 2 || band_.height < 2)
    refuse_range(name, "size", std::to_string(band_.width) + " x " + std::to_string(band_.height),
                 "at least 2 x 2 posts");
  treat_voids(name);
  if (options.quantisation_step_m > 0.0) smooth_within_steps(band_, options.quantisation_step_m);
  find_height_range(name);
}

void ElevationRaster::treat_voids(const std::string& file) {
  const auto is_void = [](float sample) { return std::isnan(sample); };
  std::vector<float>& samples = band_.samples;
  voids_ = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), is_void));
  if (voids_ == 0) return;
  if (voids_ == samples.size())
    refuse_range(file, "posts without height", "all " + std::to_string(voids_),
                 "at least one post with a height");
  is_void_.resize(samples.size());
  std::transform(samples.begin(), samples.end(), is_void_.begin(), is_void);
  fill_voids(band_);
  holes_ = static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), is_void));
}

void ElevationRaster::find_height_range(const std::string& file) {
  lowest_m_ = kHighest_m;
  highest_m_ = kLowest_m;
  for (std::size_t i = 0; i < band_.samples.size(); ++i) {
    const auto sample_m = static_cast<double>(band_.samples[i]);
    if (std::isnan(sample_m)) continue;
    if (sample_m < kLowest_m || sample_m > kHighest_m)
      refuse_range(file, "height_m at " + post_name(i, band_.width), core::number_text(sample_m),
                   "-1000 to 10000 m, or the value declared as the one without height");
    lowest_m_ = std::min(lowest_m_, sample_m);
    highest_m_ = std::max(highest_m_, sample_m);
  }
}

// Counted from the middle of the first post, and not beyond the outermost ones.
std::optional<PixelPosition> ElevationRaster::post_position(double latitude_rad,
                                                            double longitude_rad) const {
  const auto pixel = band_.pixel_map.pixel_at(latitude_rad, longitude_rad);
  if (!pixel) return std::nullopt;
  const double last_column = band_.width - 1;
  const double last_row = band_.height - 1;
  const double column = pixel->column - 0.5;
  const double row = pixel->row - 0.5;
  // An outermost post belongs to the raster in spite of the error of the mapping.
  if (column < -kPixelMapAccuracy || column > last_column + kPixelMapAccuracy ||
      row < -kPixelMapAccuracy || row > last_row + kPixelMapAccuracy)
    return std::nullopt;
  return PixelPosition{std::clamp(column, 0.0, last_column), std::clamp(row, 0.0, last_row)};
}

std::optional<double> ElevationRaster::height_m(double latitude_rad, double longitude_rad) const {
  const auto at = post_position(latitude_rad, longitude_rad);
  if (!at) return std::nullopt;
  double result_m = std::numeric_limits<double>::quiet_NaN();
  if (interpolation_ != Interpolation::bilinear) result_m = cubic_m(at->column, at->row);
  // A hole near by, or bilinear asked for.
  if (std::isnan(result_m)) result_m = bilinear_m(at->column, at->row);
  return std::isnan(result_m) ? std::nullopt : std::optional(result_m);
}

std::optional<ElevationRaster::Posts> ElevationRaster::posts_at(double latitude_rad,
                                                                double longitude_rad) const {
  const auto at = post_position(latitude_rad, longitude_rad);
  if (!at) return std::nullopt;
  const int around = interpolation_ == Interpolation::bilinear ? 0 : 1;
  const int i = std::min(static_cast<int>(at->column), band_.width - 2);
  const int j = std::min(static_cast<int>(at->row), band_.height - 2);
  return Posts{std::max(i - around, 0), std::min(i + 1 + around, band_.width - 1),
               std::max(j - around, 0), std::min(j + 1 + around, band_.height - 1)};
}

std::optional<double> ElevationRaster::post_height_m(int column, int row) const {
  if (column < 0 || column >= band_.width || row < 0 || row >= band_.height) return std::nullopt;
  const float sample_m = band_.at(column, row);
  return std::isnan(sample_m) ? std::nullopt : std::optional(static_cast<double>(sample_m));
}

double ElevationRaster::bilinear_m(double column, double row) const {
  const int i = std::min(static_cast<int>(column), band_.width - 2);
  const int j = std::min(static_cast<int>(row), band_.height - 2);
  const double u = column - i;
  const double v = row - j;
  const auto post = [this](int x, int y) { return static_cast<double>(band_.at(x, y)); };
  return (1.0 - v) * ((1.0 - u) * post(i, j) + u * post(i + 1, j)) +
         v * ((1.0 - u) * post(i, j + 1) + u * post(i + 1, j + 1));
}

double ElevationRaster::cubic_m(double column, double row) const {
  const int i = std::min(static_cast<int>(column), band_.width - 2);
  const int j = std::min(static_cast<int>(row), band_.height - 2);
  const auto weights =
      interpolation_ == Interpolation::cubic ? catmull_rom_weights : b_spline_weights;
  const std::array<double, 4> across = weights(column - i);
  const std::array<double, 4> along = weights(row - j);
  const bool inner = i >= 1 && i + 2 < band_.width && j >= 1 && j + 2 < band_.height;
  double sum_m = 0.0;
  for (int dy = 0; dy < 4; ++dy) {
    double line_m = 0.0;
    for (int dx = 0; dx < 4; ++dx) {
      const int x = i - 1 + dx;
      const int y = j - 1 + dy;
      line_m += across[static_cast<std::size_t>(dx)] *
                (inner ? static_cast<double>(band_.at(x, y)) : post_or_extrapolated_m(x, y));
    }
    sum_m += along[static_cast<std::size_t>(dy)] * line_m;
  }
  return sum_m;
}

// One post beyond the edge continues the straight line of the last two.
double ElevationRaster::post_or_extrapolated_m(int column, int row) const {
  const int x = std::clamp(column, 0, band_.width - 1);
  const int y = std::clamp(row, 0, band_.height - 1);
  const auto post = [this](int i, int j) { return static_cast<double>(band_.at(i, j)); };
  // (2x - column) is the mirror image of `column` in the edge, x itself when inside.
  const int mirror_x = 2 * x - column;
  const int mirror_y = 2 * y - row;
  if (x == column && y == row) return post(x, y);
  return 2.0 * post(x, y) - post(mirror_x, mirror_y);
}

}  // namespace fanbeam::terrain
