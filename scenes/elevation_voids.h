// Posts without a height (voids) in the elevation data of a scene, as far as its ground rests on
// them. Voids elsewhere in the file are nobody's business.
#pragma once

#include "core/errors.h"
#include "core/geodetic.h"
#include "scenes/description.h"
#include "terrain/height_field.h"
#include "terrain/local_frame.h"
#include "terrain/raster/elevation_raster.h"

namespace fanbeam::scenes {

// Their number among the posts that the heights of `field` were interpolated from, and where the
// first is (from north to south and west to east in most files): E-RANGE with the key that fills
// them, W-VOID where the scene has it.
void tell_used_voids(const TerrainDescription& terrain, const terrain::ElevationRaster& raster,
                     const terrain::HeightField& field, const terrain::LocalFrame& frame,
                     core::ProblemList& problems);

// Whether a post that the height there needs is still without one after filling.
bool is_in_hole(const terrain::ElevationRaster& raster, const core::Geodetic& position);

}  // namespace fanbeam::scenes
