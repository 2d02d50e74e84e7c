// Who tells fanbeam live where the aircraft is: a simulator's datagrams, a CIGI host, or X-Plane that is
// asked for them.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "apps/live_sources.h"
#include "live/cigi_ig.h"
#include "live/feed.h"
#include "live/network.h"
#include "live/xplane_link.h"
#include "session/session.h"

namespace fanbeam::apps {

class LiveListener {
 public:
  // `kept`: live/mailbox.h. `from` and `session` must outlive it, and it the networks that it is given.
  LiveListener(const std::vector<PosesFrom>& from, session::Session& session, double rate_Hz,
               std::size_t kept, const live::CigiStation& station);

  // Before the network starts; not in a replay.
  void listen(live::Network& network);
  // A frame begins: what is due to the other side is sent.
  void before_frame(live::Network& network);
  // No more is asked for.
  void leave(live::Network& network);
  void tell(live::Status& status) const;
  // Of a CIGI host: what it wants to see of a frame. Empty for others.
  std::function<void(live::LiveFrame&)> dress() const;
  const live::Mailbox& mailbox() const {
    return ig_ ? ig_->mailbox() : sources_.front().feed.mailbox();
  }
  // In the order of --from.
  std::vector<const live::Feed*> feeds() const;
  // The one whose weather counts; null where none does.
  const live::Feed* weather() const;
  // Null where it listens to no CIGI host.
  live::CigiIg* cigi() { return ig_ ? &*ig_ : nullptr; }

 private:
  struct Source {
    Source(const PosesFrom& told, const session::Session& session,
           std::shared_ptr<live::Mailbox> mailbox, std::size_t number);

    const PosesFrom& from;
    live::Feed feed;
  };
  void hear(Source& source, std::span<const std::uint8_t> datagram, const live::Sender& from);
  void listen_to_xplane(const PosesFrom& told, live::Network& network);

  std::deque<Source> sources_;
  std::optional<live::CigiIg> ig_;
  std::optional<live::XPlaneLink> xplane_;
};

}  // namespace fanbeam::apps
