# cmake --install: the program with its data, and a package that find_package(fanbeam) finds. Data lie in
# share/fanbeam beside bin/, where the program looks for them.
include(CMakePackageConfigHelpers)
set(data "${CMAKE_INSTALL_DATADIR}/fanbeam")
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/fanbeam")

install(TARGETS fanbeam)
install(DIRECTORY "${PROJECT_BINARY_DIR}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}")
install(FILES "${PROJECT_BINARY_DIR}/completion.bash" RENAME fanbeam
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
install(TARGETS fanbeam_pictures EXPORT fanbeamTargets)
install(TARGETS fanbeam_session_signal EXPORT fanbeamTargets)  # its headers lie below session/
foreach(folder core feeds materials atmosphere terrain sensors signal tracking renderer scenes session)
  install(TARGETS fanbeam_${folder} EXPORT fanbeamTargets)
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fanbeam"
          FILES_MATCHING PATTERN "*.h" PATTERN "*_private.h" EXCLUDE)
endforeach()

# The C interface, of which a program needs nothing but the library: a set of targets of its own.
install(TARGETS fanbeam_c EXPORT fanbeamCTargets)
install(FILES "${PROJECT_SOURCE_DIR}/bindings/c/fanbeam.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fanbeam")
install(FILES "${PROJECT_BINARY_DIR}/generated/c/fanbeam.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
install(EXPORT fanbeamCTargets NAMESPACE fanbeam:: DESTINATION "${package}")

if(TARGET fanbeam_python)
  set(python_package "${FANBEAM_PYTHON_DIR}/fanbeam")
  install(TARGETS fanbeam_python fanbeam_python_signal LIBRARY DESTINATION "${python_package}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/bindings/python/fanbeam/" DESTINATION "${python_package}"
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed")
endif()

foreach(folder materials sensors)
  file(GLOB files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.toml")
  install(FILES ${files} DESTINATION "${data}/${folder}")
endforeach()
file(GLOB scene_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/scenes/*/scene.toml")
foreach(scene_file IN LISTS scene_files)
  cmake_path(GET scene_file PARENT_PATH scene)
  install(DIRECTORY "${scene}" DESTINATION "${data}/scenes")
endforeach()

install(DIRECTORY plugins DESTINATION "${data}")

install(EXPORT fanbeamTargets NAMESPACE fanbeam:: DESTINATION "${package}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/fanbeamConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES cmake/fanbeamConfig.cmake cmake/FanbeamDependencies.cmake
              "${PROJECT_BINARY_DIR}/fanbeamConfigVersion.cmake" DESTINATION "${package}")
