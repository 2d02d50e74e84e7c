#include "apps/live_command.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

#include "apps/live_status_line.h"
#include "apps/live_wiring.h"
#include "apps/progress.h"
#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "live/channel.h"
#include "live/frame_taker.h"
#include "live/quality.h"
#include "live/replay.h"
#include "live/simulator_weather.h"
#include "live/wiring/databases.h"
#include "live/wiring/listener.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {
namespace {

// Planned for the air over all of its terrain: nobody knows where a simulator flies.
scenes::SceneDescription scene_of(const LiveOptions& options, const live::PosesFrom& from,
                                  core::ProblemList& problems) {
  scenes::SceneDescription description = read_chosen_scene(options, problems);
  description.flight_heights.stated = true;
  description.sample = true;
  if (from.csv.empty()) return description;
  scenes::TrajectoryDescription flight;
  flight.kind = scenes::TrajectoryDescription::Kind::file;
  flight.file = from.csv;
  flight.place = {from.csv};
  flight.datum = live::datum_of(description, from.datum);
  description.trajectory = flight;
  return description;
}

std::unique_ptr<session::Session> opened(const LiveOptions& options, const live::PosesFrom& from,
                                         bool quiet) {
  core::ProblemList problems;
  scenes::BuildOptions build;
  // Radar video may read watts; always, as no picture of a recording depends on who else looked.
  build.read.power = true;
  if (!options.effects.empty())
    build.wishes = renderer::parse_effect_wishes(options.effects, renderer::Touches::pictures);
  // Without lockstep the rate decides, and a recording knows its samplings.
  const bool measured =
      options.lockstep && options.replay.empty() && !(options.rays_per_cell > 0.0);
  auto session = std::make_unique<session::Session>(
      scene_of(options, from, problems),
      session::Setup{.build = build, .keeps_time_budget = measured, .threads = options.threads},
      problems);
  if (!quiet) print_problems(problems.all());
  return session;
}

// Asks for the end of a flight when a signal did or its time is up, whatever its thread waits for or
// renders by then.
class EndWatch {
 public:
  // `seconds` from `begin` on; 0: for ever.
  EndWatch(core::StopSource end, core::StopToken asked, live::Clock::time_point begin,
           double seconds)
      : thread_([this, end = std::move(end), asked = std::move(asked), begin, seconds]() mutable {
          constexpr std::chrono::milliseconds kNap(20);
          for (; !left_; std::this_thread::sleep_for(kNap)) {
            if (asked.reason() != 0) return end.request(asked.reason());
            if (seconds > 0.0 && live::seconds_between(begin, live::Clock::now()) >= seconds)
              return end.request(live::kTimeIsUp);
          }
        }) {}
  ~EndWatch() {
    left_ = true;
    thread_.join();
  }
  EndWatch(const EndWatch&) = delete;
  EndWatch& operator=(const EndWatch&) = delete;

 private:
  std::atomic<bool> left_{false};
  std::thread thread_;
};

// What goes on while scenes are switched.
struct Continued {
  live::Databases databases;
  live::Sinks sinks;
  live::Clock::time_point begin = live::Clock::now();
  std::uint64_t frames = 0;
  std::uint16_t page_port = 0;  // 0: none yet
  live::CigiStation station{};
};

// Of a scene and the options; --from may be that of a recording.
class LiveRun {
 public:
  LiveRun(const LiveOptions& options, const Wiring& wiring, const live::Recording* recording,
          bool quiet, std::unique_ptr<session::Session> session, Continued& continued)
      : options_(options),
        wiring_(wiring),
        recording_(recording),
        quiet_(quiet),
        continued_(continued),
        session_(std::move(session)),
        scene_(session_->scene()),
        rate_Hz_(rate_of()),
        desk_(make_desk()),
        listener_(wiring.from, *session_, rate_Hz_,
                  options.lockstep ? live::Mailbox::kKeptInLockstep : live::Mailbox::kKept,
                  continued.station),
        network_(desk_, hub_),
        line_(quiet) {
    live::Status status;
    status.scene = scene_->description.name;
    status.source = told_sources();
    status.caster = renderer::name_of(scene_->caster.chosen);
    status.wanted_Hz = rate_Hz_;
    status.samples = session_->samples();
    status.frames = continued.frames;
    hub_.tell(status);
    if (recording_ != nullptr) check_flown_by(recording_->flown_by);
  }

