#include "live/desk.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/errors.h"
#include "core/json_node.h"
#include "core/png_bytes.h"
#include "core/units.h"
#include "live/page.h"

namespace fanbeam::live {
namespace {

using nlohmann::json;

constexpr core::JsonLimits kLimits{8, 100};

Answer json_answer(const json& value, int status = 200) {
  return {status, "application/json", value.dump(-1, ' ', true, json::error_handler_t::replace)};
}

Answer refusal(int status, const std::string& why) { return json_answer({{"error", why}}, status); }

Answer problems_answer(const std::vector<core::Problem>& problems) {
  json list = json::array();
  for (const core::Problem& problem : problems)
    list.push_back({{"code", problem.code},
                    {"field", problem.field},
                    {"value", problem.value},
                    {"expected", problem.expected}});
  return json_answer({{"problems", list}}, 422);
}

json errors_json(const std::optional<PictureErrors>& errors) {
  if (!errors) return nullptr;
  return {{"bscope_grey", errors->bscope_grey}, {"cscope_grey", errors->cscope_grey}};
}

json status_json(const Status& status) {
  json bad = json::object();
  for (const auto& [reason, count] : status.bad_packets) bad[reason] = count;
  return {
      {"scene", status.scene},
      {"source", status.source},
      {"caster", status.caster},
      {"frames", status.frames},
      {"late", status.late},
      {"refused", status.refused},
      {"refusal", status.refusal},
      {"wanted_Hz", status.wanted_Hz},
      {"rate_Hz", status.rate_Hz},
      {"frame_ms", status.frame_ms},
      {"slowest_ms", status.slowest_ms},
      {"pose_age_ms", status.pose_age_ms},
      {"samples", status.samples},
      {"errors", errors_json(status.errors)},
      {"waiting", status.waiting},
      {"stale", status.stale},
      {"packets", status.packets},
      {"bad_packets", bad},
      {"height_offset_m", status.height_offset_m ? json(*status.height_offset_m) : json(nullptr)}};
}

// Prometheus' text format, version 0.0.4.
std::string metrics_text(const Status& status) {
  std::string text;
  const auto add = [&](const char* name, const char* type, const char* help, double value) {
    text += std::string("# HELP fanbeam_") + name + " " + help + "\n# TYPE fanbeam_" + name + " " +
            type + "\nfanbeam_" + name + " " + core::number_text(value) + "\n";
  };
  std::uint64_t bad = 0;
  for (const auto& [reason, count] : status.bad_packets) bad += count;
  add("frames_total", "counter", "Frames rendered.", static_cast<double>(status.frames));
  add("late_total", "counter", "Ticks left out because a frame took longer than a period.",
      static_cast<double>(status.late));
  add("refused_total", "counter", "Poses that nothing can be rendered at.",
      static_cast<double>(status.refused));
  add("packets_total", "counter", "Datagrams of the source.", static_cast<double>(status.packets));
  add("bad_packets_total", "counter", "Datagrams of no use.", static_cast<double>(bad));
  add("rate_hertz", "gauge", "Frames a second, over two seconds.", status.rate_Hz);
  add("frame_seconds", "gauge", "Time that the last frame took.", 1e-3 * status.frame_ms);
  add("slowest_frame_seconds", "gauge", "Slowest frame of two seconds.", 1e-3 * status.slowest_ms);
  add("pose_age_seconds", "gauge", "Age of the newest pose.", 1e-3 * status.pose_age_ms);
  add("samples", "gauge", "Rays per range cell and column, or slices per column.", status.samples);
  if (status.errors) {
    add("bscope_error_grey_levels", "gauge", "RMS error of the B-scope with this sampling.",
        status.errors->bscope_grey);
    add("cscope_error_grey_levels", "gauge", "RMS error of the C-scope with this sampling.",
        status.errors->cscope_grey);
  }
  return text;
}

json plan_json(const scenes::Scene& scene) {
  json effects = json::array();
  for (const core::EffectDecision& decision : scene.plan.decisions)
    effects.push_back({{"effect", name_of(decision.effect)},
                       {"on", decision.on},
                       {"reason", decision.reason},
                       {"bound_grey", decision.bound_grey}});
  return {
      {"scene", scene.description.name}, {"accuracy_grey", scene.accuracy_grey}, {"plan", effects}};
}

json sensor_json(const sensors::Sensor& sensor) {
  const sensors::Display& display = sensor.display;
  return {{"name", sensor.name},
          {"columns", sensor.scan.columns},
          {"field_of_view_deg", core::degrees(sensor.scan.field_of_view_rad)},
          {"range_minimum_m", sensor.range.minimum_m},
          {"range_cell_m", sensor.range.cell_m},
          {"range_cells", sensor.range.cells},
          {"cscope_rows", display.cscope_rows},
          {"cscope_top_deg", core::degrees(display.cscope_top_rad)},
          {"cscope_span_deg", core::degrees(display.cscope_span_rad)},
          {"tilt_deg", core::degrees(sensor.antenna.boresight_elevation_rad)},
          {"low_dB", display.low_dB},
          {"high_dB", display.high_dB}};
}

json weather_json(const atmosphere::Weather& weather) {
  json result{{"rain_rate_mm_per_h", weather.rain_rate_mm_per_h}, {"visibility_m", nullptr}};
  if (weather.visibility_m) result["visibility_m"] = *weather.visibility_m;
  return result;
}

json truth_json(const CellTruth& cell) {
  json told{{"seen", cell.seen}};
  if (!cell.seen) return told;
  told["object"] = cell.object;
  told["material"] = cell.material.empty() ? json(nullptr) : json(cell.material);
  told["visibility"] = cell.visibility;
  told["double_bounce"] = cell.double_bounce;
  told["grazing_deg"] = core::degrees(cell.grazing_rad);
  told["nrcs_dB"] = cell.nrcs > 0.0 ? json(10.0 * std::log10(cell.nrcs)) : json(nullptr);
  return told;
}

// The value of `name` in "?a=1&b=2"; empty where there is none. Nothing is escaped in what is asked.
std::string word_in(const std::string& query, const std::string& name) {
  for (std::size_t at = 0; at < query.size();) {
    const std::size_t end = std::min(query.find('&', at + 1), query.size());
    if (query.compare(at + 1, name.size() + 1, name + "=") == 0)
      return query.substr(at + name.size() + 2, end - at - name.size() - 2);
    at = end;
  }
  return {};
}

int whole_in(const std::string& query, const std::string& name, core::ProblemList& problems) {
  const std::string word = word_in(query, name);
  int value = 0;
  const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || fault != std::errc() || end != word.data() + word.size() || value < 0)
    problems.error(core::ErrorClass::parse, {}, name, "\"" + word + "\"", "a whole number from 0");
  return value;
}

void refuse_others(const core::JsonNode& root, std::initializer_list<const char*> known) {
  for (const std::string& key : root.keys())
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      std::string names;
      for (const char* name : known) names += (names.empty() ? "" : ", ") + std::string(name);
      root.problems().error(core::ErrorClass::parse, root.place(), "/" + key, "unknown", names);
    }
}

