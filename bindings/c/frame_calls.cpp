// Frames: at once, or by the session's own thread.
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "bindings/c/arguments.h"
#include "bindings/c/handle.h"
#include "bindings/c/last_call.h"
#include "sensors/display/display.h"

using namespace fanbeam;
using bindings::Arguments;
using bindings::kOpened;
using bindings::Outcome;

namespace {

void check_cscope(const fanbeam_session& session, bool asked, const std::string& name,
                  Arguments& arguments) {
  if (asked && !session.shows_cscope)
    arguments.refuse(core::ErrorClass::ref, name, "a C-scope",
                     "none, as it was opened with setup.bscope_alone");
}

void check_output(const fanbeam_output& output, const fanbeam_session* session,
                  Arguments& arguments) {
  arguments.bits(output.layers, FANBEAM_BSCOPE | FANBEAM_CSCOPE, "output.layers",
                 "0, FANBEAM_BSCOPE, or FANBEAM_BSCOPE | FANBEAM_CSCOPE");
  if (output.layers == FANBEAM_CSCOPE)
    arguments.refuse(core::ErrorClass::range, "output.layers", "FANBEAM_CSCOPE",
                     "FANBEAM_BSCOPE with it");
  arguments.reserved(output.reserved, "output.reserved");
  if (output.bscope == nullptr && output.cscope == nullptr && output.bscope_W == nullptr &&
      output.cscope_W_m3 == nullptr && output.layers == 0)
    arguments.refuse(core::ErrorClass::ref, "output", "nothing", "a buffer, or layers");
  if (session == nullptr) return;
  const bindings::Shape& shape = session->shape;
  arguments.room(output.bscope, output.bscope_count, shape.bscope(), "output.bscope");
  arguments.room(output.cscope, output.cscope_count, shape.cscope(), "output.cscope");
  arguments.room(output.bscope_W, output.bscope_W_count, shape.bscope(), "output.bscope_W");
  arguments.room(output.cscope_W_m3, output.cscope_W_m3_count, shape.cscope(),
                 "output.cscope_W_m3");
  check_cscope(*session, output.cscope != nullptr, "output.cscope", arguments);
  check_cscope(*session, output.cscope_W_m3 != nullptr, "output.cscope_W_m3", arguments);
  check_cscope(*session, (output.layers & FANBEAM_CSCOPE) != 0, "output.layers", arguments);
}

renderer::Products wanted_of(const fanbeam_output& output) {
  renderer::Products wanted;
  wanted.bscope = output.bscope != nullptr || output.bscope_W != nullptr;
  wanted.cscope = output.cscope != nullptr || output.cscope_W_m3 != nullptr;
  wanted.layers = output.layers != 0;
  wanted.cscope_layers = (output.layers & FANBEAM_CSCOPE) != 0;
  return wanted;
}

// As many as the caller has been asked to make room for.
template <class Values>
void check_size(const void* buffer, const Values& values, std::size_t needed) {
  if (buffer != nullptr && values.size() != needed)
    throw core::InternalError("a picture of another size");
}

template <class Values>
void hand_out(const Values& values, typename Values::value_type* buffer) {
  if (buffer != nullptr) std::copy(values.begin(), values.end(), buffer);
}

// All that can fail comes before the first byte of the caller's.
void leave(const fanbeam_session& session, const std::shared_ptr<const scenes::Scene>& scene,
           renderer::Frame&& frame, fanbeam_output& output) {
  const bindings::Shape& shape = session.shape;
  const sensors::Sensor& sensor = scene->description.sensor;
  core::Picture8 bscope, cscope;
  if (output.bscope != nullptr) bscope = sensors::bscope_picture(sensor, frame.bscope_grey);
  if (output.cscope != nullptr) cscope = sensors::cscope_picture(sensor, frame.cscope_grey);
  std::unique_ptr<fanbeam_layers> truth;
  if (output.layers != 0)
    truth = std::make_unique<fanbeam_layers>(fanbeam_layers{
        std::move(frame.layers).value(), shape, (output.layers & FANBEAM_CSCOPE) != 0, scene});
  check_size(output.bscope, bscope.pixels, shape.bscope());
  check_size(output.cscope, cscope.pixels, shape.cscope());
  check_size(output.bscope_W, frame.bscope_W, shape.bscope());
  check_size(output.cscope_W_m3, frame.cscope_W_m3, shape.cscope());
  hand_out(bscope.pixels, output.bscope);
  hand_out(cscope.pixels, output.cscope);
  hand_out(frame.bscope_W, output.bscope_W);
  hand_out(frame.cscope_W_m3, output.cscope_W_m3);
  output.noise_W = frame.noise_W;
  output.events = bindings::events_of(frame.events);
  output.truth = truth.release();
}

void fill(const Outcome& outcome, fanbeam_frame& frame) {
  frame.events = outcome.events;
  frame.number = outcome.number;
  frame.time_s = outcome.pose.time_s;
  frame.latitude_rad = outcome.pose.latitude_rad;
  frame.longitude_rad = outcome.pose.longitude_rad;
  frame.height_m = outcome.pose.height_m;
  frame.roll_rad = outcome.pose.roll_rad;
  frame.pitch_rad = outcome.pose.pitch_rad;
  frame.heading_rad = outcome.pose.heading_rad;
  frame.pose_age_s = outcome.pose_age_s;
  frame.render_s = outcome.render_s;
  frame.age_s = std::chrono::duration<double>(bindings::Clock::now() - outcome.ended).count();
}

}  // namespace

extern "C" {

fanbeam_status fanbeam_render(fanbeam_session* session, const fanbeam_pose* pose,
                              uint64_t frame_index, fanbeam_output* output) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    bindings::check_pose(arguments, pose);
    if (arguments.sized(output, "output")) check_output(*output, session, arguments);
    arguments.done();
    const core::StopToken stop = session->stop.token();
    if (stop.reason() != 0) throw core::Stopped();
    const session::Session::Moment now = session->held.now();
    renderer::Frame frame =
        session->held.render(now, bindings::pose_of(*pose), frame_index, wanted_of(*output), stop);
    leave(*session, session->held.scene(now), std::move(frame), *output);
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_submit_pose(fanbeam_session* session, const fanbeam_pose* pose) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    arguments.there(session, "session", kOpened);
    bindings::check_pose(arguments, pose);
    arguments.done();
    if (session->stop.token().reason() != 0) throw core::Stopped();
    session->background.submit(*pose);
    return FANBEAM_OK;
  });
}

fanbeam_status fanbeam_latest_frame(fanbeam_session* session, fanbeam_frame* frame, uint8_t* bscope,
                                    size_t bscope_count, uint8_t* cscope,
                                    size_t cscope_count) noexcept {
  return bindings::guarded([&] {
    Arguments arguments;
    const bool opened = arguments.there(session, "session", kOpened);
    arguments.sized(frame, "frame");
    if (opened) {
      arguments.room(bscope, bscope_count, session->shape.bscope(), "bscope");
      arguments.room(cscope, cscope_count, session->shape.cscope(), "cscope");
      check_cscope(*session, cscope != nullptr, "cscope", arguments);
    }
    arguments.done();
    const auto newest = session->background.outcomes().other_than(frame->number);
    if (!newest) return FANBEAM_NOTHING_NEW;
    if (newest->status != FANBEAM_OK) {
      bindings::last_call().error = newest->refusal.data();
      frame->number = newest->number;
      return newest->status;
    }
    fill(*newest, *frame);
    hand_out(newest->bscope, bscope);
    hand_out(newest->cscope, cscope);
    return FANBEAM_OK;
  });
}

}  // extern "C"
