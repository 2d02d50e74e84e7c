#include "bindings/c/background_renderer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "bindings/c/last_call.h"
#include "sensors/display/display.h"

namespace fanbeam::bindings {
namespace {

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

Outcome blank_of(const session::Session& session) {
  const Shape shape = shape_of(session.scene()->description.sensor);
  Outcome blank;
  blank.bscope.resize(shape.bscope());
  blank.cscope.resize(shape.cscope());
  return blank;
}

// What fits, cut between two characters.
void put(const std::string& text, std::array<char, 1024>& into) {
  std::size_t count = std::min(text.size(), into.size() - 1);
  const auto continues = [&](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  while (count > 0 && continues(count)) --count;
  std::copy_n(text.begin(), count, into.begin());
  into[count] = '\0';
}

}  // namespace

BackgroundRenderer::BackgroundRenderer(const session::Session& session, core::StopSource& stop)
    : session_(session), stop_(stop), outcomes_(blank_of(session)) {}

BackgroundRenderer::~BackgroundRenderer() {
  stop_.request();
  ring();
  if (thread_.joinable()) thread_.join();
  delete waiting_.load();
}

void BackgroundRenderer::submit(const fanbeam_pose& pose) {
  auto letter = std::make_unique<Letter>(Letter{pose, Clock::now()});
  // Whoever comes meanwhile waits: a letter is left for a thread that is there.
  std::call_once(started_, [this] { thread_ = std::thread([this] { run(); }); });
  const std::unique_ptr<Letter> overtaken(
      waiting_.exchange(letter.release(), std::memory_order_acq_rel));
  ring();
}

void BackgroundRenderer::ring() {
  bell_.fetch_add(1, std::memory_order_release);
  bell_.notify_one();
}

void BackgroundRenderer::run() noexcept {
  const core::StopToken stop = stop_.token();
  while (true) {
    // Before all that it announces: what comes later makes the wait below return at once.
    const std::uint32_t heard = bell_.load(std::memory_order_acquire);
    if (stop.reason() != 0) return;
    const std::unique_ptr<const Letter> letter(
        waiting_.exchange(nullptr, std::memory_order_acq_rel));
    if (letter)
      render(*letter);
    else
      bell_.wait(heard, std::memory_order_acquire);
  }
}

void BackgroundRenderer::render(const Letter& letter) noexcept {
  const Clock::time_point from = Clock::now();
  ++number_;
  fanbeam_status status = FANBEAM_OK;
  std::string refusal;
  std::uint32_t events = 0;
  core::Picture8 bscope, cscope;
  try {
    const session::Session::Moment now = session_.now();
    const std::shared_ptr<const scenes::Scene> scene = session_.scene(now);
    const renderer::Products wanted{.cscope = scene->options.heights_shown};
    const renderer::Frame frame =
        session_.render(now, pose_of(letter.pose), number_, wanted, stop_.token());
    bscope = sensors::bscope_picture(scene->description.sensor, frame.bscope_grey);
    if (wanted.cscope)
      cscope = sensors::cscope_picture(scene->description.sensor, frame.cscope_grey);
    events = events_of(frame.events);
  } catch (...) {
    status = status_of_exception(refusal);
  }
  if (status == FANBEAM_STOPPED) return;
  const Clock::time_point ended = Clock::now();
  Outcome* const outcome = claimed();
  if (outcome == nullptr) return;
  outcome->number = number_;
  outcome->status = status;
  put(refusal, outcome->refusal);
  outcome->pose = letter.pose;
  outcome->events = events;
  outcome->pose_age_s = seconds_between(letter.arrived, from);
  outcome->render_s = seconds_between(from, ended);
  outcome->ended = ended;
  if (status == FANBEAM_OK) {
    std::copy(bscope.pixels.begin(), bscope.pixels.end(), outcome->bscope.begin());
    std::copy(cscope.pixels.begin(), cscope.pixels.end(), outcome->cscope.begin());
  }
  outcomes_.publish(number_);
}

Outcome* BackgroundRenderer::claimed() noexcept {
  const core::StopToken stop = stop_.token();
  while (stop.reason() == 0) {
    if (Outcome* const outcome = outcomes_.claim()) return outcome;
    // As many readers as slots are stopped inside their copies: this thread waits, nobody else does.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return nullptr;
}

}  // namespace fanbeam::bindings
