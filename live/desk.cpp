#include "live/desk.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "core/json_node.h"
#include "core/picture_bytes.h"
#include "core/spelling.h"
#include "core/text.h"
#include "core/units.h"
#include "live/answers_private.h"
#include "live/page.h"
#include "sensors/display/grey_scale.h"

namespace fanbeam::live {
namespace {

constexpr core::JsonLimits kLimits{8, 100};
constexpr const char *kWeather = "/api/weather", *kSensor = "/api/sensor", *kCell = "/api/cell",
                     *kBscope = "/frame/bscope.png";

// What answers a GET, with the keys of its query; streams and the WebSocket apart.
const std::map<std::string, std::vector<std::string>> kPages{
    {"/", {"token"}},
    {"/metrics", {}},
    {"/api/openapi.json", {}},
    {"/api/status", {}},
    {"/api/map", {}},
    {"/api/plan", {}},
    {kWeather, {}},
    {kSensor, {}},
    {kBscope, {"gain_dB"}},
    {"/frame/cscope.png", {"gain_dB"}},
    {kCell, {"scope", "frame", "column", "row"}}};

Answer json_answer(const Json& value, int status = 200) {
  return {status, "application/json", value.dump(-1, ' ', true, Json::error_handler_t::replace)};
}

Answer problems_answer(const std::vector<core::Problem>& problems) {
  Json list = Json::array();
  for (const core::Problem& problem : problems)
    list.push_back({{"code", problem.code},
                    {"field", problem.field},
                    {"value", problem.value},
                    {"expected", problem.expected}});
  return json_answer({{"problems", list}}, 422);
}

// Keys and values of "?a=1&b=2". Nothing is escaped in what is asked.
std::vector<std::pair<std::string, std::string>> words_in(const std::string& query) {
  std::vector<std::pair<std::string, std::string>> words;
  for (std::size_t at = 0; at + 1 < query.size();) {
    const std::size_t end = std::min(query.find('&', at + 1), query.size());
    const std::string word = query.substr(at + 1, end - at - 1);
    const std::size_t sign = std::min(word.find('='), word.size());
    words.emplace_back(word.substr(0, sign), word.substr(std::min(sign + 1, word.size())));
    at = end;
  }
  return words;
}

std::optional<std::string> word_in(const std::string& query, const std::string& name) {
  for (const auto& [key, value] : words_in(query))
    if (key == name) return value;
  return std::nullopt;
}

// "n" means nothing: with another one each time a browser asks anew.
std::vector<std::string> query_keys(const std::string& path) {
  std::vector<std::string> keys;
  if (const auto page = kPages.find(path); page != kPages.end()) keys = page->second;
  keys.emplace_back("n");
  return keys;
}

void check_query(const std::string& query, const std::vector<std::string>& known,
                 core::ProblemList& problems) {
  std::set<std::string> met;
  for (const auto& [key, value] : words_in(query)) {
    if (std::find(known.begin(), known.end(), key) == known.end())
      problems.error(core::ErrorClass::ref, {}, key, "unknown",
                     "a key of this path" + core::names_there_text(key, known));
    else if (!met.insert(key).second)
      problems.error(core::ErrorClass::ref, {}, key, "given twice", "each key once");
  }
}

std::optional<int> whole_in(const std::string& query, const std::string& name,
                            core::ProblemList& problems) {
  const std::string word = word_in(query, name).value_or("");
  int value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (!word.empty() && fault == std::errc() && end == word.data() + word.size() && value >= 0)
    return value;
  problems.error(core::ErrorClass::parse, {}, name, "\"" + word + "\"",
                 "a whole number from 0 to " + std::to_string(std::numeric_limits<int>::max()));
  return std::nullopt;
}

bool is_control(const std::string& path) { return path == kWeather || path == kSensor; }

double gain_in(const std::string& word, core::ProblemList& problems) {
  const core::ParsedNumber gain_dB = core::parse_number(word);
  if (gain_dB.error == core::NumberError::none && std::abs(gain_dB.value) <= 60.0)
    return gain_dB.value;
  problems.error(core::ErrorClass::range, {}, "gain_dB", "\"" + word + "\"", "-60 to 60");
  return 0.0;
}

// By so much of the scale.
void amplify(core::Picture8& picture, double share) {
  const auto steps = static_cast<int>(std::lround(255.0 * std::clamp(share, -1.0, 1.0)));
  for (std::uint8_t& grey : picture.pixels)
    grey = static_cast<std::uint8_t>(std::clamp(grey + steps, 0, 255));
}

// From corner to corner, white beside black: on any ground, and in a smaller copy too.
void cross_out(core::Picture8& picture) {
  constexpr int kWide = 4;
  if (picture.pixels.empty()) return;
  const int steps = std::max(picture.columns, picture.rows);
  const auto at = [&](int step, int size) { return step * (size - 1) / steps; };
  for (int step = 0; step <= steps; ++step)
    for (int beside = 0; beside < kWide; ++beside) {
      const int row = at(step, picture.rows), column = at(step, picture.columns) + beside;
      if (column >= picture.columns) continue;
      for (const int x : {column, picture.columns - 1 - column})
        picture.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns) +
                       static_cast<std::size_t>(x)] = 2 * beside < kWide ? 255 : 0;
    }
}

