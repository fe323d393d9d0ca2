# Libraries for images. PNG and JPEG need stb, headers that one of our files
# compiles. EXR and other formats need OpenImageIO, if it is installed: as a
# module that the first such image loads, since linking OpenImageIO would cost
# every program a second at its start.
find_path(STB_FOLDER stb_image_write.h PATH_SUFFIXES stb
          HINTS ${LIGHTWALK_HEADER_FOLDER})
if(NOT STB_FOLDER)
  message(FATAL_ERROR "stb is missing, two headers for PNG and JPEG: "
                      "tools/setup.sh, or https://github.com/nothings/stb")
endif()
add_library(lightwalk_stb STATIC common/image/stb_images.cpp)
target_include_directories(lightwalk_stb PRIVATE ${CMAKE_SOURCE_DIR})
target_include_directories(lightwalk_stb SYSTEM PRIVATE ${STB_FOLDER})
target_link_libraries(lightwalk_stb PRIVATE glm::glm)
if(NOT MSVC) # half the time of the compiler's
  target_compile_options(lightwalk_stb PRIVATE $<$<CONFIG:Release>:-O1>)
endif()
target_link_libraries(lightwalk INTERFACE lightwalk_stb)

add_custom_target(image_module)
set(image_module_file "")
if(TARGET OpenImageIO::OpenImageIO AND EXISTS
                                       ${CMAKE_SOURCE_DIR}/common/image/openimageio.cpp)
  # Debian's package names an OpenCV include folder that only exists when
  # OpenCV's headers are installed, which nothing here needs.
  get_target_property(folders OpenImageIO::OpenImageIO
                      INTERFACE_INCLUDE_DIRECTORIES)
  set(existing)
  foreach(folder IN LISTS folders)
    if(folder MATCHES "^\\$<" OR IS_DIRECTORY "${folder}")
      list(APPEND existing "${folder}")
    endif()
  endforeach()
  set_target_properties(OpenImageIO::OpenImageIO
                        PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}")
  add_library(lightwalk_openimageio MODULE common/image/openimageio.cpp)
  target_link_libraries(lightwalk_openimageio PRIVATE lightwalk
                                                      OpenImageIO::OpenImageIO)
  set_target_properties(lightwalk_openimageio PROPERTIES CXX_VISIBILITY_PRESET
                                                         hidden)
  add_dependencies(image_module lightwalk_openimageio)
  set(image_module_file "$<TARGET_FILE_NAME:lightwalk_openimageio>")
else()
  message(STATUS "Images: PNG, PFM and PPM; EXR needs OpenImageIO")
endif()
target_compile_definitions(
  lightwalk INTERFACE LIGHTWALK_IMAGE_MODULE="${image_module_file}")
