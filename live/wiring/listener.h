// Who tells fanbeam live where the aircraft is: a simulator's datagrams, a CIGI host, or X-Plane that is
// asked for them.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "live/cigi_ig.h"
#include "live/feed.h"
#include "live/network.h"
#include "live/wiring/sources.h"
#include "live/xplane_link.h"
#include "session/session.h"

namespace fanbeam::live {

class Listener {
 public:
  // `from` and `session` must outlive it, and it the networks that it is given.
  Listener(const std::vector<PosesFrom>& from, session::Session& session, double rate_Hz,
           bool lockstep, const CigiStation& station);

  // Before the network starts; not in a replay.
  void listen(Network& network);
  // A frame begins: what is due to the other side is sent.
  void before_frame(Network& network);
  // No more is asked for.
  void leave(Network& network);
  void tell(Status& status) const;
  // In lockstep, before the frame of a letter of the mailbox.
  void before_letter(std::uint64_t number);
  // Of a CIGI host: what it wants to see of a frame. Empty for others.
  std::function<void(LiveFrame&)> dress() const;
  const Mailbox& mailbox() const { return ig_ ? ig_->mailbox() : sources_.front().feed.mailbox(); }
  // In the order of --from.
  std::vector<const Feed*> feeds() const;
  // The one whose weather counts; null where none does.
  const Feed* weather() const;
  // Null where it listens to no CIGI host.
  CigiIg* cigi() { return ig_ ? &*ig_ : nullptr; }

 private:
  struct Source {
    Source(const PosesFrom& told, const session::Session& session, std::shared_ptr<Mailbox> mailbox,
           std::size_t number);

    const PosesFrom& from;
    Feed feed;
  };
  void hear(Source& source, std::span<const std::uint8_t> datagram, const Sender& from);
  void listen_to_xplane(const PosesFrom& told, Network& network);

  std::deque<Source> sources_;
  std::optional<CigiIg> ig_;
  std::optional<XPlaneLink> xplane_;
};

}  // namespace fanbeam::live
