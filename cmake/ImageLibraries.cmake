# What reads and writes EXR, PNG and JPEG: OpenImageIO, or the small libraries
# tinyexr and stb. With neither, programs write PFM and PPM.
if(TARGET OpenImageIO::OpenImageIO)
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
  list(APPEND image_libraries OpenImageIO::OpenImageIO)
endif()

# Headers, which a file of ours compiles; tinyexr wants zlib, or stb's.
if(TINYEXR_FOLDER AND STB_FOLDER)
  add_library(small_image_libraries INTERFACE)
  target_include_directories(small_image_libraries SYSTEM
                             INTERFACE ${TINYEXR_FOLDER} ${STB_FOLDER})
  if(ZLIB_FOUND)
    target_link_libraries(small_image_libraries INTERFACE ZLIB::ZLIB)
  else()
    target_include_directories(
      small_image_libraries SYSTEM BEFORE
      INTERFACE ${CMAKE_SOURCE_DIR}/common/image/stb_zlib)
  endif()
  list(APPEND image_libraries small_image_libraries)
endif()
