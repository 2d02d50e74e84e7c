#include "live/pose_source.h"

#include <algorithm>
#include <utility>

#include "live/predictor.h"

namespace fanbeam::live {

PoseSource source_of(Flight flight) {
  return [flight = std::move(flight)](double, double at_s) {
    return std::optional(Sighting{flight(std::max(0.0, at_s))});
  };
}

PoseSource source_of(const Mailbox& mailbox, const terrain::LocalFrame& frame,
                     Clock::time_point begin, Journal* journal) {
  return [&mailbox, begin, journal, predictor = Predictor(frame), taken = std::uint64_t{0}](
             double now_s, double at_s) mutable -> std::optional<Sighting> {
    for (const Mailbox::Letter& letter : mailbox.after(taken)) {
      const double arrived_s = seconds_between(begin, letter.arrived);
      if (journal != nullptr) journal->packet(arrived_s, letter.packet, letter.source);
      predictor.take(letter.pose, arrived_s, letter.clock_s, letter.source);
      taken = letter.number;
    }
    const auto pose = predictor.at(at_s);
    if (!pose) return std::nullopt;
    return Sighting{*pose, std::max(0.0, now_s - *predictor.newest_s()), predictor.strays()};
  };
}

}  // namespace fanbeam::live