  void fly() {
    const core::StopToken asked = core::StopScope::current();
    const std::uint16_t port = serve();
    const bool listens = wiring_.first().listens() && recording_ == nullptr;
    if (listens) listener_.listen(network_);
    live::Sinks& sinks = continued_.sinks;
    sinks.begin(scene_->description, rate_Hz_);
    if (journal_) journal_->begin();  // last: until here nothing is lost that was there
    network_.start();
    if (!quiet_)
      print_address(scene_->description.name, wiring_.page.address, port,
                    wiring_.to.take_stdout() ? stderr : stdout);
    core::StopSource end;
    const auto begin = live::Clock::now();
    std::optional<live::SimulatorWeather> weather;
    if (const live::Feed* const told = listener_.weather(); told != nullptr && listens)
      weather.emplace(desk_, *told);
    std::optional<live::Quality> quality;
    if (!options_.lockstep && recording_ == nullptr) quality.emplace(*session_, hub_);
    const auto each_frame = [&](live::Status& now) {
      if (quality) quality->tell(now);
      if (weather) {
        weather->follow();
        now.weather_refusal = weather->refusal();
      }
      if (listens) listener_.tell(now);
      if (listens && options_.lockstep) listener_.before_frame(network_);
      sinks.write(hub_.newest());
      line_.show(now, network_.clients());
      const bool enough =
          options_.frames > 0 && now.frames >= static_cast<std::uint64_t>(options_.frames);
      if (enough || sinks.any_ended() || switches()) end.request();
    };
    live::ChannelSettings settings{rate_Hz_, samples(), begin, journal_ ? &*journal_ : nullptr};
    settings.dress = listener_.dress();
    settings.keep_received = wiring_.to.want_received();
    if (options_.threads > 0) settings.threads = static_cast<unsigned>(options_.threads);
    if (quality) settings.beside_s = [&quality] { return quality->processor_s(); };
    fly_until(end, asked, settings, each_frame);
    if (listens) listener_.leave(network_);
    continued_.frames = hub_.status().frames;
  }

 private:
  // Whatever of these were other would make other pictures.
  void check_flown_by(const live::FlownBy& recorded) const {
    core::ProblemList problems;
    const auto hold = [&](const char* key, const std::optional<std::string>& then,
                          const std::string& now, const char* what) {
      if (then && *then != now)
        problems.error(core::ErrorClass::ref, {options_.replay}, key, "\"" + *then + "\"",
                       "\"" + now + "\", " + what);
    };
    hold("/scene", recorded.scene, scene_->description.name, "the scene that is open");
    hold("/sensor", recorded.sensor, scene_->description.sensor.name, "the sensor that is open");
    hold("/effects", recorded.effects, options_.effects, "the --effects that were told");
    problems.throw_if_errors();
  }

  std::string told_sources() const {
    std::string all;
    for (const live::PosesFrom& from : wiring_.from) all += (all.empty() ? "" : ", ") + from.source;
    return all;
  }

  std::uint16_t serve() {
    live::Endpoint page = wiring_.page;
    if (continued_.page_port != 0) page.port = continued_.page_port;
    return continued_.page_port = network_.serve(page);
  }

  // Whether the scene that a CIGI host asks for is open.
  bool switches() {
    live::CigiIg* const ig = listener_.cigi();
    if (ig == nullptr) return false;
    const std::int8_t wanted = ig->wanted_database();
    try {
      if (!continued_.databases.is_ready(wanted)) return false;
    } catch (const core::InputError& error) {
      ig->refuse_database(wanted, core::to_string(error.problems().front()));
      return false;
    } catch (const std::exception& error) {  // no room for two scenes: this one flies on
      ig->refuse_database(wanted, error.what());
      return false;
    }
    continued_.station = ig->station();
    return true;
  }

  // As told, or as measured: a recording has to tell it.
  double samples() const {
    if (options_.rays_per_cell > 0.0 || !options_.lockstep || recording_ != nullptr ||
        !(scene_->description.time_budget_ms > 0.0))
      return options_.rays_per_cell;
    return session_->samples();
  }

