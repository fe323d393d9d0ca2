# A Python that has jsonschema: distributions install it for their own Python,
# which need not be the first on the PATH.
find_program(first_python NAMES python3 python)
foreach(candidate ${first_python} /usr/bin/python3
                  /opt/homebrew/bin/python3)
  if(NOT test_python)
    execute_process(COMMAND ${candidate} -c "import jsonschema, tomllib"
                    RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      set(test_python ${candidate} CACHE FILEPATH "Python for the tests")
    endif()
  endif()
endforeach()
if(NOT test_python)
  message(FATAL_ERROR "The tests need Python 3.11 or newer with the package "
                      "jsonschema; -DLIGHTWALK_TESTS=OFF builds without them.")
endif()
