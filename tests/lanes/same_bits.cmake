# cmake -DPROGRAMS="a;b" -P same_bits.cmake runs all and compares what they
# print.
foreach(program IN LISTS PROGRAMS)
  execute_process(COMMAND ${program} OUTPUT_VARIABLE bits RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${program}: ${failed}")
  elseif(NOT DEFINED first)
    set(first "${bits}")
  elseif(NOT bits STREQUAL first)
    message(FATAL_ERROR "${program} prints\n${bits}and not\n${first}")
  endif()
endforeach()
