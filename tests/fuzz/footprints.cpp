// GeoJSON footprints, and the buildings that stand on them.
#include "terrain/buildings/footprints.h"

#include <cmath>

#include "core/units.h"
#include "terrain/buildings/extrusion.h"
#include "terrain/local_frame.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

namespace {

terrain::Ring_m local_ring_m(const terrain::GeodeticRing& ring, const terrain::LocalFrame& frame) {
  terrain::Ring_m local_m;
  for (const terrain::GeodeticPoint& point : ring) {
    const glm::dvec3 p_m = frame.to_local_m({point.latitude_rad, point.longitude_rad, 0.0});
    local_m.emplace_back(p_m.x, p_m.y);
  }
  return local_m;
}

// Far away ones never get this far: a scene leaves out what is not on its terrain.
bool is_near(const terrain::Ring_m& ring_m) {
  for (const glm::dvec2& p_m : ring_m)
    if (std::abs(p_m.x) > 200e3 || std::abs(p_m.y) > 200e3) return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const terrain::LocalFrame frame({core::radians(52.3), core::radians(10.5), 80.0},
                                         terrain::EarthModel::wgs84);
  const std::filesystem::path file =
      fuzz::scratch_file("footprints.geojson", fuzz::text_of(data, size));
  fuzz::expect_answer([&](core::ProblemList& problems) {
    std::vector<terrain::Prism> prisms;
    for (const terrain::Footprint& footprint : terrain::read_footprints(file, {}, problems)) {
      fuzz::must(footprint.outer.size() >= 3, "rings of three points or more");
      terrain::Prism prism;
      prism.outer_m = local_ring_m(footprint.outer, frame);
      for (const terrain::GeodeticRing& hole : footprint.holes)
        prism.holes_m.push_back(local_ring_m(hole, frame));
      prism.bottom_m = footprint.min_height_m;
      prism.top_m = footprint.height_m;
      if (is_near(prism.outer_m)) prisms.push_back(std::move(prism));
    }
    const terrain::Extrusion city = terrain::extrude(prisms, "city", {}, problems);
    for (const glm::dvec3& v : city.mesh.vertices_m)
      fuzz::must(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z), "finite vertices");
  });
  return 0;
}
