# The suites: one doctest program for the core, one for each stage. A student's
# tree needs all of this, too.

# What a stage's functions do is compiled by itself, stageN_header, with the
# compiler's warnings; tests see what the header declares, and are compiled once
# (split_header.py). A header without exercises is included as it is.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter)
set(declared_folder ${CMAKE_CURRENT_BINARY_DIR}/generated/declared)
file(GLOB stage_headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}
     ${CMAKE_SOURCE_DIR}/stages/[1-9]_*/path_tracer.hpp)
# stage_target(TARGET SOURCE): compiled as a stage's header is.
function(stage_target target source)
  add_library(${target} OBJECT ${source})
  target_link_libraries(${target} PRIVATE lightwalk)
  target_compile_definitions(
    ${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:_GLIBCXX_ASSERTIONS>)
  if(NOT LIGHTWALK_WARNINGS_AS_ERRORS)
    target_compile_definitions(${target} PRIVATE LIGHTWALK_ALL_WARNINGS)
  endif()
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
  endif()
endfunction()

# What they include of the core, once.
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/generated/core_of_stages.cpp
     CONTENT "")
stage_target(core_of_stages
             ${CMAKE_CURRENT_BINARY_DIR}/generated/core_of_stages.cpp)
target_precompile_headers(
  core_of_stages PRIVATE ${CMAKE_SOURCE_DIR}/common/scene/scene.hpp
  ${CMAKE_SOURCE_DIR}/common/scene/surface.hpp)

foreach(header IN LISTS stage_headers)
  string(REGEX REPLACE "stages/([1-9])_.*" "stage\\1" stage ${header})
  set(code ${CMAKE_CURRENT_BINARY_DIR}/generated/${stage}.cpp)
  file(STRINGS ${CMAKE_SOURCE_DIR}/${header} exercises REGEX "#region exercise")
  if(exercises AND NOT MSVC)
    add_custom_command(
      OUTPUT ${declared_folder}/${header} ${code}
      COMMAND
        ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/split_header.py
        ${CMAKE_SOURCE_DIR}/${header} ${declared_folder}/${header} ${code}
      DEPENDS ${CMAKE_SOURCE_DIR}/${header}
              ${CMAKE_CURRENT_SOURCE_DIR}/split_header.py
      COMMENT "What ${header} declares"
      VERBATIM)
    list(APPEND declared_headers ${declared_folder}/${header})
    stage_target(${stage}_header ${code})
    target_precompile_headers(${stage}_header REUSE_FROM core_of_stages)
  else()
    file(CONFIGURE OUTPUT ${code} CONTENT "#include \"${header}\"\n")
    file(CONFIGURE OUTPUT ${declared_folder}/${header}
         CONTENT "#pragma once\n#pragma GCC system_header\n#include \"${CMAKE_SOURCE_DIR}/${header}\"\n")
    stage_target(${stage}_header ${code})
  endif()
endforeach()
add_custom_target(declared_headers DEPENDS ${declared_headers})

# link_stages(TARGET PATTERN): what tests see declared of the stages of such numbers.
function(link_stages target pattern)
  foreach(header IN LISTS stage_headers)
    if(header MATCHES "^stages/(${pattern})_")
      target_sources(${target}
                     PRIVATE $<TARGET_OBJECTS:stage${CMAKE_MATCH_1}_header>)
    endif()
  endforeach()
  add_dependencies(${target} declared_headers)
endfunction()

