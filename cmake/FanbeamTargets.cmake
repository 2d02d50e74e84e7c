# One static library per folder, with the same flags everywhere.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
include(GNUInstallDirs)
set(CMAKE_BUILD_RPATH "${PROJECT_BINARY_DIR}/lib")  # for libfanbeam-pictures.so

add_library(fanbeam_options INTERFACE)
target_compile_options(fanbeam_options INTERFACE
  # Fused multiply-add would make results depend on the instruction set.
  -ffp-contract=off
  -Wall -Wextra -Wshadow -Wdouble-promotion -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 warns of strings that it has joined itself (its bug 105651), and of unnamed namespaces in a file that another
  # one includes, which is what a unity build does.
  target_compile_options(fanbeam_options INTERFACE -Wno-restrict $<$<BOOL:${FANBEAM_UNITY}>:-Wno-subobject-linkage>)
endif()
if(FANBEAM_SANITIZER STREQUAL "address")
  # With the checks of the standard library. The cast of a number beyond its integer type is no part of "undefined". The
  # three left out look at pointers before they are used, which the address sanitizer does when they are: a quarter of
  # the compiling and a third of the tests' time.
  target_compile_options(fanbeam_options INTERFACE
    -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=null,object-size,pointer-overflow
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # GCC's macro, which clang 14 does not define.
  target_compile_definitions(fanbeam_options INTERFACE _GLIBCXX_ASSERTIONS __SANITIZE_ADDRESS__=1)
  target_link_options(fanbeam_options INTERFACE -fsanitize=address,undefined)
elseif(FANBEAM_SANITIZER STREQUAL "thread")
  target_compile_options(fanbeam_options INTERFACE -fsanitize=thread -fno-omit-frame-pointer)
  target_link_options(fanbeam_options INTERFACE -fsanitize=thread)
endif()

# Under the sanitizers: folders without kernels, which unoptimised compile in a third of the time, and those whose readers
# are fuzzed, with the coverage that libFuzzer steers by (up to a fifth of the compiling).
set(without_kernels session session_signal measure datasets live)
set(fuzzed core feeds materials terrain sensors scenes session_signal datasets live)
function(fanbeam_sanitized target folder)
  if(FANBEAM_SANITIZER AND folder IN_LIST without_kernels)
    target_compile_options(${target} PRIVATE -O0)
  endif()
  if(FANBEAM_SANITIZER STREQUAL "address" AND folder IN_LIST fuzzed)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

# Compiles the sources of a target 24 at a time (8 took two thirds more of the compiler's time), never of two folders
# together: a folder's sources share no name in their unnamed namespaces (tests/core/unnamed_namespace_test.cpp), so that
# it makes no difference which.
function(fanbeam_unity target)
  if(NOT FANBEAM_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_filename_component(folder "${source}" DIRECTORY)
    string(MAKE_C_IDENTIFIER "${folder}" folder)
    if(NOT DEFINED count_${folder})
      set(count_${folder} 0)
    endif()
    math(EXPR batch "${count_${folder}} / 24")
    math(EXPR count_${folder} "${count_${folder}} + 1")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_${batch}")
  endforeach()
endfunction()

# fanbeam_library(core EXCEPT e PUBLIC a b PRIVATE c d): sources are all .cpp files in and under the folder but those of
# its folder e.
function(fanbeam_library name)
  cmake_parse_arguments(ARG "" "EXCEPT" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "*.cpp")
  if(ARG_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "^${CMAKE_CURRENT_SOURCE_DIR}/${ARG_EXCEPT}/")
  endif()
  add_library(fanbeam_${name} STATIC ${sources})
  fanbeam_unity(fanbeam_${name})
  fanbeam_sanitized(fanbeam_${name} ${name})
  # Shared libraries hold them too: libfanbeam.so. Hidden, so that code that could stand anywhere costs nothing (no symbol
  # can be replaced by another library's); programs and libraries that link them statically see no difference.
  set_target_properties(fanbeam_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  add_library(fanbeam::${name} ALIAS fanbeam_${name})
  set_target_properties(fanbeam_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(fanbeam_${name} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/fanbeam>")
  target_compile_features(fanbeam_${name} PUBLIC cxx_std_20)
  target_link_libraries(fanbeam_${name} PUBLIC ${ARG_PUBLIC}
    PRIVATE "$<BUILD_INTERFACE:fanbeam_options>" ${ARG_PRIVATE})
endfunction()
