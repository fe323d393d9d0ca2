# Programs are compiled for the registers of the processor that builds them, or
# for any x86-64 with -DLIGHTWALK_NATIVE=OFF. Their pictures have the same bits.
# Windows aligns a stack to 16 bytes only: Debian's GCC for it knows (GCC bug
# 54412).
set(avx2_options -march=x86-64-v3 -maes -mpclmul)
set(avx512_options -march=x86-64-v4 -mprefer-vector-width=512 -maes -mpclmul)

# What this machine's processor can do, the widest last.
set(instruction_sets)
if(CMAKE_HOST_SYSTEM_NAME STREQUAL "Linux" AND NOT MSVC
   AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
  file(STRINGS /proc/cpuinfo flags REGEX "^flags" LIMIT_COUNT 1)
  if(flags MATCHES " fma .* aes .* avx2 .*bmi2 ")
    list(APPEND instruction_sets avx2)
    if(flags MATCHES " avx512dq .*avx512cd .*avx512bw avx512vl ")
      list(APPEND instruction_sets avx512)
    endif()
  endif()
endif()

if(CMAKE_CROSSCOMPILING)
  set(native_by_default OFF)
else()
  set(native_by_default ON)
endif()
option(LIGHTWALK_NATIVE "Compile for the registers of this machine's processor"
       ${native_by_default})
set(processor_check)
if(LIGHTWALK_NATIVE AND instruction_sets)
  list(GET instruction_sets -1 instruction_set)
  target_compile_options(lightwalk INTERFACE ${${instruction_set}_options})
  # GCC takes minutes to check the scopes of rows.
  if(LIGHTWALK_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(lightwalk
                           INTERFACE -fno-sanitize-address-use-after-scope)
  endif()
  # The first thing that runs, compiled for any x86-64: see the file.
  if(NOT WIN32)
    add_library(processor_check OBJECT cmake/processor_check.cpp)
    target_compile_definitions(processor_check PRIVATE NEEDS_${instruction_set})
    set(processor_check $<TARGET_OBJECTS:processor_check>)
  endif()
endif()
