# Only this file looks for what may be missing. It passes on what it finds as a
# definition or a variable: __has_include would leave no trace in the build,
# which would not notice a library that is installed later.
#
# build/left_out.txt lists what is left out of this build, a line each:
#
#   WHERE: WHAT (REASON; COMMAND that gets it)
#
# WHERE is programs, tests, book or test-windows. What the user switches off, as
# with -DLIGHTWALK_HIGHWAY=OFF, is not listed.
option(LIGHTWALK_HIGHWAY "Follow many paths at once where Highway is installed" ON)
option(LIGHTWALK_OPENIMAGEIO "Use OpenImageIO where it is installed" ON)

# watch(PATTERN...): a build runs CMake again when such a file comes or goes.
function(watch)
  file(GLOB seen CONFIGURE_DEPENDS ${ARGN})
endfunction()

# watch_header(NAME [SUFFIX]): the same for a header below any prefix.
function(watch_header name)
  set(places ${CMAKE_PREFIX_PATH} ${CMAKE_SYSTEM_PREFIX_PATH})
  list(TRANSFORM places APPEND "/include/${ARGN}/${name}")
  watch(${places})
endfunction()

set(left_out)
# leave_out(WHERE WHAT REASON [PURPOSE]): PURPOSE is an argument of setup.sh.
macro(leave_out where what reason)
  string(STRIP "tools/setup.sh ${ARGN}" command)
  string(APPEND left_out "${where}: ${what} (${reason}; ${command})\n")
endmacro()

# find_headers(VARIABLE NAME [SUFFIX]): the folder that has the header NAME.
# Each run of CMake looks for it again, and each build watches for it.
macro(find_headers variable name)
  watch_header(${name} ${ARGN})
  if(${variable} AND NOT EXISTS "${${variable}}/${name}")
    unset(${variable} CACHE)
  endif()
  find_path(${variable} ${name} PATH_SUFFIXES ${ARGN}
            HINTS ${LIGHTWALK_HEADER_FOLDER})
endmacro()

# find_command(VARIABLE NAMES...): the same for a program.
macro(find_command variable)
  file(TO_CMAKE_PATH "$ENV{PATH}" places)
  set(commands)
  foreach(place IN LISTS places)
    foreach(name ${ARGN})
      list(APPEND commands "${place}/${name}")
    endforeach()
  endforeach()
  watch(${commands})
  if(${variable} AND NOT EXISTS "${${variable}}")
    unset(${variable} CACHE)
  endif()
  find_program(${variable} NAMES ${ARGN})
endmacro()

# Highway: rows of paths for stage 6.
if(LIGHTWALK_HIGHWAY)
  find_headers(HIGHWAY_FOLDER hwy/highway.h)
endif()
if(LIGHTWALK_HIGHWAY AND HIGHWAY_FOLDER)
  target_include_directories(lightwalk SYSTEM INTERFACE ${HIGHWAY_FOLDER})
  target_compile_definitions(lightwalk INTERFACE LIGHTWALK_HIGHWAY)
endif()
if(LIGHTWALK_HIGHWAY AND LIGHTWALK_NATIVE AND instruction_sets AND NOT HIGHWAY_FOLDER)
  leave_out(programs "stage 6 follows one path at a time" "Highway is missing")
endif()

# Images: OpenImageIO; Images.cmake builds on this.
if(LIGHTWALK_OPENIMAGEIO)
  watch_header(OpenImageIO/imageio.h)
  # Debian's package of Imath warns of a file that it does not ship.
  set(CMAKE_MESSAGE_LOG_LEVEL ERROR)
  find_package(OpenImageIO CONFIG QUIET)
  unset(CMAKE_MESSAGE_LOG_LEVEL)
  if(NOT TARGET OpenImageIO::OpenImageIO)
    leave_out(programs "EXR" "OpenImageIO is missing")
  endif()
endif()

# Google Benchmark: `make bench`.
watch_header(benchmark/benchmark.h)
find_package(benchmark CONFIG QUIET)
if(LIGHTWALK_TESTS AND NOT benchmark_FOUND)
  leave_out(tests "the benchmarks" "Google Benchmark is missing")
endif()

# What the tools use; a student's tree has none of them.
include(${CMAKE_SOURCE_DIR}/tools/Optional.cmake OPTIONAL)

file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/left_out.txt CONTENT "${left_out}")
