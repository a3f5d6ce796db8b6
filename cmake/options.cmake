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

# Programs name the folders of their libraries as after the installation. CMake would otherwise keep room for other
# names by empty ones, which the dynamic linker takes for the current folder.
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
if(NOT DEFINED CMAKE_INSTALL_RPATH_USE_LINK_PATH)
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
endif()

set(VITREL_PROCESSOR "" CACHE STRING
    "Whose instructions to use, as in -march: native, x86-64-v3 ...; empty: those of all processors of the family")
option(VITREL_HARDENED "Debian's protections against attacks through damaged files, for packages" OFF)
option(VITREL_PORTABLE_EXTENDED "Use the sum of two doubles in the exact check where long double has 64 bits, too" OFF)
option(VITREL_UNITY_BUILD "Compile sources that never take long four at a time, which takes less time" OFF)
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
# Square roots are exact with or without errno; without it they are one instruction, and loops of them are vectorised.
target_compile_options(vitrel_options INTERFACE -fno-math-errno)
target_compile_definitions(vitrel_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_STATIC_ALIGN_BYTES=16
                           $<$<BOOL:${VITREL_PORTABLE_EXTENDED}>:VITREL_PORTABLE_EXTENDED>)
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
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With sanitizers GCC warns where nothing is uninitialised, as its manual says.
    target_compile_options(vitrel_options INTERFACE -Wno-maybe-uninitialized)
  endif()
  target_link_options(vitrel_options INTERFACE -fsanitize=${VITREL_SANITIZE})
endif()

# What dpkg-buildflags of Debian 13 asks for with hardening=+all; results do not depend on it.
if(VITREL_HARDENED)
  include(CheckPIESupported)
  check_pie_supported(LANGUAGES CXX)
  set(hardening -fstack-protector-strong -fstack-clash-protection)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND hardening -fcf-protection)
  elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    list(APPEND hardening -mbranch-protection=standard)
  endif()
  # The C library checks sizes only in optimised code. Some compilers define a level of their own.
  set(optimised $<CONFIG:Release,RelWithDebInfo,MinSizeRel>)
  set(VITREL_HARDENING ${hardening} "$<${optimised}:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=3>")
  set(VITREL_LINK_HARDENING LINKER:-z,relro LINKER:-z,now)
endif()

function(vitrel_private_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow ${VITREL_HARDENING})
  target_link_options(${target} PRIVATE ${VITREL_LINK_HARDENING})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # No garbage collection in the compiler below 500 MB, which few sources need: 6 % faster.
    target_compile_options(${target} PRIVATE "SHELL:--param ggc-min-heapsize=500000")
    # How GCC before 4.6 passed SIMD types is of no interest; without AVX it would tell.
    target_compile_options(${target} PRIVATE -Wno-psabi)
  endif()
endfunction()
