#include "apps/live_listener.h"

#include <string>
#include <utility>

namespace fanbeam::apps {

LiveListener::LiveListener(const PosesFrom& from, session::Session& session, double rate_Hz,
                           std::size_t kept, const live::CigiStation& station)
    : from_(from),
      feed_(session.scene(), from.datum,
            from.protocol != nullptr ? *from.protocol : feeds::kProtocols[0], kept) {
  if (from.cigi) ig_.emplace(session, from.datum, kept, station);
  if (from.subscribes())
    xplane_.emplace(from.beacon ? std::nullopt : std::optional(from.listens_at), rate_Hz, feed_);
}

void LiveListener::listen(live::Network& network) {
  if (xplane_) return listen_to_xplane(network);
  network.receive(
      from_.listens_at,
      [this](std::span<const std::uint8_t> datagram, const live::Sender& from) {
        hear(datagram, from);
      },
      from_.peers);
}

// It answers to the port that asks, any that is free.
void LiveListener::listen_to_xplane(live::Network& network) {
  const live::Endpoint& there = from_.listens_at;
  const bool six = there.address.find(':') != std::string::npos;
  live::Endpoint here;
  if (from_.beacon)
    network.receive({std::string(feeds::kBeaconAddress), feeds::kBeaconPort, true},
                    [this](std::span<const std::uint8_t> datagram, const live::Sender& from) {
                      xplane_->take_beacon(datagram, from);
                    });
  if (from_.beacon || there.beyond_loopback)
    here.address = six ? "::" : "0.0.0.0";
  else if (six)
    here.address = "::1";
  network.receive(here, [this](std::span<const std::uint8_t> datagram, const live::Sender& from) {
    xplane_->take(datagram, from);
  });
}

void LiveListener::hear(std::span<const std::uint8_t> datagram, const live::Sender& from) {
  if (!from.is_peer)
    ig_ ? ig_->turn_away() : feed_.turn_away();
  else if (ig_)
    ig_->take(datagram, from.address + ":" + std::to_string(from.port));
  else
    feed_.take(datagram);
}

void LiveListener::tell(live::Status& status) const {
  if (ig_)
    ig_->tell(status);
  else
    feed_.tell(status);
}

std::function<void(live::LiveFrame&)> LiveListener::dress() const {
  if (!ig_) return {};
  return [this](live::LiveFrame& frame) { ig_->dress(frame); };
}

void LiveListener::before_frame(live::Network& network) {
  if (xplane_)
    for (live::XPlaneLink::Letter& letter : xplane_->requests())
      network.send(letter.to, std::move(letter.datagram));
  if (!ig_) return;
  std::vector<std::uint8_t> message = ig_->begin_frame();
  const std::string host = ig_->host();
  if (from_.host)
    network.send(*from_.host, std::move(message));
  else if (!host.empty())
    network.send(live::parse_endpoint(host, "--from"), std::move(message));
}

void LiveListener::leave(live::Network& network) {
  if (!xplane_) return;
  for (live::XPlaneLink::Letter& letter : xplane_->farewell())
    network.send(letter.to, std::move(letter.datagram));
}

}  // namespace fanbeam::apps
