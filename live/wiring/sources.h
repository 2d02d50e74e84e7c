// What --from of fanbeam live says of where poses come from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/geodetic.h"
#include "feeds/protocol.h"
#include "live/network.h"

namespace fanbeam::live {

// circle, ils, csv:FILE, or the protocol and address of a simulator; then ",datum=DATUM",
// ",peer=ADDRESS", ",weather=WHOSE" and ",host=ADDRESS:PORT" (of CIGI: where answers go), in any order.
struct PosesFrom {
  std::string source;  // as told
  bool circle = false;
  std::string csv;
  const feeds::Protocol* protocol = nullptr;
  bool cigi = false;
  std::optional<Endpoint> host;  // of CIGI, else whoever sends
  bool beacon = false;           // where X-Plane is, its own beacon tells
  Endpoint listens_at;           // of a protocol that is asked for: the simulator's place
  Peers peers;
  core::VerticalDatum datum = core::VerticalDatum::egm96;  // what heights count from
  bool weather = false;                                    // that of the simulator counts

  bool listens() const { return protocol != nullptr || cigi; }
  bool subscribes() const { return protocol != nullptr && protocol->subscribed; }
};

// Throws InputError.
PosesFrom poses_from(const std::string& source);
// Several listen to simulators, the first of which leads (live/mailbox.h); one may be of any kind.
// Throws InputError with all that is wrong.
void check_together(const std::vector<PosesFrom>& sources);

}  // namespace fanbeam::live
