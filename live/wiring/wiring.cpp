#include "live/wiring/wiring.h"

#include <algorithm>

#include "core/errors.h"

namespace fanbeam::live {
namespace {

// Of the file or, without one, of the environment.
Access access_of(const RunSettings& settings, const char* token) {
  if (!settings.token_file.empty()) return access_from(settings.token_file);
  const bool none = token == nullptr || *token == '\0';
  return none ? Access() : Access(token, core::Place{kTokenVariable});
}

// Of a recording its first line names the sources, and no option.
std::vector<core::Problem> of_sources(std::vector<core::Problem> problems,
                                      const std::string& replay) {
  if (!replay.empty())
    for (core::Problem& problem : problems) {
      problem.place = {replay, 1};
      problem.field = "/from";
    }
  return problems;
}

void check_one_source(const RunSettings& settings, const Wiring& wiring) {
  if (settings.lockstep && wiring.from.size() > 1)
    core::throw_input_error(core::ErrorClass::unsupported, "--lockstep", "with several sources",
                            "one: each of its poses makes a picture");
}

// Set by the clock, it would come to other frames each time.
void check_weather(const RunSettings& settings, const Wiring& wiring) {
  const bool weather = std::any_of(wiring.from.begin(), wiring.from.end(),
                                   [](const PosesFrom& from) { return from.weather; });
  if (weather && settings.lockstep)
    core::throw_input_error(core::ErrorClass::unsupported, "--lockstep", "with weather=simulator",
                            "weather=scene: in lockstep the bytes depend on poses alone");
}

void check_record(const RunSettings& settings, const Wiring& wiring) {
  if (wiring.first().cigi && !settings.record.empty())
    core::throw_input_error(core::ErrorClass::unsupported, "--record",
                            "\"" + settings.record + "\"",
                            "another source: a CIGI host is not recorded");
}

// Of lines among pictures neither could be read.
void check_record_apart(const RunSettings& settings, const Wiring& wiring) {
  // To --record "-" is a file of that name.
  const std::string file = settings.record == "-" ? "./-" : settings.record;
  if (!file.empty() && wiring.to.write_into(file))
    core::throw_input_error(core::ErrorClass::ref, "--record", "\"" + settings.record + "\"",
                            "another file than --to writes");
}

void check_page(const std::string& text, const Wiring& wiring) {
  if (wiring.page.beyond_loopback && !wiring.access.has_token())
    core::throw_input_error(core::ErrorClass::unsupported, "--http", "\"" + text + "\"",
                            "beyond loopback a token too: --token-file FILE or FANBEAM_TOKEN");
}

}  // namespace

Wiring wiring_of(const RunSettings& settings, const char* token) {
  Wiring wiring;
  core::ProblemList problems;
  const auto collect = [&](const auto& parse, const std::string& replay = {}) {
    try {
      parse();
    } catch (const core::InputError& error) {
      problems.append(of_sources(error.problems(), replay));
    }
  };
  collect([&] { wiring.page = parse_endpoint(settings.http, "--http"); });
  for (const std::string& source : settings.from)
    collect([&] { wiring.from.push_back(poses_from(source)); }, settings.replay);
  collect([&] { check_together(wiring.from); }, settings.replay);
  collect([&] { wiring.access = access_of(settings, token); });
  for (const std::string& sink : settings.to) collect([&] { add_sink(sink, wiring.to); });
  collect([&] { check_page(settings.http, wiring); });
  if (!wiring.from.empty()) collect([&] { check_record(settings, wiring); });
  collect([&] { check_record_apart(settings, wiring); });
  if (settings.replay.empty()) {
    collect([&] { check_one_source(settings, wiring); });
    collect([&] { check_weather(settings, wiring); });
  }
  problems.throw_if_errors();
  return wiring;
}

}  // namespace fanbeam::live
