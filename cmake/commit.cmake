# Writes OUTPUT, a header with the commit of SOURCE, and leaves it alone if nothing changed:
# cmake -DSOURCE=… -DOUTPUT=… -P commit.cmake
cmake_minimum_required(VERSION 3.25)

# The header of a source distribution. Without PKG-INFO these are sources that one was made from.
set(recorded ${SOURCE}/cmake/vitrel_commit.h)
if(EXISTS ${SOURCE}/PKG-INFO AND EXISTS ${recorded})
  configure_file(${recorded} ${OUTPUT} COPYONLY)
  return()
endif()

find_package(Git QUIET)
set(commit "unknown")

macro(git output)
  execute_process(COMMAND ${GIT_EXECUTABLE} --no-optional-locks -C ${SOURCE} ${ARGN}
                  RESULT_VARIABLE failed OUTPUT_VARIABLE ${output} ERROR_QUIET
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
endmacro()

if(GIT_FOUND)
  git(top rev-parse --show-toplevel)
  file(REAL_PATH "${SOURCE}" source)
  # A copy of the sources inside somebody else's repository must not report that one's commit.
  if(NOT failed AND top STREQUAL source)
    git(head rev-parse HEAD)
    if(NOT failed)
      set(commit ${head})
      git(ignored diff --quiet HEAD)
      if(failed)
        string(APPEND commit "-modified")
      endif()
    endif()
  endif()
endif()

file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define VITREL_COMMIT \"@commit@\"\n" @ONLY)
