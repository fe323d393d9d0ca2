# The libraries that are headers only. A tree that students get has them in
# third_party/; elsewhere they are installed.
set(third_party ${CMAKE_SOURCE_DIR}/third_party/include)
if(IS_DIRECTORY ${third_party})
  foreach(library glm::glm CLI11::CLI11 tomlplusplus::tomlplusplus
                  nlohmann_json::nlohmann_json doctest::doctest)
    add_library(${library} INTERFACE IMPORTED)
    target_include_directories(${library} SYSTEM INTERFACE ${third_party})
  endforeach()
  target_compile_definitions(tomlplusplus::tomlplusplus
                             INTERFACE TOML_HEADER_ONLY=1)
else()
  foreach(library glm CLI11 tomlplusplus nlohmann_json)
    find_package(${library} CONFIG REQUIRED)
  endforeach()
  if(LIGHTWALK_TESTS)
    find_package(doctest CONFIG REQUIRED)
  endif()
endif()
