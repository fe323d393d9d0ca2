# The compiled files of the core: a module, loaded by the first image that
# needs it, for linking OpenImageIO would cost every program a second at its
# start. `image_module` stands for the one that programs load; both are built
# where both libraries are there, to compare them.
add_custom_target(image_module)
set(image_module_file "")

# add_image_module(NAME LIBRARY SOURCES...)
function(add_image_module name library)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE lightwalk ${library})
  set_target_properties(${name} PROPERTIES CXX_VISIBILITY_PRESET hidden)
endfunction()

if(TARGET small_image_libraries)
  file(GLOB small CONFIGURE_DEPENDS common/image/small_*.cpp)
  add_image_module(lightwalk_small_images small_image_libraries ${small})
  set_source_files_properties(common/image/small_libraries.cpp
                              PROPERTIES COMPILE_OPTIONS
                                         "$<IF:$<BOOL:${MSVC}>,/w,-w>")
  set(image_module lightwalk_small_images)
  set(image_library "tinyexr and stb")
endif()
if(TARGET OpenImageIO::OpenImageIO)
  file(GLOB large CONFIGURE_DEPENDS common/image/openimageio*.cpp)
  add_image_module(lightwalk_openimageio OpenImageIO::OpenImageIO ${large})
  set(image_module lightwalk_openimageio)
  set(image_library "OpenImageIO")
endif()
if(image_module)
  add_dependencies(image_module ${image_module})
  set(image_module_file "$<TARGET_FILE_NAME:${image_module}>")
  message(STATUS "Images: EXR, PNG and JPEG by ${image_library}")
else()
  message(STATUS "Images: PFM and PPM alone; EXR, PNG and JPEG need "
                 "OpenImageIO, or tinyexr, stb and zlib")
endif()
