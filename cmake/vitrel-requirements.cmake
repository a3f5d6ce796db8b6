# What the libraries need, for the build of vitrel and, installed beside vitrel-config.cmake, for projects that use it.

# vitrel_require(<package> <first> <next> [<arguments of find_package>…]): finds a package of at least the version
# <first>. <next> is the major version after the newest that was tried: from it on, a warning says so. The version files
# of the packages are not asked, since some refuse whatever has another major version. Packages that cannot be used are
# described in vitrel_missing.
macro(vitrel_require package first next)
  find_package(${package} QUIET ${ARGN})
  if(NOT ${package}_FOUND)
    list(APPEND vitrel_missing "${package}, version ${first} or later, is not found")
  elseif(${package}_VERSION VERSION_LESS "${first}")
    list(APPEND vitrel_missing "${package} is of version ${${package}_VERSION}; it must be ${first} or later")
  elseif(NOT ${package}_VERSION VERSION_LESS "${next}")
    message(WARNING "vitrel was never tried with ${package} ${${package}_VERSION}, only with versions below ${next}")
  else()
    message(STATUS "Found ${package} ${${package}_VERSION}")
  endif()
endmacro()

set(vitrel_missing "")
vitrel_require(Eigen3 3.4 6)
vitrel_require(fmt 9 12)
vitrel_require(GSL 2.7 3)
# FindHDF5, which defines hdf5::hdf5, asks a C compiler.
enable_language(C)
vitrel_require(HDF5 1.10 3 MODULE COMPONENTS C)
vitrel_require(nlohmann_json 3.11 4)
vitrel_require(TBB 2021 2024)
