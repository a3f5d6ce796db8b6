# Builds for packages: programs and the Python module are thin, and what they run is a shared library in a private
# folder, of which builds for several processors may be installed together. The dynamic linker takes the best one that
# the processor can run.
set(VITREL_PRIVATE_FOLDER ${CMAKE_INSTALL_LIBDIR}/vitrel)
# A build for certain processors adds its libraries to a portable one, which every machine can run.
set(VITREL_BESIDE_PORTABLE OFF)
if(VITREL_PROCESSOR AND NOT VITREL_PROCESSOR STREQUAL "native")
  set(VITREL_BESIDE_PORTABLE ON)
endif()

# Installs a shared library where the dynamic linker finds it for the processors of this build.
function(vitrel_install_for_processor target component)
  set(folder ${VITREL_PRIVATE_FOLDER})
  if(VITREL_BESIDE_PORTABLE)
    string(APPEND folder /glibc-hwcaps/${VITREL_PROCESSOR})
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION ${folder} COMPONENT ${component})
endfunction()

# Lets what is installed in this folder find the private libraries, wherever the prefix is.
function(vitrel_find_private_libraries target folder)
  file(RELATIVE_PATH path /${folder} /${VITREL_PRIVATE_FOLDER})
  # Relative in the build folder, too: files of a release do not depend on its name, nor on its length.
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${path}" BUILD_RPATH_USE_ORIGIN ON)
endfunction()