void refuse_others(const core::JsonNode& root, std::initializer_list<const char*> known) {
  for (const std::string& key : root.keys())
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string names;
      for (const char* name : known) names += (names.empty() ? "" : ", ") + std::string(name);
      root.problems().error(core::ErrorClass::parse, root.place(), "/" + key, "unknown", names);
    }
}

// With values that are wrong by themselves goes what is wrong with the others together.
template <class Check>
void refuse_with(core::ProblemList& problems, const Check& together) {
  if (!problems.has_errors()) return;
  const core::ProblemList found = together();
  for (const core::Problem& problem : found.all())
    if (problem.is_error()) problems.append({problem});
  problems.throw_if_errors();
}

void set_weather(session::Session& session, const core::JsonNode& root) {
  refuse_others(root,
                {"visibility_m", "rain_rate_mm_per_h", "snow_rate_mm_per_h", "melting_layer"});
  atmosphere::Weather weather = session.scene()->weather;
  // Posted back as it is told, fog that is told by its water keeps it to the digit.
  if (const auto visibility_m = root.member("visibility_m").number({10.0, 100e3});
      visibility_m != told_visibility_m(weather)) {
    weather.visibility_m = visibility_m;
    weather.liquid_water_g_per_m3.reset();
  }
  const bool melts = atmosphere::precipitation_layers(weather).melting;
  if (const core::JsonNode told = root.member("melting_layer");
      told.flag().value_or(melts) != melts)
    told.error(core::ErrorClass::unsupported, "as it is told: the scene's own");
  weather.rain_rate_mm_per_h =
      root.required("rain_rate_mm_per_h").number({0.0, 300.0}).value_or(0.0);
  weather.snow_rate_mm_per_h = root.member("snow_rate_mm_per_h").number({0.0, 50.0}).value_or(0.0);
  refuse_with(root.problems(), [&] {
    const double frequency_Hz = session.scene()->description.sensor.waveform.frequency_Hz;
    return atmosphere::problems_in(weather, frequency_Hz);
  });
  session.set(weather);
}

