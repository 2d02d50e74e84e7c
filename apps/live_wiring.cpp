#include "apps/live_wiring.h"

#include <algorithm>
#include <cstdlib>

namespace fanbeam::apps {
namespace {

using Scope = live::RawFrames::Scope;

constexpr std::string_view kCsv = "csv:", kShared = "shm:", kRawBscope = "raw-bscope:",
                           kRawCscope = "raw-cscope:";
constexpr std::string_view kDatum = ",datum=", kPeer = ",peer=";
constexpr const char* kSources =
    "circle, ils, csv:FILE, native-fdm:[ADDRESS:]PORT or fg-generic:[ADDRESS:]PORT, and "
    ",datum=egm96 or ,datum=ellipsoid, and ,peer=ADDRESS for each that may send";
constexpr const char* kToken = "FANBEAM_TOKEN";

[[noreturn]] void refuse_source(const std::string& text, const char* expected) {
  core::throw_input_error(core::ErrorClass::ref, "--from", "\"" + text + "\"", expected);
}

// Takes what follows the last `key` off the text; nothing where it has none.
std::optional<std::string> taken_off(std::string& text, std::string_view key) {
  const std::size_t at = text.rfind(key);
  if (at == std::string::npos) return std::nullopt;
  std::string value = text.substr(at + key.size());
  text.resize(at);
  return value;
}

void take_datum(const std::string& source, const std::string& name, PosesFrom& from) {
  if (name != "egm96" && name != "ellipsoid")
    refuse_source(source, "datum=egm96 or datum=ellipsoid");
  from.datum = name == "egm96" ? core::VerticalDatum::egm96 : core::VerticalDatum::ellipsoid;
}

// Leaves of the source what stands before its options, in any order.
std::string without_options(std::string text, PosesFrom& from) {
  const std::string source = text;
  for (;;) {
    const std::size_t datum = text.rfind(kDatum), peer = text.rfind(kPeer);
    const bool datum_last =
        datum != std::string::npos && (peer == std::string::npos || datum > peer);
    if (datum_last)
      take_datum(source, *taken_off(text, kDatum), from);
    else if (const auto address = taken_off(text, kPeer))
      from.peers.addresses.push_back(live::parse_address(*address, "--from"));
    else
      return text;
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
    return from;
  }
  const std::size_t colon = text.find(':');
  const auto protocol =
      std::find_if(feeds::kProtocols.begin(), feeds::kProtocols.end(),
                   [&](const feeds::Protocol& one) { return text.substr(0, colon) == one.name; });
  if (colon == std::string::npos || protocol == feeds::kProtocols.end())
    refuse_source(source, kSources);
  from.protocol = &*protocol;
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
