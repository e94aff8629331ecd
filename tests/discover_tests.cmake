# Tells ctest the tests of one program when ctest starts: those of a suite, six to a process. A process of each test
# spent 0.3 to 0.6 s of processor time on its libraries, which was a third of all. Needs `name`, `program` and `folder`.
set(tests_of_a_process 6)
set(list ${folder}/${name}.tests)

if(NOT EXISTS ${program})
  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)
  return()
endif()
if(NOT EXISTS ${list} OR ${program} IS_NEWER_THAN ${list})
  # Values of parameters stand behind a "#".
  execute_process(COMMAND ${program} --gtest_list_tests COMMAND sed "s/  *#.*//" OUTPUT_FILE ${list}
    WORKING_DIRECTORY ${folder} RESULTS_VARIABLE results TIMEOUT 300)
  if(NOT results STREQUAL "0;0")
    file(REMOVE ${list})
    add_test(${name}_LISTS_ITS_TESTS ${program} --gtest_list_tests)
    return()
  endif()
endif()

# The time limit bounds a hang and is no time to keep: on two cores with ten other busy processes a test takes ten times
# its processor time.
set(suite "")
set(filter "")
set(number 1)
set(count 0)
file(STRINGS ${list} lines REGEX "^(  )?[A-Za-z0-9_/]+\\.?$")
foreach(line IN LISTS lines ITEMS "end.")
  if(line MATCHES "^  ")
    string(STRIP ${line} line)
    string(APPEND filter "${suite}.${line}:")
    math(EXPR count "${count} + 1")
  endif()
  if(NOT filter STREQUAL "" AND (count EQUAL tests_of_a_process OR line MATCHES "\\.$"))
    add_test(${suite}.${number} ${runner} ${program} --gtest_filter=${filter})
    set_tests_properties(${suite}.${number} PROPERTIES
      WORKING_DIRECTORY ${folder} TIMEOUT 1800 SKIP_RETURN_CODE 77)
    math(EXPR number "${number} + 1")
    set(filter "")
    set(count 0)
  endif()
  if(line MATCHES "\\.$")
    string(REGEX REPLACE "\\.$" "" suite ${line})
    set(number 1)
  endif()
endforeach()
