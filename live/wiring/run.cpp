#include "live/wiring/run.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "live/channel.h"
#include "live/quality.h"
#include "live/replay.h"
#include "live/simulator_weather.h"
#include "live/wiring/databases.h"
#include "live/wiring/listener.h"

namespace fanbeam::live {
namespace {

// Asks for the end of a flight when a signal did or its time is up, whatever its thread waits for or
// renders by then.
class EndWatch {
 public:
  // `seconds` from `begin` on; 0: for ever.
  EndWatch(core::StopSource end, core::StopToken asked, Clock::time_point begin, double seconds)
      : thread_([this, end = std::move(end), asked = std::move(asked), begin, seconds]() mutable {
          constexpr std::chrono::milliseconds kNap(20);
          for (; !left_; std::this_thread::sleep_for(kNap)) {
            if (asked.reason() != 0) return end.request(asked.reason());
            if (seconds > 0.0 && seconds_between(begin, Clock::now()) >= seconds)
              return end.request(kTimeIsUp);
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

// Asks for no more, also where a flight ends with an error: X-Plane would go on sending.
class Farewell {
 public:
  Farewell(Listener& listener, Network& network) : listener_(listener), network_(network) {}
  ~Farewell() {
    try {
      listener_.leave(network_);
    } catch (
        const std::exception&) {  // no memory for a letter: why the flight ended is told instead
    }
  }
  Farewell(const Farewell&) = delete;
  Farewell& operator=(const Farewell&) = delete;

 private:
  Listener& listener_;
  Network& network_;
};

// What goes on while scenes are switched.
struct Continued {
  Databases databases;
  Sinks sinks;
  Clock::time_point begin = Clock::now();
  std::uint64_t frames = 0, newest_number = 0;
  std::uint16_t page_port = 0;  // 0: none yet
  CigiStation station{};
};

// Of a scene and the options; --from may be that of a recording.
class LiveRun {
 public:
  LiveRun(const RunSettings& settings, const Wiring& wiring, const Recording* recording,
          const RunCallbacks& calls, std::unique_ptr<session::Session> session,
          Continued& continued)
      : settings_(settings),
        wiring_(wiring),
        recording_(recording),
        calls_(calls),
        continued_(continued),
        session_(std::move(session)),
        scene_(session_->scene()),
        rate_Hz_(rate_of()),
        desk_(make_desk()),
        listener_(wiring.from, *session_, rate_Hz_, settings.lockstep, continued.station),
        network_(desk_, hub_),
        show_(calls.status()) {
    Status status;
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
    Sinks& sinks = continued_.sinks;
    sinks.begin(scene_->description, rate_Hz_);
    if (journal_) journal_->begin();  // last: until here nothing is lost that was there
    network_.start();
    calls_.page(scene_->description.name, port);
    core::StopSource end;
    const auto begin = Clock::now();
    std::optional<SimulatorWeather> weather;
    if (const Feed* const told = listener_.weather(); told != nullptr && listens)
      weather.emplace(desk_, *told);
    std::optional<Quality> quality;
    if (!settings_.lockstep && recording_ == nullptr) quality.emplace(*session_, hub_);
    const auto each_frame = [&](Status& now) {
      if (quality) quality->tell(now);
      if (weather) {
        weather->follow();
        now.weather_refusal = weather->refusal();
      }
      if (journal_) journal_->throw_if_failed();  // of a control
      if (listens) {
        listener_.tell(now);
        if (const std::uint64_t faults = network_.faults(); faults > 0)
          now.bad_packets.emplace_back("a fault of fanbeam's", faults);
      }
      if (listens && settings_.lockstep) listener_.before_frame(network_);
      sinks.write(hub_.newest());
      show_(now, network_.clients());
      const bool enough =
          settings_.frames > 0 && now.frames >= static_cast<std::uint64_t>(settings_.frames);
      if (enough || sinks.any_ended() || switches()) end.request();
    };
    ChannelSettings settings{rate_Hz_, samples(), begin, journal_ ? &*journal_ : nullptr};
    settings.dress = listener_.dress();
    settings.before_letter = [this](std::uint64_t number) { listener_.before_letter(number); };
    settings.keep_received = wiring_.to.want_received();
    settings.newest_number = continued_.newest_number;
    if (settings_.threads > 0) settings.threads = static_cast<unsigned>(settings_.threads);
    if (quality) settings.beside_s = [&quality] { return quality->processor_s(); };
    std::optional<Farewell> farewell;
    if (listens) farewell.emplace(listener_, network_);
    fly_until(end, asked, settings, each_frame);
    if (journal_) journal_->close();
    continued_.frames = hub_.status().frames;
    if (const auto newest = hub_.newest()) continued_.newest_number = newest->number;
  }

 private:
  // Whatever of these were other would make other pictures.
  void check_flown_by(const FlownBy& recorded) const {
    core::ProblemList problems;
    const auto hold = [&](const char* key, const std::optional<std::string>& then,
                          const std::string& now, const char* what) {
      if (then && *then != now)
        problems.error(core::ErrorClass::ref, {settings_.replay}, key, "\"" + *then + "\"",
                       "\"" + now + "\", " + what);
    };
    hold("/scene", recorded.scene, scene_->description.name, "the scene that is open");
    hold("/sensor", recorded.sensor, scene_->description.sensor.name, "the sensor that is open");
    hold("/effects", recorded.effects, settings_.effects, "the --effects that were told");
    problems.throw_if_errors();
  }

  std::string told_sources() const {
    std::string all;
    for (const PosesFrom& from : wiring_.from) all += (all.empty() ? "" : ", ") + from.source;
    return all;
  }

  std::uint16_t serve() {
    Endpoint page = wiring_.page;
    if (continued_.page_port != 0) page.port = continued_.page_port;
    return continued_.page_port = network_.serve(page);
  }

  // Whether the scene that a CIGI host asks for is open.
  bool switches() {
    CigiIg* const ig = listener_.cigi();
    if (ig == nullptr) return false;
    const std::int8_t wanted = ig->wanted_database();
    try {
      if (!continued_.databases.is_ready(wanted)) return false;
      continued_.sinks.check_raw_size(continued_.databases.ready()->scene()->description);
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
    if (settings_.rays_per_cell > 0.0 || !settings_.lockstep || recording_ != nullptr ||
        !(scene_->description.time_budget_ms > 0.0))
      return settings_.rays_per_cell;
    return session_->samples();
  }

  double rate_of() const {
    if (recording_ != nullptr) return recording_->flown_by.rate_Hz;
    return settings_.rate_Hz > 0.0 ? settings_.rate_Hz
                                   : scene_->description.sensor.scan.frame_rate_Hz;
  }

  Desk make_desk() {
    if (!settings_.record.empty())
      journal_.emplace(
          settings_.record,
          FlownBy{scene_->description.name, settings_.from, rate_Hz_, settings_.lockstep,
                  scene_->description.sensor.name, settings_.effects});
    return {*session_, hub_, journal_ ? &*journal_ : nullptr, wiring_.access,
            recording_ != nullptr};
  }

  PoseSource heard_poses(const ChannelSettings& settings) {
    return [this, poses = source_of(listener_.mailbox(), scene_->frame, settings.begin,
                                    settings.journal)](double now_s, double at_s) {
      listener_.before_frame(network_);
      return poses(now_s, at_s);
    };
  }

  Flight flight() const { return wiring_.first().circle ? circle(*scene_) : approach(*scene_); }

  void fly_until(const core::StopSource& end, const core::StopToken& asked,
                 const ChannelSettings& settings, const Told& told) {
    const core::StopToken stop = end.token();
    const core::StopScope scope(stop);
    const EndWatch watch(end, asked, continued_.begin, settings_.seconds);
    try {
      render(settings, told, stop);
    } catch (const core::Stopped&) {  // while conditions were set
    }
  }

  void render(const ChannelSettings& settings, const Told& told, const core::StopToken& stop) {
    const bool listens = wiring_.first().listens();
    const Flight flown = listens ? Flight() : flight();
    if (recording_ != nullptr)
      run_replay(*session_, *recording_, listens ? listener_.feeds() : std::vector<const Feed*>{},
                 &flown, desk_,
                 {settings_.speed, settings_.lockstep, settings.begin, settings.keep_received},
                 hub_, told, stop);
    else if (settings_.lockstep && listens)
      run_lockstep(*session_, listener_.mailbox(), settings, hub_, told, stop);
    else if (settings_.lockstep)
      run_lockstep(*session_, flown, settings, hub_, told, stop);
    else
      run_channel(*session_, listens ? heard_poses(settings) : source_of(flown), settings, hub_,
                  told, stop);
  }

  const RunSettings& settings_;
  const Wiring& wiring_;
  const Recording* recording_;
  const RunCallbacks& calls_;
  Continued& continued_;
  std::unique_ptr<session::Session> session_;
  std::shared_ptr<const scenes::Scene> scene_;
  double rate_Hz_;
  Hub hub_;
  std::optional<Journal> journal_;
  Desk desk_;
  Listener listener_;
  Network network_;
  std::function<void(const Status&, int viewers)> show_;
};

}  // namespace

void run_live(const RunSettings& settings, const Wiring& wiring, const Recording* recording,
              const std::string& scene, const RunCallbacks& calls) {
  std::unique_ptr<session::Session> session = calls.open(scene);
  Continued continued{{scene, session->scene()->description, calls.open},
                      {wiring.to, settings.lockstep}};
  while (session) {
    continued.station.database = continued.databases.current();
    continued.station.others = continued.databases.others();
    LiveRun(settings, wiring, recording, calls, std::move(session), continued).fly();
    session = continued.databases.take();
  }
  continued.sinks.end();
}

}  // namespace fanbeam::live