void set_weather(session::Session& session, const core::JsonNode& root) {
  refuse_others(root, {"visibility_m", "rain_rate_mm_per_h"});
  atmosphere::Weather weather = session.scene()->weather;
  weather.visibility_m = root.member("visibility_m").number({10.0, 100e3});
  weather.liquid_water_g_per_m3.reset();
  weather.rain_rate_mm_per_h =
      root.required("rain_rate_mm_per_h").number({0.0, 300.0}).value_or(0.0);
  root.problems().throw_if_errors();
  session.set(weather);
}

void set_sensor(session::Session& session, const core::JsonNode& root) {
  refuse_others(root, {"tilt_deg", "low_dB", "high_dB"});
  session::SensorSettings settings;
  if (const auto tilt_deg = root.member("tilt_deg").number({-90.0, 90.0}))
    settings.boresight_elevation_rad = core::radians(*tilt_deg);
  settings.low_dB = root.member("low_dB").number({-400.0, 400.0});
  settings.high_dB = root.member("high_dB").number({-400.0, 400.0});
  root.problems().throw_if_errors();
  session.set(settings);
}

// "localhost:8416" to "localhost", "[::1]:8416" to "[::1]".
std::string without_port(const std::string& host) {
  const std::size_t bracket = host.find(']');
  const std::size_t colon = host.find(':', bracket == std::string::npos ? 0 : bracket);
  return host.substr(0, colon);
}

}  // namespace

