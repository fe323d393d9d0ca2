# The suites: one doctest program for the core, one for each stage. All that a
# student's tree needs, too.

# A stage's header alone is a target, stageN_header, which has the word on its
# errors and warnings: all else that includes it does so by way of a file that
# keeps them quiet.
set(quiet_folder ${CMAKE_CURRENT_BINARY_DIR}/generated/quiet)
file(GLOB stage_headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}
     ${CMAKE_SOURCE_DIR}/stages/[1-9]_*/path_tracer.hpp)
foreach(header IN LISTS stage_headers)
  string(REGEX REPLACE "stages/([1-9])_.*" "stage\\1" stage ${header})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/alone/${header}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
  add_library(${stage}_header OBJECT ${source})
  target_link_libraries(${stage}_header PRIVATE lightwalk)
  if(NOT MSVC)
    target_compile_options(${stage}_header PRIVATE -O0)
  endif()
  file(CONFIGURE OUTPUT ${quiet_folder}/${header}
       CONTENT "#pragma once\n#pragma GCC system_header\n#include \"${CMAKE_SOURCE_DIR}/${header}\"\n")
endforeach()

# doctest's own code and ours that reads scenes and images, compiled once.
file(GLOB support CONFIGURE_DEPENDS support/*.cpp)
list(FILTER support EXCLUDE REGEX "/main\\.cpp$")
# add_test_support(SUFFIX OPTIONS...): test_support and test_main, with options
# that what is linked to them needs, too.
function(add_test_support suffix)
  add_library(test_support${suffix} OBJECT ${support})
  target_link_libraries(test_support${suffix}
                        PUBLIC lightwalk doctest::doctest
                               tomlplusplus::tomlplusplus)
  target_include_directories(test_support${suffix}
                             PUBLIC ${quiet_folder} ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(
    test_support${suffix}
    PUBLIC SCENES="${CMAKE_SOURCE_DIR}/scenes"
           GOLDENS="${CMAKE_CURRENT_SOURCE_DIR}/golden"
           $<$<CXX_COMPILER_ID:GNU>:_GLIBCXX_ASSERTIONS>)
  target_compile_options(test_support${suffix} PUBLIC ${ARGN})
  if(NOT MSVC)
    target_compile_options(test_support${suffix}
                           PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  add_library(test_main${suffix} OBJECT support/main.cpp)
  target_link_libraries(test_main${suffix} PUBLIC test_support${suffix}
                                           PRIVATE program_manifest)
endfunction()
add_test_support("")

# Runs a suite, says how it ended, and stops a test that does not end. It is the
# only one to stop it: by the clock, a busy machine is as slow as an endless loop.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
set(run_suite ${Python3_EXECUTABLE} -B -m tests.runner)

# GCC 12's search for leaks crashes over the thread's variables of libraries
# that were loaded late, which it learns of by this interceptor.
set(leak_options
    "ASAN_OPTIONS=intercept_tls_get_addr=0"
    "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_SOURCE_DIR}/leaks.supp:print_suppressions=0"
)

# add_suite(NAME [SUFFIX]): NAME_tests, from the folder NAME, with the
# test_support of that suffix.
function(add_suite name)
  file(GLOB sources CONFIGURE_DEPENDS ${name}/*.cpp)
  if(NOT sources) # a stage that is being written
    return()
  endif()
  add_executable(${name}_tests ${sources})
  target_link_libraries(${name}_tests PRIVATE test_support${ARGN}
                                              test_main${ARGN})
  set_target_properties(${name}_tests PROPERTIES BUILD_RPATH_USE_ORIGIN ON
                                                 BUILD_RPATH "${program_folder}")
  add_dependencies(${name}_tests image_module)
  add_test(NAME ${name} COMMAND ${run_suite} $<TARGET_FILE:${name}_tests>
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS ${name} TIMEOUT 0 ENVIRONMENT
                                          "${leak_options}")
endfunction()

# add_one_file_suite(NAME): NAME_check, the same tests as one file, which
# compiles in half the time, after all that does not change. What the sources
# include comes first, and then each in a namespace of its own, since each has
# helpers of the same names.
function(add_one_file_suite name)
  file(GLOB sources CONFIGURE_DEPENDS ${name}/*.cpp)
  if(NOT sources)
    return()
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated/${name})
  set(text)
  set(given "#pragma once\n")
  set(number 0)
  foreach(source IN LISTS sources)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} includes REGEX "^#include ")
    foreach(include IN LISTS includes)
      if(include MATCHES "\"stages/")
        string(APPEND text "${include}\n")
      else()
        string(APPEND given "${include}\n")
      endif()
    endforeach()
    math(EXPR number "${number} + 1")
    string(APPEND parts "namespace source${number} {\n#include \"${source}\"\n}\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/given.hpp CONTENT "${given}")
  file(CONFIGURE OUTPUT ${folder}/suite.cpp CONTENT "#include \"given.hpp\"\n${text}${parts}")
  add_executable(${name}_check EXCLUDE_FROM_ALL ${folder}/suite.cpp)
  target_include_directories(${name}_check PRIVATE ${folder})
  target_precompile_headers(${name}_check PRIVATE ${folder}/given.hpp)
  target_link_libraries(${name}_check PRIVATE test_support test_main)
  if(NOT MSVC)
    target_compile_options(${name}_check PRIVATE $<$<CONFIG:Release>:-O1> -w)
  endif()
  set_target_properties(${name}_check PROPERTIES BUILD_RPATH_USE_ORIGIN ON
                                                 BUILD_RPATH "${program_folder}")
  add_dependencies(${name}_check image_module)
endfunction()

# What works on rows of paths is tested with the widest rows that there are
# here. All of its suite is compiled for them, as packs of shapes have another
# layout there.
foreach(stage IN LISTS stages)
  if(stage IN_LIST stages_of_rows)
    if(NOT TARGET test_support_of_rows)
      add_test_support(_of_rows ${native_options})
    endif()
    target_compile_options(${stage}_header PRIVATE ${native_options})
    add_suite(${stage} _of_rows)
  else()
    add_suite(${stage})
    add_one_file_suite(${stage})
  endif()
endforeach()
