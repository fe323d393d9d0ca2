# cmake -DPROGRAMS="a;b" -P same_hits.cmake runs all and compares what they
# print.
foreach(program IN LISTS PROGRAMS)
  execute_process(COMMAND ${program} OUTPUT_VARIABLE hits
                  RESULT_VARIABLE failed)
  if(failed STREQUAL "Illegal instruction")
    message("${program}: this processor cannot run it")
  elseif(failed)
    message(FATAL_ERROR "${program}: ${failed}")
  elseif(NOT DEFINED first)
    set(first "${hits}")
  elseif(NOT hits STREQUAL first)
    message(FATAL_ERROR "${program} prints\n${hits}and not\n${first}")
  endif()
endforeach()
