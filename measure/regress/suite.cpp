#include "measure/regress/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <set>
#include <system_error>

#include "core/files.h"
#include "core/text.h"
#include "renderer/casting/sampling.h"
#include "renderer/plan/caster_choice.h"
#include "renderer/plan/plan.h"
#include "session/frame_choice.h"
#include "session/products/products.h"
#include "session/shipped.h"

namespace fanbeam::measure {
namespace {

namespace fs = std::filesystem;
using core::ConfigTable;
using core::ErrorClass;

// Three bytes for each and a suffix fit the 255 of a file name.
constexpr std::size_t kLongestName = 80;
constexpr core::NumberRange kLimit{0.0, 1e6};
constexpr core::NumberRange kPercent{0.0, 100.0};

// Products that are pictures; videos and tables are not compared.
std::vector<std::string> picture_products() {
  std::vector<std::string> names;
  for (const session::Product& product : session::kProducts)
    if (product.name != "preview" && product.name != "obstacles" && product.name != "labels")
      names.emplace_back(product.name);
  return names;
}

// Whether an optional key is there; unlike has() it makes the key a known one.
bool given(ConfigTable& table, std::string_view key) {
  if (table.has(key)) return true;
  table.optional_text(key);
  return false;
}

// A text of one line that tells something.
std::string required_line(ConfigTable& table, std::string_view key, std::size_t longest) {
  std::string text = table.required_text(key);
  if (!table.has(key)) return text;
  if (core::trimmed(text).empty())
    table.error(ErrorClass::range, key, "\"\"", "a text that says something");
  else if (text.size() > longest)
    table.error(ErrorClass::limit, key, std::to_string(text.size()) + " bytes",
                "at most " + std::to_string(longest) + " bytes");
  return text;
}

// A limit of figures that the product's files do not have would limit nothing.
void keep_to(ConfigTable& table, const char* limit, const std::string& product,
             std::initializer_list<std::string_view> products) {
  if (table.has(limit) && std::find(products.begin(), products.end(), product) == products.end())
    table.error(ErrorClass::ref, limit, "a limit of " + product,
                fmt::format("a limit of {} alone", fmt::join(products, " and ")));
}

Tolerance read_tolerance(ConfigTable table, const std::string& product) {
  Tolerance tolerance;
  tolerance.mean = table.optional_number("mean", kLimit);
  tolerance.rms = table.optional_number("rms", kLimit);
  tolerance.largest = table.optional_number("largest", kLimit);
  tolerance.percent = table.optional_number("percent", kPercent);
  tolerance.changed_percent = table.optional_number("changed_percent", kPercent);
  tolerance.lit_in_one_percent = table.optional_number("lit_in_one_percent", kPercent);
  keep_to(table, "changed_percent", product, {"layers", "cscope_layers"});
  keep_to(table, "lit_in_one_percent", product, {"power"});
  const auto given = [&](const char* limit) { return table.has(limit); };
  if (std::ranges::none_of(std::array{"mean", "rms", "largest", "percent", "changed_percent"},
                           given))
    table.error(ErrorClass::ref, "", "no limit",
                "at least one of rms, largest, percent, changed_percent and mean");
  tolerance.reason = required_line(table, "reason", 1000);
  return tolerance;
}

// [tolerance.bscope] and its like; a case's table replaces the suite's for that product.
void read_tolerances(ConfigTable table, std::map<std::string, Tolerance>& tolerances) {
  for (const std::string& product : picture_products())
    if (const ConfigTable own = table.table(product); own.present())
      tolerances[product] = read_tolerance(own, product);
}

std::optional<core::InstructionLevel> read_isa(ConfigTable& table,
                                               std::optional<core::InstructionLevel> fallback) {
  if (!given(table, "isa")) return fallback;
  constexpr std::string_view kNames[] = {"v2", "v3", "v4"};
  return core::instruction_level_named(
      kNames[table.choice("isa", {kNames[0], kNames[1], kNames[2]}, 0)]);
}

std::string read_products(ConfigTable& table) {
  if (!given(table, "products")) return session::RenderRequest{}.products;
  const std::vector<std::string> known = picture_products();
  const std::vector<std::string> products = table.texts("products");
  for (const std::string& product : products)
    if (std::find(known.begin(), known.end(), product) == known.end())
      table.error(ErrorClass::ref, "products", "\"" + product + "\"",
                  fmt::format("pictures: {}", fmt::join(known, ", ")));
  if (products.empty()) table.error(ErrorClass::range, "products", "none", "one at least");
  return fmt::format("{}", fmt::join(products, ","));
}

class CaseReader {
 public:
  // Names are looked for in `folder` first.
  CaseReader(ConfigTable& table, const fs::path& folder, const fs::path& shipped)
      : table_(table), folder_(folder), shipped_(shipped) {}

  SuiteCase read(const SuiteCase& of_all) {
    SuiteCase result = of_all;
    result.name = required_line(table_, "name", kLongestName);
    result.place = table_.place("name");
    result.folder = file_name_of(result.name);
    session::RenderRequest& render = result.render;
    read_scene(render);
    render.frames = table_.required_text("frames");
    checked("frames", ErrorClass::parse, [&] { session::check_frames(render.frames); });
    render.products = read_products(table_);
    if (const auto data = table_.optional_text("data")) render.data = (folder_ / *data).string();
    read_sampling(render);
    read_realisation(render);
    result.isa = read_isa(table_, of_all.isa);
    ConfigTable own = table_.table("tolerance");
    read_tolerances(own, result.tolerances);
    const std::string rendered = "," + render.products + ",";
    for (const std::string& product : own.keys())
      if (result.tolerances.contains(product) &&
          rendered.find("," + product + ",") == std::string::npos)
        own.error(ErrorClass::ref, product, "a tolerance",
                  "tolerances of products that the case renders: " + render.products);
    return result;
  }