bool is_admitted(const Request& request) {
  constexpr std::array kHere{"localhost", "127.0.0.1", "[::1]"};
  const std::string name = without_port(request.host);
  return std::find(kHere.begin(), kHere.end(), name) != kHere.end() &&
         (request.origin.empty() || request.origin == "http://" + request.host);
}

Answer Desk::answer(const Request& request) const {
  if (!is_admitted(request)) return refusal(403, "this machine answers to its own name alone");
  const std::size_t mark = std::min(request.target.find('?'), request.target.size());
  const std::string path = request.target.substr(0, mark);
  const bool asks = request.method == "GET" || request.method == "HEAD";
  if (!asks && request.method != "POST") return refusal(405, "GET, HEAD or POST");
  if (!asks && !request.content_type.starts_with("application/json"))
    return refusal(415, "content type application/json");
  try {
    return asks ? get(path, request.target.substr(mark)) : post(path, request.body);
  } catch (const core::InputError& error) {
    return problems_answer(error.problems());
  } catch (const std::exception& bug) {  // the pictures go on
    return refusal(500, std::string("a fault of fanbeam's: ") + bug.what());
  }
}

Answer Desk::cell(const std::string& query) const {
  core::ProblemList problems;
  const std::string name = word_in(query, "scope");
  if (name != "bscope" && name != "cscope")
    problems.error(core::ErrorClass::ref, {}, "scope", "\"" + name + "\"", "bscope or cscope");
  const int frame = whole_in(query, "frame", problems);
  const int column = whole_in(query, "column", problems), row = whole_in(query, "row", problems);
  problems.throw_if_errors();
  const Scope scope = name == "bscope" ? Scope::bscope : Scope::cscope;
  const auto found = truth_.at(static_cast<std::uint64_t>(frame), scope, column, row);
  json told{{"frame", frame}, {"scope", name}, {"column", column}, {"row", row}, {"gone", !found}};
  if (found) told.update(truth_json(*found));
  return json_answer(told);
}

Answer Desk::get(const std::string& path, const std::string& query) const {
  if (path == "/api/cell") return cell(query);
  if (path == "/") return {200, "text/html; charset=utf-8", page()};
  if (path == "/api/status") return json_answer(status_json(hub_.status()));
  if (path == "/metrics")
    return {200, "text/plain; version=0.0.4; charset=utf-8", metrics_text(hub_.status())};
  const std::shared_ptr<const scenes::Scene> scene = session_.scene();
  if (path == "/api/plan") return json_answer(plan_json(*scene));
  if (path == "/api/sensor") return json_answer(sensor_json(scene->description.sensor));
  if (path == "/api/weather") return json_answer(weather_json(scene->weather));
  const bool bscope = path == "/frame/bscope.png";
  if (!bscope && path != "/frame/cscope.png") return refusal(404, "no such page");
  const std::shared_ptr<const LiveFrame> frame = hub_.newest();
  if (!frame) return refusal(503, "no frame yet");
  return {200, "image/png", core::png_bytes(bscope ? frame->bscope : frame->cscope)};
}

Answer Desk::post(const std::string& path, const std::string& body) const {
  const bool weather = path == "/api/weather";
  if (!weather && path != "/api/sensor") return refusal(404, "no such control");
  core::ProblemList problems;
  const auto file = core::parse_json(body, "body", kLimits, problems);
  problems.throw_if_errors();
  const core::JsonNode root(*file, problems);
  {
    std::unique_lock<std::mutex> quiet;
    if (journal_ != nullptr) quiet = journal_->quiet();
    if (weather)
      set_weather(session_, root);
    else
      set_sensor(session_, root);
    if (journal_ != nullptr) journal_->control(path, body);
  }
  return get(path, {});
}

std::string message_of(const LiveFrame& frame) {
  const core::Attitude attitude = core::attitude_from(frame.pose.q_NB);
  const json head{{"number", frame.number},
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
                  {"outside_volume", frame.outside_volume}};
  std::string message = head.dump() + "\n";
  message.append(frame.bscope.pixels.begin(), frame.bscope.pixels.end());
  message.append(frame.cscope.pixels.begin(), frame.cscope.pixels.end());
  return message;
}

}  // namespace fanbeam::live
