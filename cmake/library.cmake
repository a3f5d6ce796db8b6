# Sources that read or write text and never take long are cold: with -Og, where others get -O3, they compile faster and
# compute the same (options.cmake).
set(VITREL_COLD "$<$<CONFIG:Release,RelWithDebInfo>:-Og>")
# The optimiser needs longer than all else for CLI11 (11 s instead of 5), and there is nothing to gain; but code that is
# not optimised cannot be hardened.
set(VITREL_COMMAND_LINE "$<$<CONFIG:Release,RelWithDebInfo>:$<IF:$<BOOL:${VITREL_HARDENED}>,-Og,-O0>>")

# vitrel_precompiled(<name> [COLD] HEADERS … LINK …): a target that only precompiles headers, for others to reuse.
# These agree in options with it (GCC would take the level of optimisation from it), and may have definitions of their
# own that the headers do not read.
function(vitrel_precompiled name)
  cmake_parse_arguments(ARG "COLD" "" "HEADERS;LINK" ${ARGN})
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// A target needs a source.\n")
  add_library(${name} OBJECT ${source})
  target_link_libraries(${name} PRIVATE vitrel::options Eigen3::Eigen fmt::fmt ${ARG_LINK})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  vitrel_private_options(${name})
  target_compile_options(${name} PRIVATE $<$<BOOL:${ARG_COLD}>:${VITREL_COLD}>)
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# CMake 4 warns about headers to be reused that are not precompiled.
function(vitrel_reuse_precompiled target from)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()

# What many sources include. Headers still include what they need (scripts/check_headers). JSON is not among
# them: every source would pay for its functions.
set(VITREL_PRECOMPILED
    <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
    <memory> <numeric> <optional> <set> <span> <sstream> <string> <variant> <vector>
    <Eigen/Geometry> <fmt/format.h> "${PROJECT_SOURCE_DIR}/core/state/configuration.h")
vitrel_precompiled(vitrel_precompiled HEADERS ${VITREL_PRECOMPILED})
vitrel_precompiled(vitrel_cold_precompiled COLD HEADERS ${VITREL_PRECOMPILED})

# vitrel_library(<name> SOURCES … [COLD …] [PRIVATE_HEADERS …] LINK … [PRIVATE_LINK …]): one static library per folder
# of the architecture with all headers of the folder, each of which must compile alone (scripts/check_headers). COLD are
# further sources. PRIVATE_HEADERS are not installed: they include what users of the library need not have. Includes
# read "core/…", from the project's root.
function(vitrel_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;COLD;PRIVATE_HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  file(GLOB_RECURSE headers RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS *.h)
  list(REMOVE_ITEM headers ${ARG_PRIVATE_HEADERS})
  set(target vitrel_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(vitrel::${name} ALIAS ${target})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  target_link_libraries(${target} PUBLIC vitrel::options ${ARG_LINK} PRIVATE ${ARG_PRIVATE_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  vitrel_private_options(${target})
  target_link_libraries(${target} PRIVATE fmt::fmt)
  vitrel_reuse_precompiled(${target} vitrel_precompiled)
  if(ARG_COLD)
    add_library(${target}_cold OBJECT ${ARG_COLD})
    target_link_libraries(${target}_cold PRIVATE vitrel::options ${ARG_LINK} ${ARG_PRIVATE_LINK} fmt::fmt)
    target_include_directories(${target}_cold PRIVATE ${PROJECT_SOURCE_DIR})
    vitrel_private_options(${target}_cold)
    target_compile_options(${target}_cold PRIVATE ${VITREL_COLD})
    vitrel_reuse_precompiled(${target}_cold vitrel_cold_precompiled)
    set_target_properties(${target}_cold PROPERTIES UNITY_BUILD ${VITREL_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 4)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_cold>)
  endif()
endfunction()
