#include "terrain/geoid.h"

#include <proj.h>

#include <cmath>
#include <memory>

#include "core/errors.h"
#include "core/units.h"

namespace fanbeam::terrain {
namespace {

struct ContextDeleter {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct TransformationDeleter {
  void operator()(PJ* transformation) const { proj_destroy(transformation); }
};

// A PROJ context and what was made in it belong to one thread.
class GeoidGrid {
 public:
  GeoidGrid() : context_(proj_context_create()) {
    proj_log_func(context_.get(), nullptr, [](void*, int, const char*) {});
    proj_context_set_enable_network(context_.get(), 0);
    height_above_ellipsoid_.reset(
        proj_create(context_.get(), "+proj=vgridshift +grids=egm96_15.gtx +multiplier=1"));
    // PROJ may open the grid only when it is first used, and then answers with infinity.
    if (!height_above_ellipsoid_ || !std::isfinite(height_m(0.0, 0.0)))
      core::throw_input_error(
          core::ErrorClass::io, "EGM96 geoid grid", "egm96_15.gtx",
          "the grid in PROJ's data folder (Debian package proj-data; PROJ_DATA overrides it)");
  }

  double height_m(double latitude_rad, double longitude_rad) const {
    return proj_trans(height_above_ellipsoid_.get(), PJ_FWD,
                      proj_coord(longitude_rad, latitude_rad, 0.0, 0.0))
        .lpz.z;
  }

 private:
  std::unique_ptr<PJ_CONTEXT, ContextDeleter> context_;
  std::unique_ptr<PJ, TransformationDeleter> height_above_ellipsoid_;
};

}  // namespace

double egm96_geoid_height_m(double latitude_rad, double longitude_rad) {
  if (!std::isfinite(latitude_rad) || !std::isfinite(longitude_rad))
    core::throw_input_error(core::ErrorClass::nonfinite, "geoid position",
                            std::isfinite(latitude_rad) ? longitude_rad : latitude_rad,
                            "a finite latitude and longitude");
  if (std::abs(latitude_rad) > 0.5 * core::kPi)
    core::throw_input_error(core::ErrorClass::range, "geoid latitude_deg",
                            core::degrees(latitude_rad), "-90 to 90 deg");
  thread_local const GeoidGrid grid;
  return grid.height_m(latitude_rad, core::wrap_pi_rad(longitude_rad));
}

double ellipsoidal_height_m(const core::Geodetic& at, core::VerticalDatum datum) {
  if (datum != core::VerticalDatum::egm96) return at.height_m;
  return at.height_m + egm96_geoid_height_m(at.latitude_rad, at.longitude_rad);
}

}  // namespace fanbeam::terrain
