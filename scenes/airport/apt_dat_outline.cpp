#include "scenes/airport/apt_dat_outline.h"

#include <cmath>

#include "core/constants.h"
#include "core/units.h"
#include "scenes/airport/airport_numbers.h"

namespace fanbeam::scenes {
namespace {

constexpr int kPieces = 8;
constexpr std::string_view kEdgeLights = "102";

// By whole turns to where it is nearest to `beside_rad`; there it stays to the bit.
double turned(double angle_rad, double beside_rad) {
  constexpr double kTurn_rad = 2.0 * core::kPi;
  return angle_rad - kTurn_rad * std::round((angle_rad - beside_rad) / kTurn_rad);
}

}  // namespace

void AptOutline::add(const std::vector<std::string_view>& fields, const core::Place& place,
                     core::ProblemList& problems) {
  const std::string_view code = fields[0];
  Node node;
  node.curved = code == "112" || code == "114" || code == "116";
  const std::size_t numbers = node.curved ? 5 : 3;
  if (fields.size() < numbers) {
    problems.error(core::ErrorClass::parse, place, "row " + std::string(code),
                   std::to_string(fields.size()) + " fields",
                   node.curved ? "5: a corner and its control point" : "3: a corner");
    return;
  }
  const auto angle_rad = [&](std::size_t index, const core::NumberRange& range) {
    return core::radians(
        airport_number(fields[index], "row " + std::string(code), range, "deg", place, problems)
            .value_or(0.0));
  };
  node.latitude_rad = angle_rad(1, kLatitude_deg);
  node.longitude_rad = angle_rad(2, kLongitude_deg);
  if (node.curved) {
    node.control_latitude_rad = angle_rad(3, kLatitude_deg);
    node.control_longitude_rad = angle_rad(4, kLongitude_deg);
  }
  for (std::size_t i = numbers; i < fields.size(); ++i)
    node.edge_lit = node.edge_lit || fields[i] == kEdgeLights;
  nodes_.push_back(node);
  if (code == "113" || code == "114") finish(true);
  if (code == "115" || code == "116") finish(false);
}

// From the first corner to just before the second.
AirportLine AptOutline::pieces(const Node& from, const Node& to) {
  AirportLine line{{from.latitude_rad, from.longitude_rad, 0.0}};
  if (!from.curved && !to.curved) return line;
  const auto along = [&](double t, double a, double a_control, double b, double b_control) {
    const double behind = a_control, before = 2.0 * b - b_control, s = 1.0 - t;
    if (from.curved && to.curved)
      return s * s * s * a + 3.0 * s * s * t * behind + 3.0 * s * t * t * before + t * t * t * b;
    return s * s * a + 2.0 * s * t * (from.curved ? behind : before) + t * t * b;
  };
  const auto beside = [&](double longitude_rad) {
    return turned(longitude_rad, from.longitude_rad);
  };
  const double control_rad = beside(from.control_longitude_rad), to_rad = beside(to.longitude_rad),
               to_control_rad = beside(to.control_longitude_rad);
  for (int i = 1; i < kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    line.push_back({along(t, from.latitude_rad, from.control_latitude_rad, to.latitude_rad,
                          to.control_latitude_rad),
                    turned(along(t, from.longitude_rad, control_rad, to_rad, to_control_rad), 0.0),
                    0.0});
  }
  return line;
}

void AptOutline::finish(bool closed) {
  AirportLine ring;
  AirportLine lit;
  const auto end_of_lights = [&] {
    if (lit.size() >= 2) edge_lights_.push_back(lit);
    lit.clear();
  };
  const std::size_t count = closed ? nodes_.size() : nodes_.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const Node& to = nodes_[(i + 1) % nodes_.size()];
    const AirportLine part = pieces(nodes_[i], to);
    ring.insert(ring.end(), part.begin(), part.end());
    if (!nodes_[i].edge_lit) {
      end_of_lights();
      continue;
    }
    if (!lit.empty()) lit.pop_back();  // the corner that both pieces have
    lit.insert(lit.end(), part.begin(), part.end());
    lit.push_back({to.latitude_rad, to.longitude_rad, 0.0});
  }
  end_of_lights();
  if (closed && ring.size() >= 3) rings_.push_back(std::move(ring));
  nodes_.clear();
}

}  // namespace fanbeam::scenes