  double rate_of() const {
    if (recording_ != nullptr) return recording_->flown_by.rate_Hz;
    return options_.rate_Hz > 0.0 ? options_.rate_Hz
                                  : scene_->description.sensor.scan.frame_rate_Hz;
  }

  live::Desk make_desk() {
    if (!options_.record.empty())
      journal_.emplace(
          options_.record,
          live::FlownBy{scene_->description.name, options_.from, rate_Hz_, options_.lockstep,
                        scene_->description.sensor.name, options_.effects});
    return {*session_, hub_, journal_ ? &*journal_ : nullptr, wiring_.access};
  }

  live::PoseSource heard_poses(const live::ChannelSettings& settings) {
    return [this, poses = live::source_of(listener_.mailbox(), scene_->frame, settings.begin,
                                          settings.journal)](double now_s, double at_s) {
      listener_.before_frame(network_);
      return poses(now_s, at_s);
    };
  }

  live::Flight flight() const {
    return wiring_.first().circle ? live::circle(*scene_) : live::approach(*scene_);
  }

  void fly_until(const core::StopSource& end, const core::StopToken& asked,
                 const live::ChannelSettings& settings, const live::Told& told) {
    const core::StopToken stop = end.token();
    const core::StopScope scope(stop);
    const EndWatch watch(end, asked, continued_.begin, options_.seconds);
    try {
      render(settings, told, stop);
    } catch (const core::Stopped&) {  // while conditions were set
    }
  }

  void render(const live::ChannelSettings& settings, const live::Told& told,
              const core::StopToken& stop) {
    const bool listens = wiring_.first().listens();
    const live::Flight flown = listens ? live::Flight() : flight();
    if (recording_ != nullptr)
      live::run_replay(*session_, *recording_,
                       listens ? listener_.feeds() : std::vector<const live::Feed*>{}, &flown,
                       desk_,
                       {options_.speed, options_.lockstep, settings.begin, settings.keep_received},
                       hub_, told, stop);
    else if (options_.lockstep && listens)
      live::run_lockstep(*session_, listener_.mailbox(), settings, hub_, told, stop);
    else if (options_.lockstep)
      live::run_lockstep(*session_, flown, settings, hub_, told, stop);
    else
      live::run_channel(*session_, listens ? heard_poses(settings) : live::source_of(flown),
                        settings, hub_, told, stop);
  }

  const LiveOptions& options_;
  const Wiring& wiring_;
  const live::Recording* recording_;
  bool quiet_;
  Continued& continued_;
  std::unique_ptr<session::Session> session_;
  std::shared_ptr<const scenes::Scene> scene_;
  double rate_Hz_;
  live::Hub hub_;
  std::optional<live::Journal> journal_;
  live::Desk desk_;
  live::Listener listener_;
  live::Network network_;
  StatusLine line_;
};

}  // namespace

int fly(const LiveOptions& given, const CommonOptions& common) {
  LiveOptions options = given;
  std::optional<live::Recording> recording;
  if (!options.replay.empty()) {
    recording = live::read_recording(options.replay);
    options.from = recording->flown_by.from;
  }
  const Wiring wiring = wiring_of(options);
  const core::ThreadLimit threads(options.threads);
  std::signal(SIGPIPE, SIG_IGN);  // a reader of raw frames that leaves is a good end
  const StopOnSignals stop_on_signals;
  try {
    const auto open = [&](const std::string& scene) {
      LiveOptions other = options;
      other.scene = scene;
      return opened(other, wiring.first(), common.quiet);
    };
    std::unique_ptr<session::Session> session = open(options.scene);
    Continued continued{{options.scene, session->scene()->description, open},
                        {wiring.to, options.lockstep}};
    while (session) {
      continued.station.database = continued.databases.current();
      continued.station.others = continued.databases.others();
      LiveRun(options, wiring, recording ? &*recording : nullptr, common.quiet, std::move(session),
              continued)
          .fly();
      session = continued.databases.take();
    }
    continued.sinks.end();
  } catch (const core::Stopped&) {  // while the scene was opened: as good an end
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
