// Check of a reflection coefficient table (`_reflCoeff.xompt`) of ASAM OpenMATERIAL 3D 1.0 and 1.1.
//
// Such a table holds amplitudes per pair of directions, without the area of the surface that they
// belong to: nothing tells its backscatter from sigma0, so no reflectivity is made of it. It is
// read all the same, so that a damaged material is told.
#pragma once

#include <filesystem>

#include "core/errors.h"

namespace fanbeam::materials {

// Problems as PermittivityTable::from_file.
void check_reflection_table(const std::filesystem::path& file, core::ProblemList& problems);

}  // namespace fanbeam::materials
