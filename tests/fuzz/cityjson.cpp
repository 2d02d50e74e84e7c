// City models, and the faces that they are made of.
#include "terrain/buildings/cityjson.h"

#include <cmath>

#include "core/units.h"
#include "terrain/local_frame.h"
#include "terrain/mesh.h"
#include "tests/fuzz/fuzz_target.h"

using namespace fanbeam;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const terrain::LocalFrame frame({core::radians(52.1561), core::radians(5.3872), 0.0},
                                         terrain::EarthModel::wgs84);
  const std::string text(fuzz::text_of(data, size));
  (void)terrain::is_cityjson(text);
  fuzz::expect_answer([&](core::ProblemList& problems) {
    const terrain::CityModel city = terrain::read_cityjson(
        text, "city.json",
        {"EPSG:28992", [](const core::Geodetic& at) { return frame.to_local_m(at); }}, problems);
    for (const terrain::CityBuilding& building : city.buildings) {
      fuzz::must(!building.triangles.empty(), "no building without a triangle");
      fuzz::must(building.triangles.size() == building.triangle_surface.size(), "a surface each");
      for (const std::uint32_t surface : building.triangle_surface)
        fuzz::must(surface < city.surfaces.size(), "surfaces that there are");
      for (const glm::uvec3& triangle : building.triangles)
        for (int corner = 0; corner < 3; ++corner)
          fuzz::must(triangle[corner] < building.vertices_m.size(), "vertices that there are");
      for (const glm::dvec3& v : building.vertices_m)
        fuzz::must(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z),
                   "finite vertices");
    }
  });
  return 0;
}
