// Buildings from a CityJSON file, versions 1.1 and 2.0 (OGC 20-072r5, 2023), as triangles with the
// semantic surface that each of them belongs to.
//
// Read are Building, BuildingPart, BuildingInstallation, Bridge, BridgePart and their like; of each the
// geometries of the highest LoD from 1 to 3: Solid (its outer shell), MultiSurface, CompositeSurface,
// MultiSolid, CompositeSolid. Parts belong to the building that they hang under, also by way of a storey, a
// unit, a room or an extension's object, not to a CityObjectGroup; where BuildingParts have a higher
// LoD (of 1, 2, 3) and none of them lacks a surface that is seen, what the building has itself is left out. Left
// out, too: grounds and closures, rooms inside, textures, materials, templates (GeometryInstance), other objects
// of the city (roads, land, water, plants, tunnels, groups, the units of a building, whose walls its own hold),
// which are counted in a warning. A surface without semantics is a roof where it looks up, a wall where it
// stands within 30 deg of the vertical, a ground where it looks down.
//
// Coordinates: of metadata.referenceSystem, else of the system that is named; PROJ converts them to
// WGS 84 by the best way that it knows without grids (EPSG:7415 in the Netherlands: about 0.5 m). Heights
// stay as they are, in metres above the file's vertical datum.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "core/geodetic.h"

namespace fanbeam::terrain {

inline constexpr std::uint64_t kLargestCityFile_bytes = 400'000'000;
inline constexpr std::size_t kMostCityValues = 60'000'000;

struct CityBuilding {
  std::string id;  // the object's in the file
  std::vector<glm::dvec3> vertices_m;
  std::vector<glm::uvec3> triangles;            // counter-clockwise seen from outside
  std::vector<std::uint32_t> triangle_surface;  // in CityModel::surfaces
};

struct CityModel {
  std::vector<std::string> surfaces;  // "RoofSurface", "WallSurface", "Window", as met in the file
  std::vector<CityBuilding> buildings;  // each has a triangle
};

struct CityOptions {
  std::string crs;  // "EPSG:28992", for files that do not say; empty for none
  // Where a position stands in the scene's local frame.
  std::function<glm::dvec3(const core::Geodetic&)> local_m;
};

// Whether the text of a JSON file says that it is CityJSON.
bool is_cityjson(std::string_view json);

// Of the file's text; `name` goes into the messages. Throws InputError with all problems: those of
// core::parse_json; E-UNSUPPORTED (another version, a system in three dimensions from the Earth's
// centre), E-LIMIT (faces with more corners than corner_budget.h allows), E-PARSE (a value of another
// type than the format's), E-REF (no reference system, or one that PROJ does not know; a vertex or
// parent that is not there), E-RANGE (positions that have no place on the Earth). Warnings: W-UNUSED (a
// `crs` beside another one of the file); with counts, W-SKIPPED objects and faces, W-DEGENERATE faces
// without area.
CityModel read_cityjson(const std::string& text, const std::string& name,
                        const CityOptions& options, core::ProblemList& problems);

}  // namespace fanbeam::terrain
