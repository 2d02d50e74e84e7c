#include "apps/live_wiring.h"

#include <algorithm>
#include <cstdlib>

namespace fanbeam::apps {
namespace {

constexpr const char* kToken = "FANBEAM_TOKEN";

// Of the file or, without one, of the environment.
live::Access access_of(const LiveOptions& options) {
  if (!options.token_file.empty()) return live::access_from(options.token_file);
  const char* token = std::getenv(kToken);
  return token == nullptr ? live::Access() : live::Access(token, core::Place{kToken});
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

void check_one_source(const LiveOptions& options, const Wiring& wiring) {
  if (options.lockstep && wiring.from.size() > 1)
    core::throw_input_error(core::ErrorClass::unsupported, "--lockstep", "with several sources",
                            "one: each of its poses makes a picture");
}

// Set by the clock, it would come to other frames each time.
void check_weather(const LiveOptions& options, const Wiring& wiring) {
  const bool weather = std::any_of(wiring.from.begin(), wiring.from.end(),
                                   [](const live::PosesFrom& from) { return from.weather; });
  if (weather && options.lockstep)
    core::throw_input_error(core::ErrorClass::unsupported, "--lockstep", "with weather=simulator",
                            "weather=scene: in lockstep the bytes depend on poses alone");
}

void check_record(const LiveOptions& options, const Wiring& wiring) {
  if (wiring.first().cigi && !options.record.empty())
    core::throw_input_error(core::ErrorClass::unsupported, "--record", "\"" + options.record + "\"",
                            "another source: a CIGI host is not recorded");
}

void check_page(const std::string& text, const Wiring& wiring) {
  if (wiring.page.beyond_loopback && !wiring.access.has_token())
    core::throw_input_error(core::ErrorClass::unsupported, "--http", "\"" + text + "\"",
                            "beyond loopback a token too: --token-file FILE or FANBEAM_TOKEN");
}

}  // namespace

Wiring wiring_of(const LiveOptions& options) {
  Wiring wiring;
  core::ProblemList problems;
  const auto collect = [&](const auto& parse, const std::string& replay = {}) {
    try {
      parse();
    } catch (const core::InputError& error) {
      problems.append(of_sources(error.problems(), replay));
    }
  };
  collect([&] { wiring.page = live::parse_endpoint(options.http, "--http"); });
  for (const std::string& source : options.from)
    collect([&] { wiring.from.push_back(live::poses_from(source)); }, options.replay);
  collect([&] { live::check_together(wiring.from); }, options.replay);
  collect([&] { wiring.access = access_of(options); });
  for (const std::string& sink : options.to) collect([&] { live::add_sink(sink, wiring.to); });
  collect([&] { check_page(options.http, wiring); });
  if (!wiring.from.empty()) collect([&] { check_record(options, wiring); });
  if (options.replay.empty()) {
    collect([&] { check_one_source(options, wiring); });
    collect([&] { check_weather(options, wiring); });
  }
  problems.throw_if_errors();
  return wiring;
}

}  // namespace fanbeam::apps
