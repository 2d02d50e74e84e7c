// fanbeam._core: what the package's Python files are written over. Not for users' hands.
#include "bindings/python/convert.h"
#include "bindings/python/lookups.h"
#include "bindings/python/scene.h"
#include "session/version.h"

using namespace fanbeam;

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the files of the package fanbeam are written over; use those.";
  bindings::translate_errors();
  bindings::add_scene(module);
  bindings::add_lookups(module);
  module.attr("version") = session::version_text();
}
