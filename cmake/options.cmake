# Language level and floating-point rules, the same for every target. Products are never fused into
# sums behind our back: bit-identical results across builds of one compiler depend on it.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

# Who builds the project mostly runs it on the same machine. Presets "portable" and "x86-64-v3" are for packages.
set(processor_by_default "")
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CROSSCOMPILING)
  set(processor_by_default native)
endif()
set(VITREL_PROCESSOR "${processor_by_default}" CACHE STRING
    "Whose instructions to use, as in -march: native, x86-64-v3 ...; empty: those of all processors of the family")
set(VITREL_SANITIZE "" CACHE STRING "Sanitizers, for example address,undefined,float-cast-overflow")

# These reach the users of an installed library too: functions defined in headers are compiled there
# again and must compute the same. Trajectories have the same bits on every processor, therefore no fused multiply-add:
# neither contracted expressions nor those that Eigen writes out where the processor has it. The alignment of
# Eigen's types is the same everywhere, too.
add_library(vitrel_options INTERFACE)
add_library(vitrel::options ALIAS vitrel_options)
set_target_properties(vitrel_options PROPERTIES EXPORT_NAME options)
target_compile_features(vitrel_options INTERFACE cxx_std_20)
target_compile_options(vitrel_options INTERFACE -ffp-contract=off)
target_compile_definitions(vitrel_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
if(VITREL_PROCESSOR)
  set(VITREL_PROCESSOR_FLAGS -march=${VITREL_PROCESSOR})
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND VITREL_PROCESSOR_FLAGS -mno-fma)
    # With AVX-512, GCC 12.2 vectorises initialisers wrongly at -O3: of a struct of four doubles it stores the third
    # one twice (found by the test Verdict.DegenerateContactCountsByItsGap).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      list(APPEND VITREL_PROCESSOR_FLAGS -mno-avx512f)
      # GCC 14 keeps AVX-512 where the processor has AVX10, and warns, unless AVX10 is named, too.
      if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 14 AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15)
        list(APPEND VITREL_PROCESSOR_FLAGS -mno-avx10.1-512)
      endif()
    endif()
  endif()
  target_compile_options(vitrel_options INTERFACE ${VITREL_PROCESSOR_FLAGS})
endif()
if(VITREL_SANITIZE)
  target_compile_options(vitrel_options INTERFACE -fsanitize=${VITREL_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(vitrel_options INTERFACE -fsanitize=${VITREL_SANITIZE})
endif()

function(vitrel_private_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # No garbage collection in the compiler below 500 MB, which few sources need: 6 % faster.
    target_compile_options(${target} PRIVATE "SHELL:--param ggc-min-heapsize=500000")
    # How GCC before 4.6 passed SIMD types is of no interest; without AVX it would tell.
    target_compile_options(${target} PRIVATE -Wno-psabi)
  endif()
endfunction()
