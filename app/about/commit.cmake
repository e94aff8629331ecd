# Writes the commit of SOURCE as a C string to OUTPUT: from the file `commit` of an archive, else from git.
file(STRINGS ${SOURCE}/app/about/commit commit LIMIT_COUNT 1)
if(commit MATCHES "Format")
  set(commit "")
  find_program(git git)
  if(git AND EXISTS ${SOURCE}/.git)
    execute_process(COMMAND ${git} rev-parse HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "\"${commit}\"\n")
file(TOUCH ${OUTPUT})
