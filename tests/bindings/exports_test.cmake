# What libfanbeam.so shows is what its header declares, fanbeam_* alone, and it does not need FFTW, which is GPL. Neither
# it nor the program loads OpenImageIO and its 145 libraries before the first picture.
# Called with -D LIBRARY, PROGRAM, HEADER, NM, READELF.
execute_process(COMMAND "${NM}" -D --defined-only "${LIBRARY}" OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
set(shown "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^[^ ]* +[^ ] +([^@]+).*$" "\\1" symbol "${line}")
  if(NOT symbol STREQUAL "FANBEAM_0")  # the version itself
    list(APPEND shown "${symbol}")
  endif()
endforeach()
list(SORT shown)

# Words before a bracket, without those of comments.
file(READ "${HEADER}" header)
string(REGEX REPLACE "/\\*([^*]|\\*[^/])*\\*/" "" header "${header}")
string(REGEX MATCHALL "fanbeam_[a-z_]+\\(" declared "${header}")
list(TRANSFORM declared REPLACE "\\(" "")
list(REMOVE_DUPLICATES declared)
list(SORT declared)
if(NOT declared MATCHES "fanbeam_open" OR NOT shown STREQUAL declared)
  message(FATAL_ERROR "${LIBRARY} shows\n  ${shown}\nand ${HEADER} declares\n  ${declared}")
endif()

execute_process(COMMAND "${READELF}" -d "${LIBRARY}" OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
if(needed MATCHES "fftw" OR NOT needed MATCHES "libembree" OR NOT needed MATCHES "SONAME[^\n]*libfanbeam\\.so\\.0\\]")
  message(FATAL_ERROR "${LIBRARY} needs FFTW, has another soname, or nothing is known of it:\n${needed}")
endif()
execute_process(COMMAND "${READELF}" -d "${PROGRAM}" OUTPUT_VARIABLE more COMMAND_ERROR_IS_FATAL ANY)
if("${needed}${more}" MATCHES "OpenImageIO|fanbeam-pictures" OR NOT more MATCHES "libfftw")
  message(FATAL_ERROR "pictures are loaded at the start, or nothing is known of ${PROGRAM}:\n${needed}${more}")
endif()
