# `cmake --install` puts the libraries, their headers and a package configuration in place, so that
# another project writes find_package(vitrel CONFIG) and links vitrel::core, vitrel::mc, vitrel::edmd
# or vitrel::analysis. Headers keep their folders: <prefix>/include/vitrel/core/….
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/vitrel)
foreach(library core mc edmd analysis)
  install(TARGETS vitrel_${library} EXPORT vitrel_targets
          ARCHIVE COMPONENT development
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vitrel COMPONENT development)
endforeach()
install(TARGETS vitrel_options EXPORT vitrel_targets)
install(EXPORT vitrel_targets NAMESPACE vitrel:: DESTINATION ${package_folder}
        COMPONENT development)

configure_package_config_file(cmake/vitrel-config.cmake.in vitrel-config.cmake
                              INSTALL_DESTINATION ${package_folder}
                              NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(vitrel-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vitrel-config.cmake
              ${PROJECT_BINARY_DIR}/vitrel-config-version.cmake
              cmake/vitrel-requirements.cmake
        DESTINATION ${package_folder} COMPONENT development)

# The manual pages and the completions for shells, which the programs themselves print. Builds for certain processors are
# installed beside a portable one, which every machine can run; programs for other machines cannot run here.
if(NOT CMAKE_CROSSCOMPILING AND NOT VITREL_BESIDE_PORTABLE)
  # vitrel_install_text(<program> <component> <file> <destination> <words>…)
  function(vitrel_install_text program component file destination)
    set(path ${PROJECT_BINARY_DIR}/texts/${file})
    list(JOIN ARGN "\" \"" arguments)
    install(CODE "
      file(MAKE_DIRECTORY \"${PROJECT_BINARY_DIR}/texts\")
      execute_process(COMMAND \"$<TARGET_FILE:${program}>\" \"${arguments}\" OUTPUT_FILE \"${path}\"
                      COMMAND_ERROR_IS_FATAL ANY)" COMPONENT ${component})
    install(FILES ${path} DESTINATION ${destination} COMPONENT ${component})
  endfunction()
  set(manual_folder ${CMAKE_INSTALL_MANDIR}/man1)
  vitrel_install_text(vitrel program vitrel.1 ${manual_folder} man)
  vitrel_install_text(vitrel program vitrel ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
  # Debian keeps the folder of functions for those of the machine.
  set(zsh_folder zsh/site-functions)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(zsh_folder zsh/vendor-completions)
  endif()
  vitrel_install_text(vitrel program _vitrel ${CMAKE_INSTALL_DATADIR}/${zsh_folder} completion zsh)
  if(VITREL_BUILD_BENCH)
    vitrel_install_text(vitrel-bench bench vitrel-bench.1 ${manual_folder} man)
  endif()
endif()

# The parameter files, to run and to start from.
if(NOT VITREL_BESIDE_PORTABLE)
  install(DIRECTORY params/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT program)
endif()
