#include "session/signal/signal_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/files.h"
#include "core/image.h"
#include "core/npy.h"
#include "core/units.h"
#include "session/plots/gnuplot.h"
#include "session/plots/heat_map.h"
#include "session/signal/spectrum.h"

namespace fanbeam::session {
namespace {

namespace fs = std::filesystem;

std::vector<std::size_t> shape_of(const signal::FloatCube& cube) {
  const auto length = [](int count) { return static_cast<std::size_t>(count); };
  return {length(cube.shape.channels), length(cube.shape.chirps), length(cube.shape.samples)};
}

std::vector<double> real_parts(const signal::FloatCube& cube) {
  std::vector<double> parts;
  parts.reserve(cube.values.size());
  for (const std::complex<float>& value : cube.values) parts.push_back(value.real());
  return parts;
}

class Writer {
 public:
  Writer(const fs::path& folder, const FmcwRadar& radar, const FmcwFrame& frame,
         const FmcwStamp& stamp)
      : folder_(folder), radar_(radar), frame_(frame), stamp_(stamp) {}

  void beats() const {
    for (std::size_t stage = 0; stage < frame_.beats.size(); ++stage) {
      const std::string part = stage == 0 ? "" : "-stage" + std::to_string(stage);
      const signal::FloatCube& beat = frame_.beats[stage];
      if (radar_.waveform.complex_baseband)
        cube("beat", beat, part);
      else
        core::write_npy(file("beat", part + ".npy"), shape_of(beat), real_parts(beat));
    }
  }
  void spectrum() const {
    const BeatSpectrum found = beat_spectrum(radar_, frame_.beats[0]);
    core::write_file_atomically(file("spectrum", ".csv"), spectrum_csv(found));
    write_plot(spectrum_plot(found, title("beat spectrum")), file("spectrum", ".png"));
  }
  void rad_cube() const { cube("cube", frame_.cube, ""); }
  void range_doppler() const;
  void range_azimuth() const;
  void top_view() const;
  void detections() const;
  const std::set<std::string>& files() const { return files_; }

 private:
  fs::path file(const std::string& product, const std::string& ending) const {
    const std::string name = fmt::format("{}/{:05}{}", product, stamp_.frame, ending);
    files_.insert(name);
    return folder_ / name;
  }
  std::string title(const char* what) const {
    return fmt::format("{}, frame {}: {}", stamp_.scene, stamp_.frame, what);
  }
  void cube(const char* product, const signal::FloatCube& values, const std::string& part) const {
    core::write_npy(file(product, part + ".npy"), shape_of(values), values.values);
  }
  HeatMapAxis range_axis() const {
    return {"range, m", 0.0, radar_.axes.range_step_m, frame_.range_doppler.columns, {}};
  }
  // `noise_W`: mean of a cell without echoes. As colours, and as they are.
  void map(const char* product, const signal::PowerMap& powers, double noise_W,
           HeatMap picture) const;

