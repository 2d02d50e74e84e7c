// What a request over HTTP is answered, without sockets: pictures, status, plan, weather, sensor.
//
//   GET  /                   the page
//   GET  /frame/bscope.png   the newest picture, /frame/cscope.png; ?gain_dB= of -60 to 60 shows it
//                            with so much more gain; 503 before the first
//   GET  /api/status         rate, ages, sampling, counts
//   GET  /metrics            the same in Prometheus' text format
//   GET  /api/plan           effects, whether they run, why
//   GET  /api/cell?scope=bscope&frame=N&column=C&row=R
//                            ground truth of a cell (truth.h), row 0 on top; "gone" for a frame that
//                            the hub has no more
//   GET  /api/sensor         axes of the pictures; POST sets tilt_deg, low_dB, high_dB
//   GET  /api/weather        POST sets visibility_m (none: no fog), rain_rate_mm_per_h and
//                            snow_rate_mm_per_h (none: no snow); melting_layer tells whether rain
//                            and snow may be there together
//
// Answers of /api are JSON (docs/live.md has the keys). A POST with anything wrong in it changes
// nothing and is answered 422 with all problems: code, field, value, expected. While a recording is flown,
// a POST to either is answered 409.
//
//   GET  /api/map            the runways, for a plan view
//   GET  /api/openapi.json   all of this, for programs
//
// A key of a query that the path has not, or one given twice, is answered 422 too. "n" is any path's, and means
// nothing: with another one each time a browser asks anew.
//
// Who may ask is told by access.h. A POST says that its body is JSON (else 415), which no form of
// another page can.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "live/access.h"
#include "live/hub.h"
#include "live/journal.h"
#include "live/request.h"
#include "live/truth.h"
#include "session/session.h"

namespace fanbeam::live {

class Desk {
 public:
  // Controls that are obeyed go into `journal` unless it is null. All must outlive it. Where a recording is flown,
  // nobody else's controls than its own are obeyed.
  Desk(session::Session& session, const Hub& hub, Journal* journal = nullptr, Access access = {},
       bool replays = false)
      : session_(session),
        hub_(hub),
        journal_(journal),
        access_(std::move(access)),
        replays_(replays),
        truth_(session, hub) {}

  const Access& access() const { return access_; }
  // Whether its answer may take as long as a frame does.
  static bool renders(const Request& request);
  // Of a stream or a WebSocket, which answer() does not answer: 422 for keys that the path has not, or one given twice.
  static std::optional<Answer> refuse_query(const Request& request);
  // Thread-safe. Never throws for what stands in the request.
  Answer answer(const Request& request) const;
  // What a POST with that body does, and a control of a recording. Throws InputError with all that is wrong, and changes nothing then.
  // What `journal` cannot write is no fault of the body's: the control is in force, and the flight ends.
  void control(const std::string& path, const std::string& body) const;
  // A POST to /api/weather with what `body_of` makes of the weather of now: no control comes in between.
  void change_weather(const std::function<std::string(const atmosphere::Weather&)>& body_of) const;

 private:
  Answer get(const std::string& path, const std::string& query) const;
  // With what is wrong with the keys of the query.
  Answer cell(const std::string& query, core::ProblemList& problems) const;
  Answer picture(bool bscope, const std::string& query, core::ProblemList& problems) const;
  void obey(const std::string& path, const std::string& body) const;

  session::Session& session_;
  const Hub& hub_;
  Journal* journal_;
  Access access_;
  bool replays_;
  Truth truth_;
  mutable std::mutex controls_;  // one after the other
};

// A frame as it goes through a WebSocket: a line of JSON with its facts (number, size of both
// pictures, pose, times, and of the axes what a control moves, as it was of this frame), a line feed, then the bytes of the B-scope and of the C-scope, top row
// first.
std::string message_of(const LiveFrame& frame);

// With so much more gain. For who looks at nothing else: crossed out where the frame is stale, as a picture that
// stands looks like one of an aircraft that does.
core::Picture8 picture_to_show(const LiveFrame& frame, Scope scope, double gain_dB = 0.0);

}  // namespace fanbeam::live
