#include "renderer/stages/layer_lines.h"

#include <algorithm>
#include <cmath>

#include "renderer/plan/largest_echo.h"
#include "renderer/surfaces/nrcs_table.h"
#include "sensors/cells.h"

namespace fanbeam::renderer {
namespace {

// What neighbours on one surface step over is theirs up to here, and where their facets agree that it
// is one slope: behind a crest the next visible ground is farther than they say.
constexpr int kLargestGap_cells = 12;
constexpr double kMostOfSlope = 1.5;
// Azimuths that share a fan. Of a tilted antenna, or a cone, each has a horizon of its own.
constexpr int kFanLines = 4, kTiltedFanLines = 1;
constexpr int kRounds = 2;  // of rays between neighbours

Sampling layer_sampling() {
  Sampling sampling;
  sampling.rays_per_cell = 0.125;
  sampling.largest_step_rad *= 2.0;
  sampling.largest_step_rows = 2.0;
  return sampling;
}

// Each ray stands for what is nearer to it than to its neighbours; the lowest for nothing below it, the
// highest for as much above as below. One alone is all that its cell and row have.
void share_out(LayerLine& hits) {
  float below_rad = hits.size() == 1 ? 2.0F : 0.0F;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const float above_rad =
        i + 1 < hits.size() ? hits[i + 1].elevation_rad - hits[i].elevation_rad : below_rad;
    hits[i].height_rad = 0.5F * (below_rad + above_rad);
    below_rad = above_rad;
  }
}

}  // namespace

LayerLines::LayerLines(const World& world, const sensors::AntennaFrame& antenna)
    : world_(world),
      antenna_(antenna),
      fan_(world, layer_sampling()),
      elevation_gain_(world.sensor.antenna.elevation),
      // Steps of metres will do where losses weigh a cell's parts against each other.
      path_loss_(world.attenuation, antenna.position_m.z,
                 antenna.position_m.z - world.sensor.range.maximum_m(),
                 antenna.position_m.z + world.sensor.range.maximum_m()),
      beam_rad_(azimuth_width_rad(world.sensor)),
      row_rad_(cscope_row_rad(world.sensor.display)) {}

void LayerLines::cast(int first, int last, const std::vector<std::uint8_t>& marked,
                      std::array<LayerLine, kBlockLines>& lines) const {
  thread_local Block block;
  RayLine rays(world_, antenna_, elevation_gain_, path_loss_);
  block.first_line = first * kLayerAzimuths;
  const int count = (last - first) * kLayerAzimuths;
  const bool upright = azimuths_are_upright(antenna_, world_.sensor.scan.surface);
  const int abreast = upright ? kFanLines : kTiltedFanLines;
  const auto wanted = [&](int line) {
    return marked[static_cast<std::size_t>(first + line / kLayerAzimuths)] != 0;
  };
  for (int line = 0; line < count; line += abreast) {
    const int beside = std::min(abreast, count - line);
    if (wanted(line) || wanted(line + beside - 1))
      look(line, beside, rays, block, lines);
    else
      for (int i = line; i < line + beside; ++i) lines[static_cast<std::size_t>(i)].clear();
  }
  for (int round = 0; round < kRounds; ++round) look_between(count, rays, block, lines);
  for (int i = 0; i < count; ++i) share_out(lines[static_cast<std::size_t>(i)]);
}

