#include "apps/live_command.h"

#include <fmt/core.h>
#include <unistd.h>

#include <csignal>

#include "apps/live_wiring.h"
#include "apps/progress.h"
#include "apps/stop_on_signals.h"
#include "core/parallel.h"
#include "live/channel.h"
#include "live/cigi_ig.h"
#include "live/feed.h"
#include "live/quality.h"
#include "live/replay.h"
#include "live/simulator_weather.h"
#include "renderer/plan/plan.h"

namespace fanbeam::apps {
namespace {

// Empty while simulator and scene agree on the ground.
std::string offset_text(const live::Status& status) {
  if (!live::is_lasting_offset(status)) return {};
  return fmt::format("  heights {:+.0f} m off: is its datum right?", -*status.height_offset_m);
}

std::string error_text(const live::Status& status) {
  if (!status.errors) return {};
  return fmt::format(" ({:.1f}, {:.1f} grey)", status.errors->bscope_grey,
                     status.errors->cscope_grey);
}

class StatusLine {
 public:
  explicit StatusLine(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO) == 1) {}
  ~StatusLine() {
    if (shown_) std::fputs("\n", stderr);
  }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const live::Status& status, int viewers) {
    const auto now = live::Clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(500)) return;
    last_ = now;
    if (status.waiting)
      fmt::print(stderr, "\r\033[Kwaiting for a pose from {}", status.source);
    else
      fmt::print(
          stderr,
          "\r\033[K{:.1f} Hz  frame {:.0f} ms  sampling {:g}{}  pose age {:.0f} ms{}  late {}  "
          "{} watching{}",
          status.rate_Hz, status.frame_ms, status.samples, error_text(status), status.pose_age_ms,
          status.stale ? " (stale)" : "", status.late, viewers, offset_text(status));
  }

 private:
  bool shown_;
  live::Clock::time_point last_{};
};

void print_address(const std::string& scene, const std::string& address, std::uint16_t port,
                   std::FILE* to) {
  const bool six = address.find(':') != std::string::npos;
  fmt::print(to, "{}: look at http://{}:{}/ (Ctrl-C ends)\n", scene,
             six ? "[" + address + "]" : address, port);
  std::fflush(to);
}

