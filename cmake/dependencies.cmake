# Everything vitrel builds on; all of it is packaged in Debian 12.
include(cmake/vitrel-requirements.cmake)
vitrel_require(Boost 1.74 2 CONFIG)
vitrel_require(CLI11 2.1 3)
# FindPNG does not set PNG_VERSION.
find_package(PNG 1.6 REQUIRED)
# UDUNITS-2 has no CMake package.
find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
find_path(UDUNITS2_INCLUDE_DIR udunits2.h REQUIRED)
# Debian's FFTW has no usable CMake package; it is linked by its name.
find_library(FFTW_LIBRARY fftw3 REQUIRED)
find_path(FFTW_INCLUDE_DIR fftw3.h REQUIRED)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
find_library(TOMLPLUSPLUS_LIBRARY tomlplusplus REQUIRED)
if(VITREL_BUILD_BENCH)
  vitrel_require(NLopt 2.7 3)
endif()
if(VITREL_BUILD_PYTHON)
  find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
  vitrel_require(pybind11 2.10 4)
endif()
if(vitrel_missing)
  list(JOIN vitrel_missing "\n" vitrel_missing)
  message(FATAL_ERROR "vitrel cannot be built:\n${vitrel_missing}")
endif()
# Debian has a folder of its own for HDF5, with nothing but links to the system's, which every program finds.
get_target_property(hdf5_library hdf5::hdf5 IMPORTED_LOCATION)
if(hdf5_library)
  file(REAL_PATH ${hdf5_library} hdf5_library)
  set_target_properties(hdf5::hdf5 PROPERTIES IMPORTED_LOCATION ${hdf5_library})
endif()

# The shared library loads what it needs to read from web servers, which is two thirds of what a program does before it
# starts. Executables with the property VITREL_STATIC_HDF5 have the static one, where it needs no more than this.
add_library(vitrel_hdf5 INTERFACE)
string(REGEX REPLACE "\\.so.*" ".a" hdf5_archive "${hdf5_library}")
set(hdf5_archive ${hdf5_archive} sz z ${CMAKE_DL_LIBS} m)
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIRS})
set(CMAKE_REQUIRED_LIBRARIES ${hdf5_archive})
check_cxx_source_compiles(
  "#include <hdf5.h>\nint main() { return H5Dclose(H5Dopen2(0, \"x\", 0)) + H5Pset_driver(0, H5FDregister(nullptr), nullptr); }"
  VITREL_HDF5_ARCHIVE_LINKS)
unset(CMAKE_REQUIRED_INCLUDES)
unset(CMAKE_REQUIRED_LIBRARIES)
if(VITREL_HDF5_ARCHIVE_LINKS)
  target_link_libraries(vitrel_hdf5 INTERFACE
    "$<IF:$<BOOL:$<TARGET_PROPERTY:VITREL_STATIC_HDF5>>,${hdf5_archive},hdf5::hdf5>")
else()
  target_link_libraries(vitrel_hdf5 INTERFACE hdf5::hdf5)
endif()