# doctest's code and the project's readers of scenes and images, compiled once.
file(GLOB support CONFIGURE_DEPENDS support/*.cpp)
list(FILTER support EXCLUDE REGEX "/main\\.cpp$")
add_library(test_support OBJECT ${support})
target_link_libraries(test_support PUBLIC lightwalk doctest::doctest
                                          tomlplusplus::tomlplusplus)
target_include_directories(test_support PUBLIC ${declared_folder}
                                               ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(
  test_support
  PUBLIC SCENES="${CMAKE_SOURCE_DIR}/scenes"
         GOLDENS="${CMAKE_CURRENT_SOURCE_DIR}/golden"
         $<$<CXX_COMPILER_ID:GNU>:_GLIBCXX_ASSERTIONS>)
# Tests run for seconds, and each change of a stage compiles them again. Only
# stageN_header shows the compiler's warnings about a stage.
set(test_options)
if(NOT MSVC)
  set(test_options $<$<CONFIG:Release>:-O1>)
  if(NOT LIGHTWALK_WARNINGS_AS_ERRORS)
    list(APPEND test_options -w)
  endif()
endif()
target_compile_options(test_support PRIVATE ${test_options})
# toml++ takes longer to read than all of it to compile: once is enough.
set_target_properties(test_support PROPERTIES UNITY_BUILD ON)
add_library(test_main OBJECT support/main.cpp)
target_link_libraries(test_main PUBLIC test_support)

# Runs a suite, reports how it ended, and stops a test that does not end. CTest
# has no time limit: a busy machine may be as slow as an endless loop.
set(run_suite ${Python3_EXECUTABLE} -B -m tests.runner)

# GCC 12's leak detection crashes on thread-local variables of libraries that
# were loaded late; it finds them through this interceptor.
set(leak_options
    "ASAN_OPTIONS=intercept_tls_get_addr=0"
    "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_SOURCE_DIR}/leaks.supp:print_suppressions=0"
)

# The tests in every_stage/ expect a right mean of each sample. These stages are
# right in the limit only, and their own tests know how far off they may be.
set(biased_stages 7)

# add_suite(NAME): NAME_tests, from the folder NAME, and for a stage also from
# every_stage/, up to this stage. They are compiled as one file, or as a few if
# there are many, after a precompiled header of all includes that no stage
# changes: a third of the time. Each has its own namespace, since helpers have
# the same names. Files that replace library functions have other names, and are
# compiled alone.
function(add_suite name)
  file(GLOB sources CONFIGURE_DEPENDS ${name}/test_*.cpp)
  file(GLOB others CONFIGURE_DEPENDS ${name}/*.cpp)
  list(FILTER others EXCLUDE REGEX "/test_[^/]*$")
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated/${name})
  if(name MATCHES "^stage([1-9])$")
    set(stage_number ${CMAKE_MATCH_1})
    file(GLOB stage_header RELATIVE ${CMAKE_SOURCE_DIR}
         ${CMAKE_SOURCE_DIR}/stages/${stage_number}_*/path_tracer.hpp)
    configure_file(every_stage/stage.hpp.in ${folder}/stage.hpp @ONLY)
    if(NOT stage_number IN_LIST biased_stages)
      file(GLOB shared CONFIGURE_DEPENDS
           every_stage/from_stage[1-${stage_number}].cpp)
      list(PREPEND sources ${shared})
    endif()
  endif()
  set(given "#pragma once\n#include <doctest/doctest.h>\n")
  set(stage_includes "#include \"given.hpp\"\n")
  set(number 0)
  foreach(source IN LISTS sources)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    file(STRINGS ${source} includes REGEX "^#include ")
    foreach(include IN LISTS includes)
      if(include MATCHES "\"(stages/|stage\\.hpp)")
        string(APPEND stage_includes "${include}\n")
      else()
        string(APPEND given "${include}\n")
      endif()
    endforeach()
    math(EXPR part "${number} / 16")
    math(EXPR number "${number} + 1")
    string(APPEND part${part} "namespace source${number} {\n#include \"${source}\"\n}\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/given.hpp CONTENT "${given}")
  set(parts)
  foreach(index RANGE ${part})
    list(APPEND parts ${folder}/suite${index}.cpp)
    file(CONFIGURE OUTPUT ${folder}/suite${index}.cpp
         CONTENT "${stage_includes}${part${index}}")
  endforeach()
  add_executable(${name}_tests ${parts} ${others} ${processor_check})
  target_include_directories(${name}_tests PRIVATE ${folder})
  target_precompile_headers(${name}_tests PRIVATE ${folder}/given.hpp)
  target_link_libraries(${name}_tests PRIVATE test_support test_main program_manifest)
  target_compile_options(${name}_tests PRIVATE ${test_options})
  if(stage_number)
    link_stages(${name}_tests "[1-${stage_number}]")
  endif()
  set_target_properties(${name}_tests PROPERTIES BUILD_RPATH_USE_ORIGIN ON
                                                 BUILD_RPATH "${program_folder}")
  add_test(NAME ${name} COMMAND ${run_suite} $<TARGET_FILE:${name}_tests>
           WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS ${name} TIMEOUT 0 ENVIRONMENT
                                          "${leak_options}")
endfunction()

foreach(stage IN LISTS stages)
  add_suite(${stage})
endforeach()
