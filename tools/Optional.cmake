# Optional parts of the book and of the tests on other systems. Included by
# cmake/Optional.cmake, which explains the commands.

# The box that renders in the book's page: Clang with WASI's libraries.
find_command(clang_command clang++)
if(DEFINED ENV{WASM_CXX})
  set(wasm_command $ENV{WASM_CXX})
else()
  set(wasm_command ${clang_command})
endif()
watch(/usr/bin/wasm-ld* /usr/include/wasm32-wasi/stdio.h
      /usr/include/wasm32-wasi/c++/v1/vector)
if(wasm_command)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/probe/wasm.cpp
       CONTENT "#include <vector>\nint main() { return std::vector<int>(1)[0]; }\n")
  execute_process(
    COMMAND ${wasm_command} --target=wasm32-wasi -fno-exceptions
            ${CMAKE_BINARY_DIR}/probe/wasm.cpp -o ${CMAKE_BINARY_DIR}/probe/wasm
    RESULT_VARIABLE wasm_failed OUTPUT_QUIET ERROR_QUIET)
endif()
if(NOT wasm_command OR wasm_failed)
  leave_out(book "the box that paints itself"
            "Clang for WebAssembly is missing" site)
endif()

# Programs for Windows, and wine to run them.
find_command(mingw_command x86_64-w64-mingw32-g++-posix)
find_command(wine_command wine64 wine)
find_program(wine_command NAMES wine64 PATHS /usr/lib/wine NO_DEFAULT_PATH)
if(NOT mingw_command OR NOT wine_command)
  leave_out(test-windows "everything" "mingw-w64 or wine is missing" windows)
endif()
