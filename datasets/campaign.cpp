#include "datasets/campaign.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <limits>
#include <set>

#include "core/config_table.h"
#include "core/files.h"
#include "core/spelling.h"
#include "core/text.h"
#include "datasets/sha256.h"
#include "materials/library/surface_state.h"
#include "scenes/airport/airport.h"
#include "session/products/products.h"
#include "session/shipped.h"

namespace fanbeam::datasets {
namespace {

namespace fs = std::filesystem;
using core::ConfigTable;
using core::ErrorClass;

constexpr std::uint64_t kLargestFile_bytes = 4U << 20U;

void read_frames(ConfigTable table, FrameSpread& frames) {
  frames.count = static_cast<int>(table.integer("count", 1, 100'000, 5));
  frames.from = table.number("from", {0.0, 1.0}, 0.0);
  frames.to = table.number("to", {0.0, 1.0}, 1.0);
  if (!(frames.from <= frames.to))
    table.error(ErrorClass::range, "to", core::number_text(frames.to),
                "at least " + core::number_text(frames.from) + ", where it begins");
}

// Earlier versions took one that is named twice, and gave it two columns of one name.
void read_products(ConfigTable& table, std::vector<std::string>& products, ReadFor purpose) {
  for (const std::string& product : table.texts("products"))
    if (std::find(products.begin(), products.end(), product) == products.end())
      products.push_back(product);
    else if (purpose == ReadFor::making)
      table.error(ErrorClass::ref, "products", "\"" + product + "\"", "each product once");
  if (products.empty()) products = {"bscope", "cscope", "labels"};
  std::vector<std::string> known;
  for (const session::Product& product : session::kProducts)
    if (product.name != "preview" && product.name != "figure" && product.name != "ppi_figure")
      known.emplace_back(product.name);
  for (const std::string& product : products)
    if (std::find(known.begin(), known.end(), product) == known.end())
      table.error(ErrorClass::ref, "products", "\"" + product + "\"",
                  "a known one" + core::names_there_text(product, known));
}

CampaignAirport read_airport_of(ConfigTable& table, const std::vector<CampaignAirport>& others) {
  CampaignAirport airport;
  airport.place = table.place("");
  airport.ident = table.required_text("ident");
  airport.runway = table.required_text("runway");
  airport.file = table.required_text("file");
  airport.elevation = table.required_text("elevation");
  airport.buildings = table.text("buildings", "");
  airport.name = table.text("name", scenes::landing_name(airport.ident, airport.runway));
  const auto same = [&](const CampaignAirport& other) { return other.name == airport.name; };
  if (!core::is_safe_word(airport.name) || std::any_of(others.begin(), others.end(), same))
    table.error(ErrorClass::range, "name", "\"" + airport.name + "\"",
                "letters, digits, - and _, once in the file");
  airport.start_distance_m = table.number("start_distance_m", {500.0, 20000.0}, 5000.0);
  airport.glide_path_deg = table.number("glide_path_deg", {1.0, 10.0}, 3.0);
  return airport;
}

// Two of one name would be one scene: the airport's, or the folder's twice. Earlier versions took them, and
// what they made can still be looked at.
void check_scene_names(ConfigTable& table, const Campaign& campaign) {
  std::set<std::string> names;
  for (const CampaignAirport& airport : campaign.airports) names.insert(airport.name);
  for (const std::string& scene : campaign.scenes)
    if (!names.insert(scene).second)
      table.error(ErrorClass::ref, "scenes", "\"" + scene + "\"",
                  "each scene once, of another name than every [[airport]]");
}

// What is wrong with the name that `find` looks for is told of the key.
template <class Find>
void check_found(ConfigTable& table, const char* key, const Find& find) {
  try {
    find();
  } catch (const core::InputError& error) {
    const core::Problem& problem = error.problems().front();
    table.error(ErrorClass::ref, key, problem.value, problem.expected);
  }
}

// Where a worker looks for them: each of its runs would fail.
void check_scenes_and_sensor(ConfigTable& table, const Campaign& campaign,
                             const fs::path& shipped) {
  for (const std::string& scene : campaign.scenes) {
    if (table.problems().is_full()) return;
    check_found(table, "scenes", [&] { session::find_scene(scene, shipped, campaign.folder()); });
  }
  if (!campaign.sensor.empty())
    check_found(table, "sensor", [&] {
      session::find_sensor(campaign.sensor, shipped, "sensor", campaign.folder());
    });
}

void read_campaign_table(ConfigTable table, Campaign& campaign, ReadFor purpose,
                         const fs::path& shipped) {
  campaign.name = table.required_text("name");
  if (table.is_text("name") && !core::is_safe_word(campaign.name))
    table.error(ErrorClass::range, "name", "\"" + campaign.name + "\"",
                "letters, digits, - and _: it names folders");
  campaign.scenes = table.texts("scenes");
  campaign.sensor = table.text("sensor", "");
  if (purpose == ReadFor::making) check_scene_names(table, campaign);
  if (!shipped.empty()) check_scenes_and_sensor(table, campaign, shipped);
  for (const CampaignAirport& airport : campaign.airports) campaign.scenes.push_back(airport.name);
  if (campaign.scenes.empty())
    table.error(ErrorClass::ref, "scenes", "none", "at least one scene, or an [[airport]]");
  campaign.plan = static_cast<Campaign::Plan>(table.choice("plan", {"grid", "sobol", "random"}, 2));
  campaign.runs = static_cast<int>(table.integer("runs", 1, kMostRuns, 1));
  campaign.seed = static_cast<std::uint64_t>(
      table.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 0));
  read_frames(table.table("frames"), campaign.frames);
  read_products(table, campaign.products, purpose);
  const std::size_t level = table.choice("isa", {"v2", "v3", "v4"}, 1);
  campaign.isa = std::array{core::InstructionLevel::v2, core::InstructionLevel::v3,
                            core::InstructionLevel::v4}[level];
  if (table.has("realisation"))
    campaign.sample = table.choice("realisation", {"mean", "sample"}, 0) == 1;
  campaign.samples_per_cell = table.number("samples_per_cell", renderer::kSamplesPerCell, 0.0);
  campaign.archives = table.choice("runs_as", {"folders", "archives"}, 0) == 1;
}

std::vector<std::string> surface_words() {
  const auto& words = materials::kSurfaceStateNames;
  return {words.begin(), words.end()};
}

struct Reading {
  Campaign& campaign;
  ReadFor purpose;

  bool is_grid() const { return campaign.plan == Campaign::Plan::grid; }
};

// A grid takes each value as often as the others, whatever its weight.
Distribution read_parameter(ConfigTable& table, std::string_view key, const Allowed& allowed,
                            const Reading& reading) {
  Distribution distribution = read_distribution(table, key, allowed);
  if (reading.is_grid() && table.is_table(key)) {
    ConfigTable form = table.table(key);
    if (form.has("weights")) {
      const char* const given = "given in the plan \"grid\"";
      if (reading.purpose == ReadFor::looking)
        form.warning("NO-WEIGHTS", "weights", given, "a grid took every value equally often");
      else
        form.error(ErrorClass::ref, "weights", given,
                   "none: a grid takes every value equally often; or the plan \"sobol\"");
    }
  }
  return distribution;
}

void read_parameters(ConfigTable table, const Reading& reading) {
  Campaign& campaign = reading.campaign;
  const auto read = [&](ConfigTable& part, std::string_view key, const Allowed& allowed) {
    return read_parameter(part, key, allowed, reading);
  };
  if (table.has("scene"))
    campaign.parameters.push_back({"scene", read(table, "scene", campaign.scenes)});
  else if (campaign.scenes.size() > 1) {
    Distribution::Choice each;
    for (const std::string& scene : campaign.scenes) each.values.emplace_back(scene);
    each.weights.assign(each.values.size(), 1.0 / static_cast<double>(each.values.size()));
    campaign.parameters.push_back({"scene", Distribution(each)});
  }
  if (table.has("surface"))
    campaign.parameters.push_back({"surface", read(table, "surface", surface_words())});
  for (const char* name : {"weather", "sensor", "flight"}) {
    ConfigTable part = table.table(name);
    for (const ParameterKind& kind : kParameters)
      if (kind.table == std::string_view(name) && part.has(kind.key))
        campaign.parameters.push_back(
            {std::string(name) + "." + kind.key, read(part, kind.key, kind.range)});
  }
  if (campaign.find("weather.visibility_m") != nullptr &&
      campaign.find("weather.liquid_water_g_per_m3") != nullptr)
    table.error(ErrorClass::ref, "weather", "visibility_m and liquid_water_g_per_m3",
                "one of the two: the other follows from it");
}

// 1 in the share of the runs that is told, else 0.
Distribution presence(ConfigTable& table, const Reading& reading) {
  const double share = table.number("present", {0.0, 1.0}, 1.0);
  if (share == 0.0 || share == 1.0) return Distribution(Value{share});
  if (reading.is_grid() && reading.purpose == ReadFor::looking)
    table.warning("NO-WEIGHTS", "present", core::number_text(share),
                  "a grid took its traffic in half of the runs");
  else if (reading.is_grid())
    table.error(ErrorClass::range, "present", core::number_text(share),
                "0 or 1 in a grid, which draws nothing; or the plan \"sobol\"");
  return Distribution(Distribution::Choice{{Value{1.0}, Value{0.0}}, {share, 1.0 - share}});
}

void read_traffic(ConfigTable table, const Reading& reading) {
  Campaign& campaign = reading.campaign;
  const std::string name = table.required_text("name");
  const auto& others = campaign.traffic;
  if (table.is_text("name") &&
      (!core::is_safe_word(name) || std::find(others.begin(), others.end(), name) != others.end()))
    table.error(ErrorClass::range, "name", "\"" + name + "\"",
                "letters, digits, - and _, once in the file");
  campaign.traffic.push_back(name);
  const auto take = [&](const char* key, const core::NumberRange& range, double otherwise) {
    const std::string whole = "traffic." + name + "." + key;
    campaign.parameters.push_back({whole, table.has(key)
                                              ? read_parameter(table, key, range, reading)
                                              : Distribution(Value{otherwise})});
  };
  take("rcs_m2", {0.0, 1e6}, 10.0);
  take("along_m", {-10'000.0, 10'000.0}, 500.0);
  take("across_m", {-5'000.0, 5'000.0}, 0.0);
  take("height_m", {0.0, 500.0}, 1.0);
  campaign.parameters.push_back({"traffic." + name + ".present", presence(table, reading)});
}

// Of a grid the runs are what its values make.
void settle_plan(ConfigTable& root, Campaign& campaign) {
  std::size_t varying = 0;
  double product = 1.0;
  for (const Parameter& parameter : campaign.parameters) {
    if (parameter.distribution.is_constant()) continue;
    ++varying;
    const std::size_t count = parameter.distribution.count();
    if (campaign.plan == Campaign::Plan::grid && count == 0)
      root.error(ErrorClass::range, "campaign", "plan \"grid\" with a range of " + parameter.name,
                 "values = [...] for everything that varies, or the plan \"sobol\"");
    product *= static_cast<double>(std::max<std::size_t>(count, 1));
  }
  if (campaign.plan == Campaign::Plan::grid) {
    if (product * campaign.runs > kMostRuns)
      root.error(ErrorClass::limit, "campaign", core::number_text(product) + " combinations",
                 "at most " + std::to_string(kMostRuns) + " runs");
    else
      campaign.runs *= static_cast<int>(product);
  }
  constexpr std::size_t kMostDimensions = boost::random::default_sobol_table::max_dimension;
  if (campaign.plan == Campaign::Plan::sobol && varying > kMostDimensions)
    root.error(ErrorClass::limit, "campaign", std::to_string(varying) + " varying parameters",
               "at most " + std::to_string(kMostDimensions) + " of a Sobol plan");
}

}  // namespace

const Parameter* Campaign::find(std::string_view wanted) const {
  for (const Parameter& parameter : parameters)
    if (parameter.name == wanted) return &parameter;
  return nullptr;
}

fs::path Campaign::folder() const { return fs::absolute(file).parent_path().lexically_normal(); }

Campaign read_campaign(const fs::path& file, core::ProblemList& problems, ReadFor purpose,
                       const fs::path& shipped) {
  Campaign campaign;
  campaign.file = file;
  ConfigTable root = ConfigTable::from_file(file, problems);
  if (!root.present()) return campaign;
  campaign.text_hash = sha256(core::read_file(file, kLargestFile_bytes));
  for (ConfigTable& airport : root.tables("airport", 1000))
    campaign.airports.push_back(read_airport_of(airport, campaign.airports));
  read_campaign_table(root.table("campaign"), campaign, purpose, shipped);
  const Reading reading{campaign, purpose};
  read_parameters(root.table("parameters"), reading);
  for (ConfigTable& traffic : root.tables("traffic", 1000))
    read_traffic(std::move(traffic), reading);
  settle_plan(root, campaign);
  root.report_unknown_keys();
  return campaign;
}

}  // namespace fanbeam::datasets
