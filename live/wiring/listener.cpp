#include "live/wiring/listener.h"

#include <string>
#include <utility>

namespace fanbeam::live {

Listener::Source::Source(const PosesFrom& told, const session::Session& session,
                         std::shared_ptr<Mailbox> mailbox, std::size_t number)
    : from(told),
      // A flight that is built in or read from a file needs no grid here.
      feed(session.scene(), told.listens() ? told.datum : core::VerticalDatum::scene,
           told.protocol ? *told.protocol : feeds::kProtocols[0], std::move(mailbox), number) {}

Listener::Listener(const std::vector<PosesFrom>& from, session::Session& session, double rate_Hz,
                   bool lockstep, const CigiStation& station) {
  const auto mailbox = std::make_shared<Mailbox>(lockstep);
  for (const PosesFrom& one : from) {
    sources_.emplace_back(one, session, mailbox, sources_.size());
    if (one.cigi) ig_.emplace(session, one.datum, lockstep, station);
    if (one.subscribes())
      xplane_.emplace(one.beacon ? std::nullopt : std::optional(one.listens_at), rate_Hz,
                      sources_.back().feed);
  }
}

void Listener::listen(Network& network) {
  for (Source& source : sources_)
    if (!source.from.subscribes())
      network.receive(
          source.from.listens_at,
          [this, &source](std::span<const std::uint8_t> datagram, const Sender& from) {
            hear(source, datagram, from);
          },
          source.from.peers);
  // Last: requests go out from the port that was opened last.
  for (const Source& source : sources_)
    if (source.from.subscribes()) listen_to_xplane(source.from, network);
}

// It answers to the port that asks, any that is free.
void Listener::listen_to_xplane(const PosesFrom& told, Network& network) {
  const Endpoint& there = told.listens_at;
  const bool six = there.address.find(':') != std::string::npos;
  Endpoint here;
  if (told.beacon)
    network.receive({std::string(feeds::kBeaconAddress), feeds::kBeaconPort, true},
                    [this](std::span<const std::uint8_t> datagram, const Sender& from) {
                      xplane_->take_beacon(datagram, from);
                    });
  if (told.beacon || there.beyond_loopback)
    here.address = six ? "::" : "0.0.0.0";
  else if (six)
    here.address = "::1";
  network.receive(here, [this](std::span<const std::uint8_t> datagram, const Sender& from) {
    xplane_->take(datagram, from);
  });
}

void Listener::hear(Source& source, std::span<const std::uint8_t> datagram, const Sender& from) {
  if (!from.is_peer)
    ig_ ? ig_->turn_away() : source.feed.turn_away();
  else if (ig_)
    ig_->take(datagram, from.address + ":" + std::to_string(from.port));
  else
    source.feed.take(datagram);
}

void Listener::tell(Status& status) const {
  status.packets = 0;
  status.bad_packets.clear();
  status.unused_packets.clear();
  if (ig_)
    ig_->tell(status);
  else
    for (const Source& source : sources_) source.feed.tell(status);
  if (status.stray_poses > 0)
    status.bad_packets.emplace_back(feeds::name_of(feeds::PacketFault::step), status.stray_poses);
  if (ig_) return;
  const auto leading = mailbox().leading();
  if (!leading) return;
  status.source = sources_[*leading].from.source;
  status.height_offset_m = sources_[*leading].feed.height_offset_m();
}

std::vector<const Feed*> Listener::feeds() const {
  std::vector<const Feed*> feeds;
  for (const Source& source : sources_) feeds.push_back(&source.feed);
  return feeds;
}

const Feed* Listener::weather() const {
  for (const Source& source : sources_)
    if (source.from.weather) return &source.feed;
  return nullptr;
}

std::function<void(LiveFrame&)> Listener::dress() const {
  if (!ig_) return {};
  return [this](LiveFrame& frame) { ig_->dress(frame); };
}

void Listener::before_frame(Network& network) {
  if (xplane_)
    for (XPlaneLink::Letter& letter : xplane_->requests())
      network.send(letter.to, std::move(letter.datagram));
  if (!ig_) return;
  std::vector<std::uint8_t> message = ig_->begin_frame();
  const std::string host = ig_->host();
  if (const auto& stated = sources_.front().from.host)
    network.send(*stated, std::move(message));
  else if (!host.empty())
    network.send(parse_endpoint(host, "--from"), std::move(message));
}

void Listener::before_letter(std::uint64_t number) {
  if (ig_) ig_->begin_letter(number);
}

void Listener::leave(Network& network) {
  if (!xplane_) return;
  for (XPlaneLink::Letter& letter : xplane_->farewell())
    network.send(letter.to, std::move(letter.datagram));
}

}  // namespace fanbeam::live
