# Builds for packages: programs and the Python module are thin, and what they run is a shared library in a private
# folder, of which builds for several processors may be installed together. The dynamic linker takes the best one that
# the processor can run. A wheel has one build only, whose program and module need no library of vitrel.
set(VITREL_PRIVATE_LIBRARIES ON)
if(VITREL_PROCESSOR STREQUAL "native" OR SKBUILD)
  set(VITREL_PRIVATE_LIBRARIES OFF)
endif()
set(VITREL_PRIVATE_FOLDER ${CMAKE_INSTALL_LIBDIR}/vitrel)
# A build for certain processors adds its libraries to a portable one, which every machine can run.
set(VITREL_BESIDE_PORTABLE OFF)
if(VITREL_PRIVATE_LIBRARIES AND VITREL_PROCESSOR)
  set(VITREL_BESIDE_PORTABLE ON)
endif()

# Installs a shared library for the processors of this build where the dynamic linker, which looks in this folder, finds
# it.
function(vitrel_install_for_processor target component folder)
  if(VITREL_BESIDE_PORTABLE)
    string(APPEND folder /glibc-hwcaps/${VITREL_PROCESSOR})
  endif()
  install(TARGETS ${target} LIBRARY DESTINATION ${folder} COMPONENT ${component})
endfunction()

# Lets a program that is installed in this folder find its private library, wherever the prefix is. As the path is
# relative, the library lies at the same place in the build folder.
function(vitrel_find_private_library target folder library)
  file(RELATIVE_PATH path /${folder} /${VITREL_PRIVATE_FOLDER})
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN/${path}")
  cmake_path(ABSOLUTE_PATH path BASE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR} NORMALIZE)
  set_target_properties(${library} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${path})
endfunction()
