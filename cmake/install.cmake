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