  const fs::path& folder_;
  const FmcwRadar& radar_;
  const FmcwFrame& frame_;
  const FmcwStamp& stamp_;
  mutable std::set<std::string> files_;
};

void Writer::map(const char* product, const signal::PowerMap& powers, double noise_W,
                 HeatMap picture) const {
  core::Image image{powers.columns, powers.rows, {{"power_W", powers.values_W}}};
  core::write_exr(file(product, ".exr"), image,
                  {{"fanbeam:product", product},
                   {"fanbeam:frame", std::to_string(stamp_.frame)},
                   {"fanbeam:rows", picture.y.label},
                   {"fanbeam:columns", picture.x.label}});
  for (const double power_W : powers.values_W) picture.values.push_back(dBm(power_W));
  picture.value_label = "received power, dBm";
  picture.low = std::round(dBm(noise_W));
  picture.high = picture.low + stamp_.dynamic_range_dB;
  write_heat_map(picture, file(product, ".png"));
}

void Writer::range_doppler() const {
  HeatMap picture;
  picture.title = title("sum over channels");
  picture.x = range_axis();
  picture.y = {"radial speed, m/s (receding is up)",
               radar_.axes.speed_mps(0.0),
               radar_.axes.speed_mps(1.0) - radar_.axes.speed_mps(0.0),
               frame_.range_doppler.rows,
               {}};
  for (const signal::RadarDetection& found : frame_.found->detections)
    picture.marks.emplace_back(found.range_cell * radar_.axes.range_step_m,
                               radar_.axes.speed_mps(found.doppler_cell));
  map("range-doppler", frame_.range_doppler, radar_.noise_cell_W * radar_.array.channels(),
      std::move(picture));
}

void Writer::range_azimuth() const {
  const int cells = frame_.range_azimuth.rows;
  const double step = 1.0 / cells * radar_.waveform.wavelength_m() / radar_.pitch_m;
  HeatMap picture;
  picture.title =
      title(radar_.detection.angle == signal::AngleMethod::capon ? "Capon, sum over speeds"
                                                                 : "largest over speeds");
  picture.x = range_axis();
  // Cells are even in the sine of azimuth; the labels are degrees.
  picture.y = {"azimuth, deg (right is up)", -(cells / 2) * step, step, cells, {}};
  for (const int azimuth_deg : {-75, -60, -45, -30, -15, 0, 15, 30, 45, 60, 75})
    picture.y.ticks.emplace_back(std::to_string(azimuth_deg), std::sin(core::radians(azimuth_deg)));
  for (const signal::RadarDetection& found : frame_.found->detections)
    picture.marks.emplace_back(found.range_cell * radar_.axes.range_step_m,
                               std::sin(found.azimuth_rad));
  map("range-azimuth", frame_.range_azimuth, radar_.noise_azimuth_W, std::move(picture));
}

void Writer::top_view() const {
  const signal::TopViewGrid& grid = frame_.grid;
  HeatMap picture;
  picture.title = title("seen from above, detections");
  picture.x = {"right, m", grid.leftmost_m, grid.step_m, grid.columns, {}};
  picture.y = {"forward, m", grid.nearest_m, grid.step_m, grid.rows, {}};
  picture.equal_scales = true;
  for (const signal::RadarDetection& found : frame_.found->detections)
    picture.marks.emplace_back(
        found.range_m * std::sin(found.azimuth_rad),  // slant, as the cells are
        found.range_m * std::cos(found.azimuth_rad));
  map("top-view", frame_.top_view, radar_.noise_azimuth_W, std::move(picture));
}

void Writer::detections() const {
  std::string table =
      "frame,time_s,detection,range_m,radial_speed_mps,azimuth_deg,elevation_deg,power_W,snr_dB,"
      "forward_m,right_m,cluster\n";
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < frame_.found->detections.size(); ++i) {
    const signal::RadarDetection& found = frame_.found->detections[i];
    const glm::dvec3 place_m =
        found.range_m * signal::direction(found.azimuth_rad, found.elevation_rad);
    const double snr_dB = 10.0 * std::log10(std::max(found.snr, 1e-30));
    table +=
        fmt::format("{},{:.6f},{},{:.3f},{:.3f},{:.3f},{:.3f},{:.4e},{:.2f},{:.3f},{:.3f},{}\n",
                    stamp_.frame, stamp_.time_s, i, found.range_m, found.radial_speed_mps,
                    core::degrees(found.azimuth_rad), core::degrees(found.elevation_rad),
                    found.power_W, snr_dB, place_m.x, place_m.y, frame_.found->clusters[i]);
    list.push_back({{"range_m", found.range_m},
                    {"radial_speed_mps", found.radial_speed_mps},
                    {"azimuth_rad", found.azimuth_rad},
                    {"elevation_rad", found.elevation_rad},
                    {"power_W", found.power_W},
                    {"snr_dB", snr_dB},
                    {"forward_m", place_m.x},
                    {"right_m", place_m.y},
                    {"cluster", frame_.found->clusters[i]}});
  }
  const nlohmann::ordered_json json = {{"frame", stamp_.frame},
                                       {"time_s", stamp_.time_s},
                                       {"radar_speed_mps", stamp_.radar_speed_mps},
                                       {"radar_velocity_mps", stamp_.radar_velocity_mps},
                                       {"detections", list}};
  core::write_file_atomically(file("detections", ".json"), json.dump(1) + "\n");
  // Behind it: whoever tracks an unfinished run is refused tables without JSON of their name.
  core::write_file_atomically(file("detections", ".csv"), table);
}

}  // namespace

std::set<std::string> write_fmcw_products(const fs::path& folder,
                                          const std::set<std::string>& products,
                                          const FmcwRadar& radar, const FmcwFrame& frame,
                                          const FmcwStamp& stamp) {
  const Writer writer(folder, radar, frame, stamp);
  if (products.contains("beat")) writer.beats();
  if (!radar.maps) return writer.files();
  if (products.contains("spectrum")) writer.spectrum();
  if (products.contains("cube")) writer.rad_cube();
  if (products.contains("range-doppler")) writer.range_doppler();
  if (products.contains("range-azimuth")) writer.range_azimuth();
  if (products.contains("top-view")) writer.top_view();
  if (products.contains("detections")) writer.detections();
  return writer.files();
}

std::set<std::string> write_spectrogram(const fs::path& folder, const Spectrogram& spectrogram,
                                        const std::string& scene, double dynamic_range_dB) {
  const signal::PowerMap powers = spectrogram.powers();
  const HeatMap picture = spectrogram.picture(scene, dynamic_range_dB);
  core::Image image{powers.columns, powers.rows, {{"power_W", powers.values_W}}};
  core::write_exr(folder / "spectrogram/all.exr", image,
                  {{"fanbeam:product", "spectrogram"},
                   {"fanbeam:rows", picture.y.label},
                   {"fanbeam:columns", picture.x.label}});
  write_heat_map(picture, folder / "spectrogram/all.png");
  return {"spectrogram/all.exr", "spectrogram/all.png"};
}

}  // namespace fanbeam::session
