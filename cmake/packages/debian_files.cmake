# CPack runs this when everything is installed and nothing is packed yet: what Debian wants in every package.
cmake_minimum_required(VERSION 3.25)
set(pages ${CPACK_VITREL_SOURCE}/cmake/packages)

# The changelog of the packages refers to that of vitrel and has the date of its release.
set(version ${CPACK_PACKAGE_VERSION})
file(STRINGS ${CPACK_VITREL_SOURCE}/CHANGELOG.md heading ENCODING UTF-8 REGEX "^## \\[${version}\\]")
if(NOT heading MATCHES "[0-9]+-[0-9]+-[0-9]+")
  message(FATAL_ERROR "CHANGELOG.md has no section \"## [${version}] – <date>\"")
endif()
execute_process(COMMAND date --utc --rfc-email --date ${CMAKE_MATCH_0} OUTPUT_VARIABLE date
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)

function(compress file)
  execute_process(COMMAND gzip --best --no-name --force ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} name)
  set(package ${CPACK_DEBIAN_${name}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
  set(documents ${root}/usr/share/doc/${package})
  file(COPY ${pages}/copyright DESTINATION ${documents})
  configure_file(${pages}/changelog.in ${documents}/changelog.Debian @ONLY)
  compress(${documents}/changelog.Debian)
  configure_file(${CPACK_VITREL_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  compress(${documents}/changelog)
  file(GLOB manuals ${root}/usr/share/man/man1/*.1)
  foreach(manual ${manuals})
    compress(${manual})
  endforeach()
  # Neither the umask nor the modes of the sources count.
  execute_process(COMMAND chmod --recursive u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)
  # Packages of the same commit are the same.
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    execute_process(COMMAND find ${root} -exec touch --no-dereference --date @$ENV{SOURCE_DATE_EPOCH} {} +
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
