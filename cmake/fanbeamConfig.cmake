# find_package(fanbeam) gives fanbeam::core, fanbeam::renderer and the other libraries, named after their folders, and
# fanbeam::c. find_package(fanbeam COMPONENTS c) gives fanbeam::c alone and looks for no package that fanbeam is built of.
include("${CMAKE_CURRENT_LIST_DIR}/fanbeamCTargets.cmake")
if(NOT "${fanbeam_FIND_COMPONENTS}" STREQUAL "c")
  include("${CMAKE_CURRENT_LIST_DIR}/FanbeamDependencies.cmake")
  include("${CMAKE_CURRENT_LIST_DIR}/fanbeamTargets.cmake")
endif()
foreach(component IN LISTS fanbeam_FIND_COMPONENTS)
  if(fanbeam_FIND_REQUIRED_${component} AND NOT TARGET fanbeam::${component})
    set(fanbeam_FOUND FALSE)
    string(APPEND fanbeam_NOT_FOUND_MESSAGE "fanbeam has no part \"${component}\". ")
  endif()
endforeach()
