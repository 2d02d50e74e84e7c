// The tables of scene.toml with point scatterers: [[target]] and [[line]].
#pragma once

#include "core/config_table.h"
#include "scenes/description.h"
#include "scenes/object_names.h"

namespace fanbeam::scenes {

TargetDescription read_target(core::ConfigTable& table, ObjectNames& objects);
LineDescription read_line(core::ConfigTable& table, ObjectNames& objects);

}  // namespace fanbeam::scenes
