#include "apps/live_wiring.h"

#include <algorithm>
#include <cstdlib>

namespace fanbeam::apps {
namespace {

using Scope = live::RawFrames::Scope;

constexpr std::string_view kCsv = "csv:", kShared = "shm:", kRawBscope = "raw-bscope:",
                           kRawCscope = "raw-cscope:";
constexpr std::string_view kDatum = ",datum=", kPeer = ",peer=", kWeather = ",weather=",
                           kHost = ",host=", kCigi = "cigi";
constexpr const char* kSources =
    "circle, ils, csv:FILE, or native-fdm, fg-generic or cigi:[ADDRESS:]PORT, and "
    ",datum=egm96 or ,datum=ellipsoid, ,peer=ADDRESS for each that may send, and "
    ",weather=simulator or ,weather=scene; of cigi ,host=ADDRESS:PORT";
constexpr const char* kToken = "FANBEAM_TOKEN";

[[noreturn]] void refuse_source(const std::string& text, const char* expected) {
  core::throw_input_error(core::ErrorClass::ref, "--from", "\"" + text + "\"", expected);
}

void take_datum(const std::string& source, const std::string& name, PosesFrom& from) {
  if (name != "egm96" && name != "ellipsoid")
    refuse_source(source, "datum=egm96 or datum=ellipsoid");
  from.datum = name == "egm96" ? core::VerticalDatum::egm96 : core::VerticalDatum::ellipsoid;
}

void take_weather(const std::string& source, const std::string& whose, PosesFrom& from) {
  if (whose != "simulator" && whose != "scene")
    refuse_source(source, "weather=simulator or weather=scene");
  from.weather = whose == "simulator";
}

// Leaves of the source what stands before its options, in any order.
std::string without_options(std::string text, PosesFrom& from) {
  const std::string source = text;
  for (;;) {
    const std::size_t at = text.rfind(',');
    const auto option = [&](std::string_view key) -> std::optional<std::string> {
      if (at == std::string::npos || text.compare(at, key.size(), key) != 0) return std::nullopt;
      return text.substr(at + key.size());
    };
    if (const auto datum = option(kDatum))
      take_datum(source, *datum, from);
    else if (const auto peer = option(kPeer))
      from.peers.addresses.push_back(live::parse_address(*peer, "--from"));
    else if (const auto whose = option(kWeather))
      take_weather(source, *whose, from);
    else if (const auto host = option(kHost))
      from.host = live::parse_endpoint(*host, "--from");
    else
      return text;
    text.resize(at);
  }
}

PosesFrom poses_from(const std::string& source) {
  PosesFrom from;
  const std::string text = without_options(source, from);
  from.circle = text == "circle";
  const bool file = text.starts_with(kCsv) && text.size() > kCsv.size();
  if (file) from.csv = text.substr(kCsv.size());
  if (from.circle || text == "ils" || file) {
    if (!from.peers.addresses.empty()) refuse_source(source, "peers of a source that listens");
    if (from.weather) refuse_source(source, "weather=simulator of a source that listens");
    if (from.host) refuse_source(source, "host= of cigi");
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
  if (from.cigi && from.weather) refuse_source(source, "no weather= of cigi: its packets set it");
  if (!from.cigi && from.host) refuse_source(source, "host= of cigi");
  from.listens_at = live::parse_endpoint(text.substr(colon + 1), "--from");
  if (from.listens_at.beyond_loopback && from.peers.addresses.empty())
    refuse_source(source, "beyond loopback also ,peer=ADDRESS, whose packets count");
  return from;
}

void add_sink(const std::string& text, Wiring& wiring) {
  if (text.starts_with(kShared))
    wiring.shared.push_back(text.substr(kShared.size()));
  else if (text.starts_with(kRawBscope))
    wiring.raw.push_back({Scope::bscope, text.substr(kRawBscope.size())});
  else if (text.starts_with(kRawCscope))
    wiring.raw.push_back({Scope::cscope, text.substr(kRawCscope.size())});
  else
    core::throw_input_error(core::ErrorClass::ref, "--to", "\"" + text + "\"",
                            "shm:NAME, raw-bscope:FILE or raw-cscope:FILE");
}

// Of the file or, without one, of the environment.
live::Access access_of(const LiveOptions& options) {
  if (!options.token_file.empty()) return live::access_from(options.token_file);
  const char* token = std::getenv(kToken);
  return token == nullptr ? live::Access() : live::Access(token, core::Place{kToken});
}

// Set by the clock, it would come to other frames each time.
void check_weather(const LiveOptions& options, const Wiring& wiring) {
  if (wiring.from.weather && options.lockstep)
    core::throw_input_error(core::ErrorClass::unsupported, "--lockstep", "with weather=simulator",
                            "weather=scene: in lockstep the bytes depend on poses alone");
}

void check_record(const LiveOptions& options, const Wiring& wiring) {
  if (wiring.from.cigi && !options.record.empty())
    core::throw_input_error(core::ErrorClass::unsupported, "--record", "\"" + options.record + "\"",
                            "another source: a CIGI host is not recorded");
}

void check_page(const std::string& text, const Wiring& wiring) {
  if (wiring.page.beyond_loopback && !wiring.access.has_token())
    core::throw_input_error(core::ErrorClass::unsupported, "--http", "\"" + text + "\"",
                            "beyond loopback a token too: --token-file FILE or FANBEAM_TOKEN");
}

}  // namespace

bool Wiring::takes_stdout() const {
  return std::any_of(raw.begin(), raw.end(), [](const RawSink& sink) { return sink.file == "-"; });
}

Wiring wiring_of(const LiveOptions& options) {
  Wiring wiring;
  core::ProblemList problems;
  const auto collect = [&](const auto& parse) {
    try {
      parse();
    } catch (const core::InputError& error) {
      problems.append(error.problems());
    }
  };
  collect([&] { wiring.page = live::parse_endpoint(options.http, "--http"); });
  collect([&] { wiring.from = poses_from(options.from); });
  collect([&] { wiring.access = access_of(options); });
  for (const std::string& sink : options.to) collect([&] { add_sink(sink, wiring); });
  collect([&] { check_page(options.http, wiring); });
  collect([&] { check_record(options, wiring); });
  if (options.replay.empty()) collect([&] { check_weather(options, wiring); });
  problems.throw_if_errors();
  return wiring;
}

Sinks::Sinks(const Wiring& wiring, const sensors::Sensor& sensor, double rate_Hz,
             bool every_frame) {
  for (const std::string& name : wiring.shared)
    shared_.push_back(std::make_unique<live::SharedFrames>(name, sensor, rate_Hz));
  for (const RawSink& sink : wiring.raw)
    raw_.push_back(std::make_unique<live::RawFrames>(sink.scope, sink.file, every_frame));
}

void Sinks::write(const std::shared_ptr<const live::LiveFrame>& frame) {
  if (!frame) return;
  for (const auto& ring : shared_)
    if (frame->number != ring->newest()) ring->write(*frame);
  for (const auto& raw : raw_) raw->write(frame);
}

bool Sinks::any_ended() const {
  return std::any_of(raw_.begin(), raw_.end(), [](const auto& raw) { return raw->ended(); });
}

}  // namespace fanbeam::apps
