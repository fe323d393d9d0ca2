# Finds OpenImageIO. Debian's package names an OpenCV include folder that only
# exists when OpenCV's headers are installed, which nothing here needs.
find_package(OpenImageIO CONFIG REQUIRED)
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
