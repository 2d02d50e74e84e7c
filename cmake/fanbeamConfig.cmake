# find_package(fanbeam) gives fanbeam::core, fanbeam::renderer and the other libraries, named after their folders.
include("${CMAKE_CURRENT_LIST_DIR}/FanbeamDependencies.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/fanbeamTargets.cmake")
