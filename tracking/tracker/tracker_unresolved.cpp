// Pairs that the radar cannot resolve: set aside, parted again, given up.
#include <algorithm>
#include <limits>

#include "tracking/association/crossing.h"
#include "tracking/tracker/tracker_frame_private.h"

namespace fanbeam::tracking {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

template <typename Tracks>
auto* track_of(Tracks& tracks, int id) {
  const auto found =
      std::find_if(tracks.begin(), tracks.end(), [&](const Track& one) { return one.id == id; });
  return found == tracks.end() ? nullptr : &*found;
}

void set_aside(Track& track, const Track& with) {
  track.unresolved_with = with.id;
  track.unresolved_s = 0.0;
  track.unresolved_unseen = 0;
}

}  // namespace

// Lets a track take part again, with all of its coasting before it. What began on the echo of its pair has one of its
// own from then on, as any other.
void Tracker::release(Track& track) {
  track.unresolved_with.reset();
  track.unresolved_s = track.unseen_s = 0.0;
  track.coasted = 1;
  for (Track& other : tracks_)
    if (other.began_on == track.id) other.began_on.reset();
}

void Tracker::claim(Frame& frame) const {
  if (!frame.claims.empty()) return;
  frame.claims.resize(frame.measurements.size());
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!tracks_[i].confirmed) continue;
    const QuickGate gate(tracks_[i].state, measured_, gate_);
    for (std::size_t j = 0; j < frame.measurements.size(); ++j) {
      if (!gate.may_hold(frame.measurements[j])) continue;
      const Update told = innovation(tracks_[i].state, measured_, frame.measurements[j]);
      if (told.applied && told.normalised_innovation_squared <= gate_)
        frame.claims[j].push_back({i, told.log_likelihood});
    }
  }
}

// Of each measurement, if it is one's of a pair; kNone outside of its gate, for one that is used, and for one that fits a
// third track better, set aside or not: the gate of a pair that has been set aside for seconds reaches to the cars
// around it. A third in the pair's own cell keeps nothing from it: all of them are in that measurement. Nor does one
// that may have begun on the pair's one echo.
std::vector<double> Tracker::log_likelihoods(const Track& one, const Track& other,
                                             Frame& frame) const {
  claim(frame);
  const PolarPlace here = polar(one.state), there = polar(other.state);
  const auto keeps = [&](const Claim& claim, double log_likelihood) {
    const Track& third = tracks_[claim.track];
    if (third.id == one.id || third.id == other.id || third.began_on == one.id ||
        third.began_on == other.id || claim.log_likelihood <= log_likelihood)
      return false;
    const PolarPlace place = polar(third.state);
    return !unresolved(place, here, settings_.resolution) &&
           !unresolved(place, there, settings_.resolution);
  };
  std::vector<double> result(frame.measurements.size(), kNone);
  for (std::size_t j = 0; j < result.size(); ++j) {
    if (frame.used[j]) continue;
    const std::vector<Claim>& claims = frame.claims[j];
    const auto own = std::find_if(claims.begin(), claims.end(), [&](const Claim& claim) {
      return tracks_[claim.track].id == one.id;
    });
    if (own != claims.end() && std::none_of(claims.begin(), claims.end(), [&](const Claim& claim) {
          return keeps(claim, own->log_likelihood);
        }))
      result[j] = own->log_likelihood;
  }
  return result;
}

bool Tracker::is_measured(const Track& one, const Track& other, Frame& frame) const {
  const std::vector<double> fits = log_likelihoods(one, other, frame);
  return std::any_of(fits.begin(), fits.end(), [](double fit) { return fit > kNone; });
}

// Frames in which a pair shows nothing at all. Without azimuth merged beats may leave nothing.
void Tracker::coast_unresolved(double step_s, Frame& frame) {
  if (!has_azimuth()) return;
  std::vector<int> measured;  // ids
  for (const Track& track : tracks_) {
    if (!track.unresolved_with) continue;
    const Track* const other = track_of(tracks_, *track.unresolved_with);
    if (is_measured(track, other ? *other : track, frame)) measured.push_back(track.id);
  }
  const auto is_in = [&](int id) {
    return std::find(measured.begin(), measured.end(), id) != measured.end();
  };
  for (Track& track : tracks_) {
    if (!track.unresolved_with) continue;
    if (is_in(track.id) || is_in(*track.unresolved_with)) {
      track.unresolved_unseen = 0;
    } else {
      ++track.unresolved_unseen;
      track.existence.pass(step_s, settings_.believed_s);
      track.existence.missed(settings_.detection.detection_probability *
                             settings_.detection.gate_probability);
    }
  }
}

