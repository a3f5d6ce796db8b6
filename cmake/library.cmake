# vitrel_cold(<source>…): compiles these with -O1 where others get more. For sources of the same folder that
# read or write text and never take long: they compile faster, and compute the same (options.cmake).
function(vitrel_cold)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release,RelWithDebInfo>:-O1>")
endfunction()

# What many sources include, parsed once: the first target compiles it, all others reuse it. They must agree in
# options and definitions, so every target links fmt. Headers still include what they need
# (scripts/check_headers).
set(VITREL_PRECOMPILED
    <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <iostream> <limits> <map>
    <memory> <numeric> <optional> <random> <set> <span> <sstream> <string> <unordered_map> <variant> <vector>
    <Eigen/Geometry> <fmt/core.h> "${PROJECT_SOURCE_DIR}/core/state/configuration.h")
function(vitrel_precompile target)
  target_link_libraries(${target} PRIVATE fmt::fmt)
  if(target STREQUAL vitrel_core)
    target_precompile_headers(${target} PRIVATE ${VITREL_PRECOMPILED})
  else()
    target_precompile_headers(${target} REUSE_FROM vitrel_core)
  endif()
endfunction()

# vitrel_library(<name> SOURCES … [COLD …] HEADERS … LINK … [PRIVATE_LINK …]): one static library per folder
# of the architecture with its headers, each of which must compile alone (scripts/check_headers). COLD are
# further sources (vitrel_cold). Includes read "core/…", from the project's root.
function(vitrel_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;COLD;HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  set(target vitrel_${name})
  if(ARG_COLD)
    vitrel_cold(${ARG_COLD})
  endif()
  add_library(${target} STATIC ${ARG_SOURCES} ${ARG_COLD})
  add_library(vitrel::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  target_link_libraries(${target} PUBLIC vitrel::options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  vitrel_private_options(${target})
  vitrel_precompile(${target})
endfunction()
