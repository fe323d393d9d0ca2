# Options of every translation unit. `-ffp-contract=off` and no fast-math: the
# same source gives the same picture with every compiler. The code reads neither
# errno nor the flags of floating-point exceptions, so comparisons may be
# compiled without a branch; the numbers are the same.
if(MSVC)
  target_compile_options(lightwalk INTERFACE /W4 /permissive- /utf-8 /fp:precise)
else()
  target_compile_options(
    lightwalk INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                        -ffp-contract=off -fno-math-errno -fno-trapping-math)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # No notes on the ABI of eight lanes: they never leave a program.
    target_compile_options(lightwalk INTERFACE -Wno-psabi)
    # Rows of eight are explicit in the code. Beyond them GCC would vectorize
    # the components of vectors, and shuffle them back and forth.
    target_compile_options(lightwalk INTERFACE -fno-tree-slp-vectorize)
  endif()
  if(LIGHTWALK_WARNINGS_AS_ERRORS)
    target_compile_options(lightwalk INTERFACE -Werror)
  endif()
endif()

if(LIGHTWALK_SANITIZE)
  add_compile_options(-fsanitize=${LIGHTWALK_SANITIZE}
                      -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LIGHTWALK_SANITIZE})
  if(NOT APPLE)
    # The sanitizer opens libraries for the program, and then the loader reads
    # only an RPATH of the old kind.
    add_link_options(-Wl,--disable-new-dtags)
  endif()
endif()

# Programs find the image library in their own folder.
if(APPLE)
  set(program_folder "@loader_path")
else()
  set(program_folder "$ORIGIN")
endif()
