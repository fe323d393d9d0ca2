# Programs for 64-bit Windows, made on Linux: a toolchain file for CMake, with
# Debian's g++-mingw-w64-x86-64-posix.
#
#   cmake -S . -B build-windows -DCMAKE_TOOLCHAIN_FILE=cmake/mingw-w64.cmake
#
# The libraries are headers, the same as for Linux. A folder of links to just
# these keeps out all other headers of /usr/include.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

set(header_folder ${CMAKE_BINARY_DIR}/headers/include)
file(MAKE_DIRECTORY ${header_folder})
foreach(header glm CLI toml++ nlohmann doctest hwy stb)
  if(EXISTS /usr/include/${header} AND NOT EXISTS ${header_folder}/${header})
    file(CREATE_LINK /usr/include/${header} ${header_folder}/${header} SYMBOLIC)
  endif()
endforeach()
# For CMake's find_path, and for what it knows as packages of headers.
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${CMAKE_BINARY_DIR}/headers)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(LIGHTWALK_HEADER_FOLDER ${header_folder})

# Nothing to be installed beside the programs.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-static")
