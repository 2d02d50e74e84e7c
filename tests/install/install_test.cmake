# Installs into a folder whose name holds a space, renders a frame of the default scene with the installed program from
# elsewhere, then configures, builds and runs another project against the installed package.
# Called with -D BUILD, SCRATCH, SOURCE, CXX.
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

run("${CMAKE_COMMAND}" -G Ninja -S "${SOURCE}/tests/install/consumer" -B "${SCRATCH}/consumer"
    "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_CXX_COMPILER=${CXX}" -DCMAKE_BUILD_TYPE=Release)
run("${CMAKE_COMMAND}" --build "${SCRATCH}/consumer")
run("${SCRATCH}/consumer/consumer" "${prefix}/share/fanbeam" flat-grass)
file(REMOVE_RECURSE "${SCRATCH}")