std::vector<Tracker::PairPlaces> Tracker::pairs_aside() const {
  std::vector<PairPlaces> pairs;
  for (const Track& one : tracks_) {
    if (!one.unresolved_with || one.id > *one.unresolved_with) continue;
    const Track* const other = track_of(tracks_, *one.unresolved_with);
    if (other != nullptr) pairs.push_back({one.id, polar(one.state), polar(other->state)});
  }
  return pairs;
}

// Pairs that have been one for too long. Whichever of them goes on, nothing tells which of the two it is.
void Tracker::give_up(double step_s, Frame& frame) {
  for (Track& track : tracks_) {
    if (!track.unresolved_with) continue;
    track.unresolved_s += step_s;
    if (track.unresolved_s <= settings_.most_unresolved_s) continue;
    track.given_up_with = track.unresolved_with;
    track.identity_probability *= 0.5;
    if (track.id < *track.given_up_with)
      crossings_.push_back({frame.time_s, track.id, *track.given_up_with, 0.5, true});
    release(track);
  }
}

// Pairs stay together until `part` or time separates them.
void Tracker::find_unresolved(double step_s, Frame& frame) {
  coast_unresolved(step_s, frame);
  give_up(step_s, frame);
  std::vector<PolarPlace> places;
  for (const Track& track : tracks_) places.push_back(polar(track.state));
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    for (std::size_t j = i + 1; j < tracks_.size(); ++j) {
      Track &a = tracks_[i], &b = tracks_[j];
      const bool close = unresolved(places[i], places[j], settings_.resolution);
      if (!close) {
        if (a.given_up_with == b.id) a.given_up_with.reset();
        if (b.given_up_with == a.id) b.given_up_with.reset();
        continue;
      }
      if (!a.confirmed || !b.confirmed || a.unresolved_with || b.unresolved_with ||
          a.given_up_with == b.id || b.given_up_with == a.id ||
          (has_azimuth() &&
           (seen_apart(a, b, frame) || !(is_measured(a, b, frame) || is_measured(b, a, frame)))))
        continue;
      set_aside(a, b);
      set_aside(b, a);
    }
}

void Tracker::part(Frame& frame) {
  for (Track& a : tracks_) {
    if (!a.unresolved_with) continue;
    Track* const b = track_of(tracks_, *a.unresolved_with);
    if (b == nullptr || b->unresolved_with != a.id) {
      release(a);
      continue;
    }
    const bool predicted_apart = !unresolved(polar(a.state), polar(b->state), settings_.resolution);
    if (b->id > a.id && (has_azimuth() || predicted_apart)) part(a, *b, frame);
  }
}

// The likeliest two measurements for the two tracks; nothing where the radar sees one or none there.
std::optional<std::pair<std::size_t, std::size_t>> Tracker::seen_apart(const Track& a,
                                                                       const Track& b,
                                                                       Frame& frame) const {
  const std::vector<RadarMeasurement>& seen = frame.measurements;
  const std::vector<double> fits_a = log_likelihoods(a, b, frame),
                            fits_b = log_likelihoods(b, a, frame);
  double best = kNone;
  std::optional<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = 0; j < seen.size(); ++j)
      if (i != j && fits_a[i] + fits_b[j] > best &&
          (has_azimuth() || !unresolved(polar(seen[i]), polar(seen[j]), settings_.resolution))) {
        best = fits_a[i] + fits_b[j];
        found = {i, j};
      }
  return found;
}

// Lets a pair go if there is a measurement for each.
void Tracker::part(Track& a, Track& b, Frame& frame) {
  const auto found = seen_apart(a, b, frame);
  if (!found) return;
  const RadarMeasurement &first = frame.measurements[found->first],
                         &second = frame.measurements[found->second];
  const double kept = kept_probability(a.state, b.state, measured_, first, second);
  release(a);
  release(b);
  hit(a, first);
  hit(b, second);
  frame.used[found->first] = frame.used[found->second] = true;
  a.identity_probability *= kept;
  b.identity_probability *= kept;
  crossings_.push_back({frame.time_s, a.id, b.id, 1.0 - kept, false});
}

}  // namespace fanbeam::tracking