// A ray in each step of the fan, row by row.
void LayerLines::look(int line, int count, RayLine& rays, Block& block,
                      std::array<LayerLine, kBlockLines>& lines) const {
  const sensors::Scan& scan = world_.sensor.scan;
  const double step_rad = scan.column_width_rad() / kLayerAzimuths;
  const double left_rad = sensors::column_edge_rad(scan, 0) + (block.first_line + line) * step_rad;
  fan_.place(antenna_, left_rad, left_rad + count * step_rad, block.edges);
  const std::vector<double>& edges = block.edges;
  const std::size_t rows = edges.size() < 2 ? 0 : edges.size() - 1;
  std::array<double, kBlockLines> share;
  for (int i = 0; i < count; ++i) {
    const double azimuth_rad = left_rad + (i + 0.5) * step_rad;
    block.azimuths[static_cast<std::size_t>(line + i)] = {azimuth_rad, std::cos(azimuth_rad),
                                                          std::sin(azimuth_rad), step_rad};
    share[static_cast<std::size_t>(i)] = elevation_place(block.first_line + line + i, 0.5);
    lines[static_cast<std::size_t>(line + i)].resize(rows);
  }
  const auto aim = [&](int ray) {
    const auto row = static_cast<std::size_t>(ray / count);
    const int i = ray % count;
    // The lowest at the border: nothing is below to lie between.
    const double at = row == 0 && rows > 1 ? 0.0 : share[static_cast<std::size_t>(i)];
    return RayPlace{block.azimuths[static_cast<std::size_t>(line + i)],
                    edges[row] + at * (edges[row + 1] - edges[row]),
                    dither(static_cast<std::uint32_t>(row), block.first_line + line + i, 0)};
  };
  const auto keep = [&](int ray, const RayBatch& batch, const RayChain& chain, int lane) {
    see(batch, chain, lane,
        lines[static_cast<std::size_t>(line + ray % count)][static_cast<std::size_t>(ray / count)]);
  };
  rays.cast(static_cast<int>(rows) * count, aim, keep);
}

// A ray more wherever two neighbours do not tell what lies between them.
void LayerLines::look_between(int count, RayLine& rays, Block& block,
                              std::array<LayerLine, kBlockLines>& lines) const {
  std::vector<Wish>& wishes = block.wishes;
  wishes.clear();
  for (int line = 0; line < count; ++line) {
    const LayerLine& hits = lines[static_cast<std::size_t>(line)];
    for (std::size_t i = 0; i + 1 < hits.size(); ++i) {
      const LayerHit &below = hits[i], &above = hits[i + 1];
      const auto low_rad = static_cast<double>(below.elevation_rad);
      const auto high_rad = static_cast<double>(above.elevation_rad);
      if (untold(below, above)) wishes.push_back({line, i, 0.5 * (low_rad + high_rad), {}});
    }
  }
  rays.cast(
      static_cast<int>(wishes.size()),
      [&](int ray) {
        const Wish& wish = wishes[static_cast<std::size_t>(ray)];
        const auto line = static_cast<std::size_t>(wish.line);
        const auto index = static_cast<std::uint32_t>(lines[line].size() + wish.behind);
        return RayPlace{block.azimuths[line], wish.elevation_rad,
                        dither(index, block.first_line + wish.line, 0)};
      },
      [&](int ray, const RayBatch& batch, const RayChain& chain, int lane) {
        see(batch, chain, lane, wishes[static_cast<std::size_t>(ray)].hit);
      });
  // From the end on, each line moves up for what lies between.
  for (std::size_t end = wishes.size(); end > 0;) {
    const int line = wishes[end - 1].line;
    std::size_t begin = end;
    while (begin > 0 && wishes[begin - 1].line == line) --begin;
    LayerLine& hits = lines[static_cast<std::size_t>(line)];
    std::size_t from = hits.size(), to = from + (end - begin);
    hits.resize(to);
    for (; end > begin; --end) {
      while (from > wishes[end - 1].behind + 1) hits[--to] = hits[--from];
      hits[--to] = wishes[end - 1].hit;
    }
  }
}

bool LayerLines::is_ground(const LayerHit& hit) const {
  return world_.surfaces().terrain() != nullptr &&
         (hit.surface | 1U) == surface_of(terrain::kTerrainGeometry, 1U);
}

