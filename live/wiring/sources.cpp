#include "live/wiring/sources.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/errors.h"
#include "live/journal.h"
#include "live/wiring/words.h"

namespace fanbeam::live {
namespace {

constexpr std::string_view kCsv = "csv:", kCigi = "cigi", kBeacon = "beacon";
constexpr std::string_view kDatum = "datum", kPeer = "peer", kWeather = "weather", kHost = "host";
constexpr std::array kSourceKeys{kDatum, kPeer, kWeather, kHost};
constexpr const char* kSources =
    "circle, ils, csv:FILE, native-fdm, fg-generic or cigi:[ADDRESS:]PORT, or "
    "xplane:[ADDRESS:]PORT or xplane:beacon, and ,datum=egm96 or ,datum=ellipsoid, ,peer=ADDRESS "
    "for each that may send, and ,weather=simulator or ,weather=scene; of cigi ,host=ADDRESS:PORT";

[[noreturn]] void refuse_source(const std::string& text, const char* expected) {
  core::throw_input_error(core::ErrorClass::ref, "--from", "\"" + text + "\"", expected);
}

void take_option(std::string_view key, const std::string& value, const std::string& source,
                 PosesFrom& from) {
  if (key == kDatum) {
    if (value != "egm96" && value != "ellipsoid")
      refuse_source(source, "datum=egm96 or datum=ellipsoid");
    from.datum = value == "egm96" ? core::VerticalDatum::egm96 : core::VerticalDatum::ellipsoid;
  } else if (key == kPeer) {
    from.peers.addresses.push_back(parse_address(value, "--from"));
  } else if (key == kWeather) {
    if (value != "simulator" && value != "scene")
      refuse_source(source, "weather=simulator or weather=scene");
    from.weather = value == "simulator";
  } else {
    from.host = parse_endpoint(value, "--from");
  }
}

// circle, ils or a file.
void check_flight(const std::string& source, const PosesFrom& from) {
  if (!from.peers.addresses.empty()) refuse_source(source, "peers of a source that listens");
  if (from.weather) refuse_source(source, "weather=simulator of a source that listens");
  if (from.host) refuse_source(source, "host= of cigi");
}

void check_simulator(const std::string& source, const PosesFrom& from) {
  if (from.cigi && from.weather) refuse_source(source, "no weather= of cigi: its packets set it");
  if (!from.cigi && from.host) refuse_source(source, "host= of cigi");
  if (from.subscribes() && !from.beacon && from.listens_at.port == 0)
    refuse_source(source, "a port from 1: where X-Plane listens");
  if (from.subscribes() && !from.peers.addresses.empty())
    refuse_source(source, "no peer= of xplane: only the simulator's own packets count");
  if (!from.subscribes() && from.listens_at.beyond_loopback && from.peers.addresses.empty())
    refuse_source(source, "beyond loopback also ,peer=ADDRESS, whose packets count");
}

}  // namespace

PosesFrom poses_from(const std::string& source) {
  PosesFrom from;
  from.source = source;
  const Worded words = worded(source, kSourceKeys);
  if (words.repeats(kPeer)) refuse_source(source, "each key once; ,peer= for each that may send");
  for (const auto& [key, value] : words.options) take_option(key, value, source, from);
  const std::string& text = words.head;
  from.circle = text == "circle";
  const bool file = text.starts_with(kCsv) && text.size() > kCsv.size();
  if (file) from.csv = text.substr(kCsv.size());
  if (from.circle || text == "ils" || file) {
    check_flight(source, from);
    const bool datum = std::any_of(words.options.begin(), words.options.end(),
                                   [](const auto& option) { return option.first == kDatum; });
    if (datum && !file) refuse_source(source, "no datum= of a flight that is built in");
    return from;
  }
  const std::size_t colon = text.find(':');
  const auto protocol =
      std::find_if(feeds::kProtocols.begin(), feeds::kProtocols.end(),
                   [&](const feeds::Protocol& one) { return text.substr(0, colon) == one.name; });
  from.cigi = text.substr(0, colon) == kCigi;
  if (colon == std::string::npos || (protocol == feeds::kProtocols.end() && !from.cigi))
    refuse_source(source, kSources);
  if (!from.cigi) from.protocol = &*protocol;
  const std::string place = text.substr(colon + 1);
  from.beacon = from.subscribes() && place == kBeacon;
  if (!from.beacon) from.listens_at = parse_endpoint(place, "--from");
  check_simulator(source, from);
  return from;
}

void check_together(const std::vector<PosesFrom>& sources) {
  core::ProblemList problems;
  const auto refuse = [&](const std::string& source, const char* expected) {
    problems.error(core::ErrorClass::ref, {}, "--from", "\"" + source + "\"", expected);
  };
  if (sources.size() > FlownBy::kMostSources)
    problems.error(core::ErrorClass::limit, {}, "--from", std::to_string(sources.size()),
                   "at most " + std::to_string(FlownBy::kMostSources) + " sources");
  bool asked = false, weather = false;
  for (const PosesFrom& from : sources) {
    if (sources.size() > 1 && (!from.listens() || from.cigi))
      refuse(from.source, "no other source beside it: simulators that send alone may be several");
    if (from.subscribes() && std::exchange(asked, true)) refuse(from.source, "one X-Plane");
    if (from.weather && std::exchange(weather, true))
      refuse(from.source, "the weather of one simulator");
  }
  problems.throw_if_errors();
}

}  // namespace fanbeam::live
