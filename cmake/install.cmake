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
        DESTINATION ${package_folder} COMPONENT development)

# The manual page and the completions for shells, which the program itself prints. Builds for certain processors are
# installed beside a portable one, which every machine can run; programs for other machines cannot run here.
if(NOT CMAKE_CROSSCOMPILING AND VITREL_PROCESSOR MATCHES "^(native)?$")
  function(vitrel_install_text file destination)
    set(path ${PROJECT_BINARY_DIR}/texts/${file})
    list(JOIN ARGN "\" \"" arguments)
    install(CODE "
      file(MAKE_DIRECTORY \"${PROJECT_BINARY_DIR}/texts\")
      execute_process(COMMAND \"$<TARGET_FILE:vitrel>\" \"${arguments}\" OUTPUT_FILE \"${path}\"
                      COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
    install(FILES ${path} DESTINATION ${destination} COMPONENT program)
  endfunction()
  vitrel_install_text(vitrel.1 ${CMAKE_INSTALL_MANDIR}/man1 man)
  vitrel_install_text(vitrel ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
  vitrel_install_text(_vitrel ${CMAKE_INSTALL_DATADIR}/zsh/site-functions completion zsh)
endif()