// Planned for the air over all of its terrain: nobody knows where a simulator flies.
scenes::SceneDescription scene_of(const LiveOptions& options, const PosesFrom& from,
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

std::unique_ptr<session::Session> open(const LiveOptions& options, const PosesFrom& from,
                                       bool quiet) {
  core::ProblemList problems;
  scenes::BuildOptions build;
  if (!options.effects.empty())
    build.wishes = renderer::parse_effect_wishes(options.effects, renderer::Touches::pictures);
  auto session = std::make_unique<session::Session>(
      scene_of(options, from, problems), session::Setup{.build = build, .threads = options.threads},
      problems);
  if (!quiet) print_problems(problems.all());
  return session;
}

// Of the options; --from may be that of a recording.
class LiveRun {
 public:
  LiveRun(const LiveOptions& options, const Wiring& wiring, const live::Recording* recording,
          bool quiet)
      : options_(options),
        wiring_(wiring),
        recording_(recording),
        quiet_(quiet),
        session_(open(options, wiring.from, quiet)),
        scene_(session_->scene()),
        rate_Hz_(rate_of()),
        desk_(make_desk()),
        feed_(scene_, wiring.from.datum,
              wiring.from.protocol != nullptr ? *wiring.from.protocol : feeds::kProtocols[0],
              kept()),
        ig_(make_ig()),
        network_(desk_, hub_),
        line_(quiet) {
    live::Status status;
    status.source = options.from;
    hub_.tell(status);
    if (recording_ != nullptr && recording_->flown_by.scene != scene_->description.name)
      core::throw_input_error(core::ErrorClass::ref, core::Place{options.replay}, "/scene",
                              "\"" + recording_->flown_by.scene + "\"",
                              "\"" + scene_->description.name + "\", the scene that is open");
  }

  void fly() {
    const core::StopToken asked = core::StopScope::current();
    const std::uint16_t port = network_.serve(wiring_.page);
    if (wiring_.from.listens() && recording_ == nullptr)
      network_.receive(
          wiring_.from.listens_at,
          [this](std::span<const std::uint8_t> datagram, const live::Sender& from) {
            hear(datagram, from);
          },
          wiring_.from.peers);
    Sinks sinks(wiring_, scene_->description.sensor, rate_Hz_, options_.lockstep);
    network_.start();
    if (!quiet_)
      print_address(scene_->description.name, wiring_.page.address, port,
                    wiring_.takes_stdout() ? stderr : stdout);
    core::StopSource end;
    const auto begin = live::Clock::now();
    std::optional<live::SimulatorWeather> weather;
    if (wiring_.from.weather && recording_ == nullptr) weather.emplace(desk_, feed_);
    std::optional<live::Quality> quality;
    if (!options_.lockstep && recording_ == nullptr) quality.emplace(*session_, hub_);
    const auto each_frame = [&](live::Status& now) {
      if (quality) quality->tell(now);
      if (weather) weather->follow();
      if (wiring_.from.listens() && recording_ == nullptr) tell_source(now);
      if (options_.lockstep) begin_host_frame();
      sinks.write(hub_.newest());
      line_.show(now, network_.clients());
      const bool enough =
          (options_.seconds > 0.0 &&
           live::seconds_between(begin, live::Clock::now()) >= options_.seconds) ||
          (options_.frames > 0 && now.frames >= static_cast<std::uint64_t>(options_.frames));
      if (asked.reason() != 0 || enough || sinks.any_ended()) end.request();
    };
    live::ChannelSettings settings{rate_Hz_, options_.rays_per_cell, begin,
                                   journal_ ? &*journal_ : nullptr};
    if (options_.threads > 0) settings.threads = static_cast<unsigned>(options_.threads);
    if (quality) settings.beside_s = [&quality] { return quality->processor_s(); };
    render(settings, each_frame, end.token());
  }

 private:
  double rate_of() const {
    if (recording_ != nullptr) return recording_->flown_by.rate_Hz;
    return options_.rate_Hz > 0.0 ? options_.rate_Hz
                                  : scene_->description.sensor.scan.frame_rate_Hz;
  }

  std::size_t kept() const {
    return options_.lockstep ? live::Mailbox::kKeptInLockstep : live::Mailbox::kKept;
  }

  std::optional<live::CigiIg> make_ig() {
    if (!wiring_.from.cigi) return std::nullopt;
    return std::optional<live::CigiIg>(std::in_place, *session_, wiring_.from.datum, kept());
  }

  live::Desk make_desk() {
    if (!options_.record.empty())
      journal_.emplace(options_.record, live::FlownBy{scene_->description.name, options_.from,
                                                      rate_Hz_, options_.lockstep});
    return {*session_, hub_, journal_ ? &*journal_ : nullptr, wiring_.access};
  }

  void hear(std::span<const std::uint8_t> datagram, const live::Sender& from) {
    if (!from.is_peer)
      ig_ ? ig_->turn_away() : feed_.turn_away();
    else if (ig_)
      ig_->take(datagram, from.address + ":" + std::to_string(from.port));
    else
      feed_.take(datagram);
  }

  void tell_source(live::Status& status) const {
    if (ig_)
      ig_->tell(status);
    else
      feed_.tell(status);
  }

  // Of CIGI: the host is told that a frame begins.
  void begin_host_frame() {
    if (!ig_) return;
    std::vector<std::uint8_t> message = ig_->begin_frame();
    const std::string host = ig_->host();
    if (wiring_.from.host)
      network_.send(*wiring_.from.host, std::move(message));
    else if (!host.empty())
      network_.send(live::parse_endpoint(host, "--from"), std::move(message));
  }

  live::PoseSource heard_poses(const live::ChannelSettings& settings) {
    const live::Mailbox& mailbox = ig_ ? ig_->mailbox() : feed_.mailbox();
    return [this, poses = live::source_of(mailbox, scene_->frame, settings.begin,
                                          settings.journal)](double now_s, double at_s) {
      begin_host_frame();
      return poses(now_s, at_s);
    };
  }

  live::Flight flight() const {
    return wiring_.from.circle ? live::circle(*scene_) : live::approach(*scene_);
  }

  void render(const live::ChannelSettings& settings, const live::Told& told,
              const core::StopToken& stop) {
    const bool listens = wiring_.from.listens();
    const live::Flight flown = listens ? live::Flight() : flight();
    if (recording_ != nullptr)
      live::run_replay(*session_, *recording_, listens ? &feed_ : nullptr, &flown, desk_,
                       {options_.speed, options_.lockstep, settings.begin}, hub_, told, stop);
    else if (options_.lockstep && listens)
      live::run_lockstep(*session_, ig_ ? ig_->mailbox() : feed_.mailbox(), settings, hub_, told,
                         stop);
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
  std::unique_ptr<session::Session> session_;
  std::shared_ptr<const scenes::Scene> scene_;
  double rate_Hz_;
  live::Hub hub_;
  std::optional<live::Journal> journal_;
  live::Desk desk_;
  live::Feed feed_;
  std::optional<live::CigiIg> ig_;
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
    LiveRun(options, wiring, recording ? &*recording : nullptr, common.quiet).fly();
  } catch (const core::Stopped&) {  // while the scene was opened: as good an end
  }
  return kExitDone;
}

}  // namespace fanbeam::apps
