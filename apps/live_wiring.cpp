#include "apps/live_wiring.h"

#include <algorithm>

namespace fanbeam::apps {
namespace {

using Scope = live::RawFrames::Scope;

constexpr std::string_view kCsv = "csv:", kShared = "shm:", kRawBscope = "raw-bscope:",
                           kRawCscope = "raw-cscope:";
constexpr const char* kSources =
    "circle, ils, csv:FILE, native-fdm:[ADDRESS:]PORT or fg-generic:[ADDRESS:]PORT";

PosesFrom poses_from(const std::string& text) {
  PosesFrom from;
  from.circle = text == "circle";
  if (from.circle || text == "ils") return from;
  if (text.starts_with(kCsv) && text.size() > kCsv.size()) {
    from.csv = text.substr(kCsv.size());
    return from;
  }
  const std::size_t colon = text.find(':');
  const auto protocol =
      std::find_if(feeds::kProtocols.begin(), feeds::kProtocols.end(),
                   [&](const feeds::Protocol& one) { return text.substr(0, colon) == one.name; });
  if (colon == std::string::npos || protocol == feeds::kProtocols.end())
    core::throw_input_error(core::ErrorClass::ref, "--from", "\"" + text + "\"", kSources);
  from.protocol = &*protocol;
  from.listens_at = live::parse_endpoint(text.substr(colon + 1), "--from");
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
  for (const std::string& sink : options.to) collect([&] { add_sink(sink, wiring); });
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
