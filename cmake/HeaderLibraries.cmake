# The header-only libraries: as CMake packages, or, if a toolchain file names a
# folder of headers, from there. A student's tree brings such a folder.
if(NOT LIGHTWALK_HEADER_FOLDER
   AND IS_DIRECTORY ${CMAKE_SOURCE_DIR}/third_party/include)
  set(LIGHTWALK_HEADER_FOLDER ${CMAKE_SOURCE_DIR}/third_party/include)
endif()
if(LIGHTWALK_HEADER_FOLDER)
  foreach(library glm::glm CLI11::CLI11 tomlplusplus::tomlplusplus
                  nlohmann_json::nlohmann_json doctest::doctest)
    add_library(${library} INTERFACE IMPORTED GLOBAL)
    set_target_properties(
      ${library} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES
                            ${LIGHTWALK_HEADER_FOLDER})
  endforeach()
else()
  find_package(glm CONFIG REQUIRED)
  find_package(CLI11 CONFIG REQUIRED)
  find_package(tomlplusplus CONFIG REQUIRED)
  find_package(nlohmann_json CONFIG REQUIRED)
  if(LIGHTWALK_TESTS)
    find_package(doctest CONFIG REQUIRED)
  endif()
endif()
