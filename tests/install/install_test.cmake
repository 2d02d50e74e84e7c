# Installs into a folder whose name holds a space, renders a frame of the default scene with the installed program from
# elsewhere, then configures, builds and runs two other projects against the installed package, in C++ and through C.
# Called with -D BUILD, SCRATCH, SOURCE, CXX, CC, PYTHON_DIR.
set(prefix "${SCRATCH}/the prefix")
file(REMOVE_RECURSE "${SCRATCH}")
file(MAKE_DIRECTORY "${SCRATCH}/elsewhere")

function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY "${SCRATCH}/elsewhere" RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${prefix}")

# Every shipped data file arrives; without this the program could still find those of the source tree around it.
file(GLOB_RECURSE shipped RELATIVE "${SOURCE}" "${SOURCE}/scenes/*/*" "${SOURCE}/sensors/*.toml"
     "${SOURCE}/materials/*.toml")
list(FILTER shipped EXCLUDE REGEX "\\.(h|cpp)$")  # scenes/trajectory holds sources
if(NOT shipped)
  message(FATAL_ERROR "no data files in ${SOURCE}")
endif()
foreach(file IN LISTS shipped)
  if(NOT EXISTS "${prefix}/share/fanbeam/${file}")
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()

# So do the manual and the shell's completion.
foreach(file man/man1/fanbeam.1 man/man1/fanbeam-render.1 bash-completion/completions/fanbeam)
  if(NOT EXISTS "${prefix}/share/${file}")
    message(FATAL_ERROR "not installed: share/${file}")
  endif()
endforeach()

run("${prefix}/bin/fanbeam" render --frames 0:1 -o "${SCRATCH}/pictures")
foreach(file bscope/00000.png cscope/00000.png run.json)
  if(NOT EXISTS "${SCRATCH}/pictures/${file}")
    message(FATAL_ERROR "not rendered: ${file}")
  endif()
endforeach()

# import fanbeam, which finds the installed files from where it lies itself.
file(WRITE "${SCRATCH}/elsewhere/look.py" "import fanbeam
scene = fanbeam.Scene.open('flat-grass')
assert fanbeam.__file__.startswith('${prefix}'), fanbeam.__file__
assert scene.render(0).bscope.shape == (524, 164)
")
run("${CMAKE_COMMAND}" -E env "PYTHONPATH=${prefix}/${PYTHON_DIR}" /usr/bin/python3 look.py)
# Below /usr/local, the prefix of docs/installing.md, python3 looks there by itself.
execute_process(COMMAND /usr/bin/python3 -c "import sys; print(':'.join(sys.path) + ':')" OUTPUT_VARIABLE looked_at
                COMMAND_ERROR_IS_FATAL ANY)
if(NOT looked_at MATCHES "/usr/local/${PYTHON_DIR}:")
  message(FATAL_ERROR "python3 does not look in /usr/local/${PYTHON_DIR}:\n${looked_at}")
endif()

run("${CMAKE_COMMAND}" -G Ninja -S "${SOURCE}/tests/install/consumer" -B "${SCRATCH}/consumer"
    "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER=${CXX}" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/consumer")
# FFTW is GPL: fanbeam::session comes without it.
execute_process(COMMAND readelf -d "${SCRATCH}/consumer/consumer" OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
if(needed MATCHES "fftw" OR NOT needed MATCHES "libembree")
  message(FATAL_ERROR "fanbeam::session links FFTW, or nothing is known of what it links:\n${needed}")
endif()
run("${SCRATCH}/consumer/consumer" "${prefix}/share/fanbeam" flat-grass)

# The C interface, by the example in C99 and a program in C++, which need libfanbeam.so and no package that it is built of.
set(scene "${prefix}/share/fanbeam/scenes/flat-grass")
run("${CMAKE_COMMAND}" -G Ninja -S "${SOURCE}/tests/install/consumer_c" -B "${SCRATCH}/consumer_c"
    "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_C_COMPILER=${CC}" "-DCMAKE_CXX_COMPILER=${CXX}"
    -DCMAKE_BUILD_TYPE=Release "-DEXAMPLE=${SOURCE}/bindings/c/example.c")
run("${CMAKE_COMMAND}" --build "${SCRATCH}/consumer_c")
run("${SCRATCH}/consumer_c/consumer" "${prefix}/share/fanbeam" "${scene}")
run("${SCRATCH}/consumer_c/example" "${prefix}/share/fanbeam" "${scene}")
# A part that there is not is not found, instead of nothing being said.
file(WRITE "${SCRATCH}/wrong/CMakeLists.txt" "cmake_minimum_required(VERSION 3.25)
project(wrong CXX)
find_package(fanbeam COMPONENTS session nonsense)
if(fanbeam_FOUND OR NOT fanbeam_NOT_FOUND_MESSAGE MATCHES nonsense)
  message(FATAL_ERROR \"found nonsense: \${fanbeam_NOT_FOUND_MESSAGE}\")
endif()
")
run("${CMAKE_COMMAND}" -G Ninja -S "${SCRATCH}/wrong" -B "${SCRATCH}/wrong/build" "-DCMAKE_PREFIX_PATH=${prefix}"
    "-DCMAKE_CXX_COMPILER=${CXX}")
file(SIZE "${SCRATCH}/elsewhere/bscope.pgm" bytes)
if(NOT bytes EQUAL 85951)  # "P5\n164 524\n255\n" and 164 x 524
  message(FATAL_ERROR "bscope.pgm has ${bytes} bytes")
endif()
execute_process(COMMAND readelf -d "${SCRATCH}/consumer_c/example" OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
if(needed MATCHES "fftw|libembree" OR NOT needed MATCHES "libfanbeam\\.so\\.0\\]")
  message(FATAL_ERROR "the example needs more than libfanbeam.so.0, or not that:\n${needed}")
endif()

# The same without CMake.
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(GLOB_RECURSE description "${prefix}/*/fanbeam.pc")
  cmake_path(GET description PARENT_PATH folder)
  execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PKG_CONFIG_PATH=${folder}" "${PKG_CONFIG}" --cflags --libs fanbeam
                  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run("${CC}" -std=c99 "${SOURCE}/bindings/c/example.c" ${flags} -o "${SCRATCH}/by_pkg_config")
  cmake_path(GET folder PARENT_PATH folder)
  run("${CMAKE_COMMAND}" -E env "LD_LIBRARY_PATH=${folder}" "${SCRATCH}/by_pkg_config"
      "${prefix}/share/fanbeam" "${scene}")
endif()

# Without the library of pictures all goes on but pictures, of which it is told what is missing.
file(GLOB_RECURSE pictures "${prefix}/*/libfanbeam-pictures.so*")
if(NOT pictures)
  message(FATAL_ERROR "no library of pictures in ${prefix}")
endif()
file(REMOVE ${pictures})
run("${prefix}/bin/fanbeam" list)
execute_process(COMMAND "${prefix}/bin/fanbeam" render flat-grass -o "${SCRATCH}/none" RESULT_VARIABLE result
                OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 4 OR NOT output MATCHES "libfanbeam-pictures.so.0.*the part of fanbeam that reads and writes pictures")
  message(FATAL_ERROR "without its library of pictures render ended with ${result}:\n${output}")
endif()
execute_process(COMMAND "${prefix}/bin/fanbeam" live flat-grass --http 0 --frames 1 RESULT_VARIABLE result
                OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 4 OR NOT output MATCHES "libfanbeam-pictures.so.0")
  message(FATAL_ERROR "without its library of pictures live ended with ${result}:\n${output}")
endif()
file(REMOVE_RECURSE "${SCRATCH}")
