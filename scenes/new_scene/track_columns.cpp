#include "scenes/new_scene/track_columns.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>

namespace fanbeam::scenes {
namespace {

using Words = std::vector<std::string>;
using Names = std::initializer_list<std::string_view>;

Words words_of(std::string_view name) {
  Words words;
  bool open = false, small_before = false;
  for (const char letter : name.substr(0, 200)) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool capital = std::isupper(byte) != 0;
    if (std::isalnum(byte) == 0) {
      open = false;
      continue;
    }
    if (!open || (capital && small_before)) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(byte));
    open = true;
    small_before = std::islower(byte) != 0;
  }
  return words;
}

bool has_any(const Words& words, Names names) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(names.begin(), names.end(), word) != names.end();
  });
}

std::string unit_of(const Words& words, Names units_of_kind) {
  struct Unit {
    std::string_view unit;
    Names words;
  };
  static const Unit kUnits[] = {
      {"ms", {"ms", "msec", "millis", "milliseconds", "millisecond"}},
      {"s", {"s", "sec", "secs", "second", "seconds"}},
      {"deg", {"deg", "degree", "degrees"}},
      {"rad", {"rad", "radian", "radians"}},
      {"ft", {"ft", "feet", "foot"}},
      {"m", {"m", "meter", "meters", "metre", "metres"}},
  };
  for (const Unit& unit : kUnits)
    if (std::find(units_of_kind.begin(), units_of_kind.end(), unit.unit) != units_of_kind.end() &&
        has_any(words, unit.words))
      return std::string(unit.unit);
  return {};
}

struct Candidate {
  NamedColumn column;
  std::size_t words;
};

class Recogniser {
 public:
  explicit Recogniser(const std::vector<std::string_view>& header) : header_(header) {
    for (const std::string_view name : header) words_.push_back(words_of(name));
  }

  std::optional<NamedColumn> find(Names names, Names units) const {
    std::optional<Candidate> best;
    for (std::size_t i = 0; i < header_.size(); ++i) {
      if (!has_any(words_[i], names) || is_left_out(words_[i])) continue;
      const std::size_t count = words_[i].size();
      if (best && best->words <= count) continue;
      best = Candidate{{std::string(header_[i]), i, unit_of(words_[i], units)}, count};
    }
    return best ? std::optional(best->column) : std::nullopt;
  }

  std::vector<NamedHeight> heights() const {
    std::vector<NamedHeight> found;
    for (std::size_t i = 0; i < header_.size(); ++i) {
      const Words& words = words_[i];
      if (!has_any(words, {"alt", "altitude", "height", "elevation", "hgt", "geoaltitude",
                           "baroaltitude", "hae", "msl", "amsl", "alti"}) ||
          is_left_out(words) ||
          has_any(words,
                  {"agl", "ground", "gnd", "terrain", "radio", "radar", "geoid", "decision"}))
        continue;
      NamedHeight height;
      height.name = std::string(header_[i]);
      height.index = i;
      height.unit = unit_of(words, {"m", "ft"});
      height.kind = kind_of(words);
      found.push_back(std::move(height));
    }
    std::stable_sort(found.begin(), found.end(), [](const NamedHeight& a, const NamedHeight& b) {
      return rank(a.kind) < rank(b.kind);
    });
    return found;
  }

 private:
  static bool is_left_out(const Words& words) {
    return has_any(
        words, {"rate",  "degps", "dps",     "rps", "selected", "sel",     "target",   "mcp",
                "fms",   "set",   "setting", "mag", "magnetic", "std",     "sigma",    "accuracy",
                "error", "count", "last",    "of",  "speed",    "command", "commanded"});
  }

  static HeightKind kind_of(const Words& words) {
    if (has_any(words, {"msl", "amsl", "egm96", "egm2008", "orthometric", "qnh"}))
      return HeightKind::sea_level;
    if (has_any(words, {"geom", "geometric", "ellipsoid", "ellipsoidal", "hae", "wgs84",
                        "geoaltitude", "geo", "gnss"}))
      return HeightKind::ellipsoid;
    if (has_any(words, {"baro", "barometric", "pressure", "baroaltitude", "qne", "press"}))
      return HeightKind::pressure;
    return HeightKind::unsaid;
  }

  static int rank(HeightKind kind) {
    return kind == HeightKind::pressure ? 2 : kind == HeightKind::unsaid ? 1 : 0;
  }

  const std::vector<std::string_view>& header_;
  std::vector<Words> words_;
};

}  // namespace

NamedColumns recognise_columns(const std::vector<std::string_view>& header) {
  const Recogniser recogniser(header);
  NamedColumns columns;
  columns.time = recogniser.find(
      {"time", "timestamp", "t", "utc", "epoch", "unix", "datetime", "date", "clock"}, {"s", "ms"});
  columns.latitude = recogniser.find({"lat", "latitude"}, {"deg", "rad"});
  columns.longitude = recogniser.find({"lon", "long", "lng", "longitude"}, {"deg", "rad"});
  columns.roll = recogniser.find({"roll", "bank", "phi"}, {"deg", "rad"});
  columns.pitch = recogniser.find({"pitch", "theta"}, {"deg", "rad"});
  columns.heading = recogniser.find({"heading", "hdg", "yaw", "psi"}, {"deg", "rad"});
  columns.heights = recogniser.heights();
  return columns;
}

}  // namespace fanbeam::scenes
