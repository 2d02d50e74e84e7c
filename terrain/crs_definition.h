// What a definition of a coordinate reference system makes PROJ open.
//
// PROJ resolves "+init=FILE:x", "+nadgrids=FILE" and their like by itself, wherever they lead, and
// GDAL hands it what a GeoJSON's "crs", a .prj or an .aux.xml says. A scene reads no files but those
// in its folders, so such definitions are refused before anybody resolves them.
#pragma once

#include <string>
#include <string_view>

namespace fanbeam::terrain {

// A PROJ string, WKT or name that names a file: init=, file=, model=, PARAMETERFILE, and grids other
// than "@null", whatever the case of the letters. Names too much rather than too little.
bool names_files(std::string_view definition);

// Whether any string inside a member "crs" of the GeoJSON does. Text that is no strict JSON but may
// hold such a member throws core::InputError E-PARSE at `file`: another parser may understand it.
// One pass without a tree, and none where no such member can be.
bool crs_names_files(std::string_view geojson, const std::string& file);

}  // namespace fanbeam::terrain
