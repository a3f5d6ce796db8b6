# vitrel_library(<name> SOURCES … HEADERS … LINK … [PRIVATE_LINK …]): one static library per folder of
# the architecture with its headers, each of which must compile alone. Includes read "core/…", from the
# project's root.
function(vitrel_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  set(target vitrel_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(vitrel::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(${target} PUBLIC vitrel::options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON)
  vitrel_private_options(${target})
endfunction()