void set_sensor(session::Session& session, const core::JsonNode& root) {
  refuse_others(root, {"tilt_deg", "low_dB", "high_dB"});
  session::SensorSettings settings;
  if (const auto tilt_deg = root.member("tilt_deg").number({-90.0, 90.0}))
    settings.boresight_elevation_rad = core::radians(*tilt_deg);
  const core::JsonNode low_dB = root.member("low_dB"), high_dB = root.member("high_dB");
  settings.low_dB = low_dB.number({-400.0, 400.0});
  settings.high_dB = high_dB.number({-400.0, 400.0});
  // Posted back as they are told: those of a display that has no others to set stay.
  const sensors::Sensor sensor = session.scene()->description.sensor;
  const sensors::GreyScale grey(sensor);
  if (sensor.display.mapping == sensors::Display::Mapping::seed &&
      settings.low_dB == grey.low_dB() && settings.high_dB == grey.high_dB())
    settings.low_dB = settings.high_dB = std::nullopt;
  refuse_with(root.problems(), [&] {
    // Beside a level that is wrong the other is neither below nor above.
    if (low_dB.present() != settings.low_dB.has_value() ||
        high_dB.present() != settings.high_dB.has_value())
      settings.low_dB = settings.high_dB = std::nullopt;
    return session.problems_in(settings);
  });
  session.set(settings);
}

}  // namespace

Answer refusal(int status, const std::string& why) { return json_answer({{"error", why}}, status); }

bool Desk::renders(const Request& request) { return request.path() == kCell; }

std::optional<Answer> Desk::refuse_query(const Request& request) {
  core::ProblemList problems;
  const std::string path = request.path();
  check_query(request.target.substr(path.size()), query_keys(path), problems);
  if (!problems.has_errors()) return std::nullopt;
  return problems_answer(problems.all());
}

Answer Desk::answer(const Request& request) const {
  if (const std::optional<Answer> refused = access_.refuse(request)) return *refused;
  const std::string path = request.path();
  const bool asks = request.method == "GET" || request.method == "HEAD";
  if (!asks && request.method != "POST") {
    Answer refused = refusal(405, "GET, HEAD or POST");
    refused.allow = is_control(path) ? "GET, HEAD, POST" : "GET, HEAD";
    return refused;
  }
  if (!asks && !request.content_type.starts_with("application/json"))
    return refusal(415, "content type application/json");
  try {
    if (asks) return get(path, request.target.substr(path.size()));
    if (!is_control(path)) return refusal(404, "no such control");
    if (replays_) return refusal(409, "a recording is flown");
    core::ProblemList problems;
    check_query(request.target.substr(path.size()), {}, problems);
    problems.throw_if_errors();
    control(path, request.body);
    return get(path, {});
  } catch (const core::InputError& error) {
    return problems_answer(error.problems());
  } catch (const std::exception& bug) {  // the pictures go on
    return refusal(500, std::string("a fault of fanbeam's: ") + bug.what());
  }
}

Answer Desk::cell(const std::string& query, core::ProblemList& problems) const {
  const std::string name = word_in(query, "scope").value_or("");
  std::optional<Scope> scope;
  if (name == "bscope" || name == "cscope")
    scope = name == "bscope" ? Scope::bscope : Scope::cscope;
  else
    problems.error(core::ErrorClass::ref, {}, "scope", "\"" + name + "\"", "bscope or cscope");
  const auto frame = whole_in(query, "frame", problems);
  const auto column = whole_in(query, "column", problems), row = whole_in(query, "row", problems);
  // Else it is asked of the frame itself; pictures of all frames have as many cells.
  if (problems.has_errors())
    check_cell(session_.scene()->description.sensor, scope, column, row, problems);
  problems.throw_if_errors();
  const auto found = truth_.at(static_cast<std::uint64_t>(*frame), *scope, *column, *row);
  Json told{
      {"frame", *frame}, {"scope", name}, {"column", *column}, {"row", *row}, {"gone", !found}};
  if (found) told.update(truth_json(*found));
  return json_answer(told);
}

Answer Desk::get(const std::string& path, const std::string& query) const {
  if (!kPages.contains(path)) return refusal(404, "no such page");
  core::ProblemList problems;
  check_query(query, query_keys(path), problems);
  if (path == kCell) return cell(query, problems);
  if (path.starts_with("/frame/")) return picture(path == kBscope, query, problems);
  problems.throw_if_errors();
  if (path == "/") return {200, "text/html; charset=utf-8", page()};
  if (path == "/api/openapi.json") return {200, "application/json", openapi()};
  if (path == "/api/status") return json_answer(status_json(hub_.status()));
  if (path == "/metrics")
    return {200, "text/plain; version=0.0.4; charset=utf-8", metrics_text(hub_.status())};
  const std::shared_ptr<const scenes::Scene> scene = session_.scene();
  if (path == "/api/map") return json_answer(map_json(*scene));
  if (path == "/api/plan") return json_answer(plan_json(*scene));
  if (path == kSensor) return json_answer(sensor_json(scene->description.sensor));
  return json_answer(weather_json(scene->weather));
}