 private:
  // What is refused is told of the key.
  template <typename Check>
  void checked(std::string_view key, ErrorClass error_class, Check check) {
    try {
      check();
    } catch (const core::InputError& error) {
      const core::Problem& problem = error.problems().front();
      table_.error(error_class, key, problem.value, problem.expected);
    }
  }

  void read_scene(session::RenderRequest& render) {
    render.scene = table_.required_text("scene");
    if (!render.scene.empty())
      checked("scene", ErrorClass::ref, [&] {
        render.scene = session::find_scene(render.scene, shipped_, folder_).string();
      });
    if (const auto sensor = table_.optional_text("sensor"))
      checked("sensor", ErrorClass::ref, [&] {
        render.sensor = session::find_sensor(*sensor, shipped_, "sensor", folder_).string();
      });
  }

  void read_sampling(session::RenderRequest& render) {
    if (given(table_, "caster")) {
      constexpr auto kWishes = renderer::kCasterWishes;
      static_assert(kWishes.size() == 3);
      render.caster = kWishes[table_.choice("caster", {kWishes[0], kWishes[1], kWishes[2]}, 0)];
    }
    const auto samples = table_.optional_number("rays_per_cell", renderer::kSamplesPerCell);
    const auto accuracy = table_.optional_number("accuracy_grey", renderer::kAccuracies_grey);
    render.rays_per_cell = samples.value_or(0.0);
    render.accuracy_grey = accuracy.value_or(0.0);
    if (given(table_, "reference")) render.reference = table_.boolean("reference", false);
    if (render.reference && (samples || accuracy))
      table_.error(ErrorClass::ref, samples ? "rays_per_cell" : "accuracy_grey", "beside reference",
                   "one of them: a reference has its own sampling");
    if (render.reference && render.caster == name_of(renderer::CasterWish::profile))
      table_.error(ErrorClass::ref, "caster", "\"profile\" beside reference",
                   "\"rays\", of which references are made");
  }

  void read_realisation(session::RenderRequest& render) {
    render.seed = static_cast<std::uint64_t>(
        table_.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), 0));
    if (given(table_, "realisation"))
      render.realisation =
          table_.choice("realisation", {"mean", "sample"}, 0) == 0 ? "mean" : "sample";
    render.effects = table_.optional_text("effects").value_or("");
    if (render.effects.empty()) return;
    checked("effects", ErrorClass::ref, [&] { renderer::parse_effect_wishes(render.effects); });
  }

  ConfigTable& table_;
  const fs::path& folder_;
  const fs::path& shipped_;
};

fs::path read_approved(ConfigTable& root, const fs::path& folder, core::ProblemList& problems) {
  const std::string name = root.text("approved", "approved");
  try {
    const fs::path path = core::path_inside(folder, name, root.place("approved"), "approved");
    if (path == fs::weakly_canonical(folder))
      root.error(ErrorClass::path, "approved", "\"" + name + "\"",
                 "a folder of its own, below the suite's");
    return path;
  } catch (const core::InputError& error) {
    problems.append(error.problems());
    return {};
  }
}

}  // namespace

std::string file_name_of(const std::string& text) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string name;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '_' || (c == '.' && !name.empty());
    if (plain) {
      name += c;
    } else {
      const auto byte = static_cast<unsigned char>(c);
      name += '~';
      name += kDigits[byte >> 4U];
      name += kDigits[byte & 15U];
    }
  }
  return name.empty() ? "~" : name;
}

Suite read_suite(const fs::path& file, const fs::path& shipped, core::ProblemList& problems) {
  std::error_code status;
  if (!fs::is_regular_file(file, status))
    core::throw_input_error(ErrorClass::io, core::Place{file.string()}, "suite",
                            status ? status.message() : "not a file",
                            "a TOML file (docs/regression.md)");
  Suite suite;
  suite.file = file;
  ConfigTable root = ConfigTable::from_file(file, problems);
  if (!root.present()) return suite;
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  suite.name = required_line(root, "name", kLongestName);
  suite.approved = read_approved(root, folder, problems);
  SuiteCase of_all;
  of_all.isa = read_isa(root, std::nullopt);
  if (const auto data = root.optional_text("data")) of_all.render.data = (folder / *data).string();
  read_tolerances(root.table("tolerance"), of_all.tolerances);
  std::set<std::string> names;
  for (ConfigTable& table : root.tables("case")) {
    suite.cases.push_back(CaseReader(table, folder, shipped).read(of_all));
    const std::string& name = suite.cases.back().name;
    if (!name.empty() && !names.insert(name).second)
      table.error(ErrorClass::ref, "name", "\"" + name + "\"",
                  "a name that no other case of the suite has");
  }
  if (suite.cases.empty()) root.error(ErrorClass::ref, "case", "missing", "one [[case]] at least");
  root.report_unknown_keys();
  suite.resolved = root.resolved();
  return suite;
}

Suite read_valid_suite(const fs::path& file, const fs::path& shipped) {
  core::ProblemList problems;
  Suite suite = read_suite(file, shipped, problems);
  problems.throw_if_errors();
  return suite;
}

}  // namespace fanbeam::measure
