// The typical objects as a table for people.
#pragma once

#include <string>

#include "materials/rcs/object_library.h"

namespace fanbeam::apps {

// One line per object: name, mean and spread, Swerling case, where it is known, size, confidence,
// source; the notes below. Columns are aligned, lines end with a newline.
std::string objects_table(const materials::ObjectLibrary& library);

// `fanbeam materials objects`: prints the table of a library file, of the shipped one when empty.
int list_objects(const std::string& library_file);

}  // namespace fanbeam::apps
