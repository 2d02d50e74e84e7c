// What the options of fanbeam live say of where poses come from and frames go to.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/live_command.h"
#include "feeds/protocol.h"
#include "live/network.h"
#include "live/raw_frames.h"
#include "live/shared_frames.h"

namespace fanbeam::apps {

// circle, ils, csv:FILE, or the protocol and address of a simulator; then ",datum=DATUM",
// ",peer=ADDRESS", ",weather=WHOSE" and ",host=ADDRESS:PORT" (of CIGI: where answers go), in any order.
struct PosesFrom {
  bool circle = false;
  std::string csv;
  const feeds::Protocol* protocol = nullptr;
  bool cigi = false;
  std::optional<live::Endpoint> host;  // of CIGI, else whoever sends
  live::Endpoint listens_at;
  live::Peers peers;
  core::VerticalDatum datum = core::VerticalDatum::egm96;  // what heights count from
  bool weather = false;                                    // that of the simulator counts

  bool listens() const { return protocol != nullptr || cigi; }
};

struct RawSink {
  live::RawFrames::Scope scope = live::RawFrames::Scope::bscope;
  std::string file;
};

struct Wiring {
  PosesFrom from;
  live::Endpoint page;
  live::Access access;              // to the page
  std::vector<std::string> shared;  // names of shared memory
  std::vector<RawSink> raw;

  bool takes_stdout() const;
};

// Throws InputError with all that is wrong.
Wiring wiring_of(const LiveOptions& options);

// Frames go to all of them.
class Sinks {
 public:
  Sinks(const Wiring& wiring, const sensors::Sensor& sensor, double rate_Hz, bool every_frame);
  void write(const std::shared_ptr<const live::LiveFrame>& frame);
  bool any_ended() const;

 private:
  std::vector<std::unique_ptr<live::SharedFrames>> shared_;
  std::vector<std::unique_ptr<live::RawFrames>> raw_;
};

}  // namespace fanbeam::apps