Answer Desk::picture(bool bscope, const std::string& query, core::ProblemList& problems) const {
  const std::optional<std::string> gain = word_in(query, "gain_dB");
  const double gain_dB = gain ? gain_in(*gain, problems) : 0.0;
  problems.throw_if_errors();
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  if (!frame) return refusal(503, "no frame yet");
  const Scope scope = bscope ? Scope::bscope : Scope::cscope;
  return {200, "image/png", core::png_bytes(picture_to_show(*frame, scope, gain_dB))};
}

void Desk::control(const std::string& path, const std::string& body) const {
  const std::lock_guard<std::mutex> lock(controls_);
  obey(path, body);
}

void Desk::change_weather(
    const std::function<std::string(const atmosphere::Weather&)>& body_of) const {
  const std::lock_guard<std::mutex> lock(controls_);
  obey(kWeather, body_of(session_.scene()->weather));
}

void Desk::obey(const std::string& path, const std::string& body) const {
  if (!is_control(path))
    core::throw_input_error(core::ErrorClass::ref, "control", "\"" + path + "\"",
                            std::string(kWeather) + " or " + kSensor);
  core::ProblemList problems;
  const auto file = core::parse_json(body, "body", kLimits, problems);
  problems.throw_if_errors();
  const core::JsonNode root(*file, problems);
  std::unique_lock<std::mutex> quiet;
  if (journal_ != nullptr) quiet = journal_->quiet();
  if (path == kWeather)
    set_weather(session_, root);
  else
    set_sensor(session_, root);
  if (journal_ != nullptr) journal_->control(path, body);
}

std::string message_of(const LiveFrame& frame) {
  const core::Attitude attitude = core::attitude_from(frame.pose.q_NB);
  const Json head{{"number", frame.number},
                  {"bscope", {frame.bscope.columns, frame.bscope.rows}},
                  {"cscope", {frame.cscope.columns, frame.cscope.rows}},
                  {"latitude_deg", core::degrees(frame.pose.position.latitude_rad)},
                  {"longitude_deg", core::degrees(frame.pose.position.longitude_rad)},
                  {"height_m", frame.pose.position.height_m},
                  {"roll_deg", core::degrees(attitude.roll_rad)},
                  {"pitch_deg", core::degrees(attitude.pitch_rad)},
                  {"heading_deg", core::degrees(attitude.heading_rad)},
                  {"samples", frame.samples},
                  {"errors", errors_json(frame.errors)},
                  {"frame_ms", frame.frame_ms},
                  {"pose_age_ms", frame.pose_age_ms},
                  {"began_s", frame.began_s},
                  {"outside_volume", frame.outside_volume},
                  {"stale", frame.stale},
                  {"low_dB", frame.low_dB},
                  {"high_dB", frame.high_dB},
                  {"cscope_top_deg", core::degrees(frame.cscope_top_rad)}};
  std::string message = head.dump() + "\n";
  message.append(frame.bscope.pixels.begin(), frame.bscope.pixels.end());
  message.append(frame.cscope.pixels.begin(), frame.cscope.pixels.end());
  return message;
}

core::Picture8 picture_to_show(const LiveFrame& frame, Scope scope, double gain_dB) {
  core::Picture8 picture = scope == Scope::bscope ? frame.bscope : frame.cscope;
  if (gain_dB != 0.0) amplify(picture, gain_dB / (frame.high_dB - frame.low_dB));
  if (frame.stale) cross_out(picture);
  return picture;
}

}  // namespace fanbeam::live