bool LayerLines::one_slope(const LayerHit& a, const LayerHit& b) const {
  if (a.surface != b.surface || std::abs(b.cell - a.cell) > kLargestGap_cells) return false;
  const float step_rad = b.elevation_rad - a.elevation_rad;
  const float told_m = std::max(std::abs(a.range_m * a.range_slope * step_rad),
                                std::abs(b.range_m * b.range_slope * step_rad));
  return static_cast<double>(std::abs(b.range_m - a.range_m)) <=
         kMostOfSlope * static_cast<double>(told_m) + world_.sensor.range.cell_m;
}

// Whether what lies between two neighbours may be neither's.
bool LayerLines::untold(const LayerHit& a, const LayerHit& b) const {
  if (!a.hit() || !b.hit()) return a.hit() != b.hit();
  const bool cells = std::abs(a.cell - b.cell) >= 2;
  if (!cells && std::abs(a.row - b.row) < 2) return false;
  if (a.surface != b.surface) return true;
  if (!is_ground(a) && (a.material != b.material || a.object != b.object)) return true;
  return cells && !one_slope(a, b);
}

void LayerLines::see(const RayBatch& batch, const RayChain& chain, int lane, LayerHit& hit) const {
  const auto i = static_cast<std::size_t>(lane);
  hit.elevation_rad = static_cast<float>(batch.elevation_rad[lane]);
  hit.surface = terrain::kNoHit;
  if (batch.geometry[lane] == terrain::kNoHit) return;
  hit.surface = chain.surface[i];
  hit.range_m = chain.range_m[i];
  hit.range_slope = chain.range_slope[i];
  hit.power_W_per_rad = static_cast<float>(static_cast<double>(chain.density_W_per_rad2[i]) *
                                           beam_rad_ / kLayerAzimuths);
  const float dx = batch.direction_x[lane], dy = batch.direction_y[lane],
              dz = batch.direction_z[lane];
  const float nx = batch.normal_x[lane], ny = batch.normal_y[lane], nz = batch.normal_z[lane];
  hit.sin_grazing = std::clamp(
      -(nx * dx + ny * dy + nz * dz) / std::sqrt(nx * nx + ny * ny + nz * nz), 0.0F, 1.0F);
  const auto range_m = static_cast<double>(hit.range_m);
  const double x_m = antenna_.position_m.x + range_m * static_cast<double>(dx);
  const double y_m = antenna_.position_m.y + range_m * static_cast<double>(dy);
  hit.x_m = static_cast<float>(x_m);
  hit.y_m = static_cast<float>(y_m);
  const terrain::RayScene& surfaces = world_.surfaces();
  if (is_ground(hit)) {
    const terrain::SurfaceMap::Cover here = surfaces.surface_map()->cover_at(x_m, y_m);
    hit.material = here.material;
    hit.object = here.object;
  } else {
    hit.material = surfaces.material(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
    hit.object = surfaces.object(batch.geometry[lane], batch.primitive[lane], x_m, y_m);
  }
  const auto sine = static_cast<double>(hit.sin_grazing);
  hit.nrcs = static_cast<float>(world_.nrcs.tables()[hit.material].sigma0_over_sine(sine) * sine);
  hit.cell = cell_of(range_m);
  hit.row = row_of(batch.elevation_rad[lane]);
}

// Counts on before and behind the gate.
int LayerLines::cell_of(double range_m) const {
  const sensors::RangeGate& gate = world_.sensor.range;
  const int cell = sensors::range_row(gate, range_m);
  if (cell != sensors::kOutside) return cell;
  const auto beside = static_cast<int>(std::floor((range_m - gate.minimum_m) / gate.cell_m));
  return range_m < gate.minimum_m ? std::min(beside, -1) : std::max(beside, gate.cells);
}

// Counts on above and below the window.
int LayerLines::row_of(double elevation_rad) const {
  return static_cast<int>(
      std::floor((world_.sensor.display.cscope_top_rad - elevation_rad) / row_rad_));
}

}  // namespace fanbeam::renderer
