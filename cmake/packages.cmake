# Debian packages: `cpack -G DEB` in a folder with a portable build. scripts/release builds everything and calls it.
set(VITREL_SECOND_BUILD "" CACHE PATH
    "A build for certain processors (preset x86-64-v3), whose libraries go into the same packages; empty: none")
set(VITREL_PACKAGER "The vitrel authors <vitrel@example.org>" CACHE STRING "Who publishes the packages: name and address")

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_NAME vitrel)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SOURCE vitrel)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${VITREL_PACKAGER}")
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_COMPONENTS_ALL program development)
set(CPACK_COMPONENTS_SECOND program)
if(VITREL_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND CPACK_COMPONENTS_SECOND python)
endif()
if(VITREL_BUILD_BENCH)
  list(APPEND CPACK_COMPONENTS_ALL bench)
endif()
# CPack reads ALL and SECOND as the ends of the names above.
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};vitrel;ALL;/")
if(VITREL_SECOND_BUILD)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${VITREL_SECOND_BUILD};vitrel;SECOND;/")
endif()

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME vitrel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, python3-vitrel, vitrel-bench")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "simulation of hard anisotropic particles
vitrel simulates ellipses, disks, ellipsoids and spheres, from the liquid to
the glass. It prepares dense states by Monte Carlo, runs them with
event-driven dynamics, sweeps the density through the glass transition, and
analyses the saved runs.

This package contains the program, with a build for all processors of the
architecture and a faster one for newer processors, and example parameter
files.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvitrel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
# What vitrel-config.cmake finds, and what the static libraries link.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libfftw3-dev, libfmt-dev, libgsl-dev, libhdf5-dev, libtbb-dev, libtomlplusplus-dev, \
libudunits2-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS cmake)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "simulation of hard anisotropic particles - C++ libraries
vitrel simulates ellipses, disks, ellipsoids and spheres, from the liquid to
the glass.

This package contains its static libraries core, mc, edmd and analysis, their
headers, and the files by which CMake finds them.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-vitrel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(VITREL_BUILD_PYTHON)
  # The compiled module is for one version of the interpreter.
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), \
python3 (<< ${Python3_VERSION_MAJOR}.${next_minor}), python3-numpy")
endif()
# The program works on the jobs of a sweep.
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "vitrel, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS python3-pandas)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/cmake/packages/python/postinst ${PROJECT_SOURCE_DIR}/cmake/packages/python/prerm)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "simulation of hard anisotropic particles - Python package
vitrel simulates ellipses, disks, ellipsoids and spheres, from the liquid to
the glass.

This package is for Python: states, runs and analyses as objects whose data
are NumPy arrays.")

set(CPACK_DEBIAN_BENCH_PACKAGE_NAME vitrel-bench)
set(CPACK_DEBIAN_BENCH_PACKAGE_SECTION science)
set(CPACK_DEBIAN_BENCH_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_BENCH_PACKAGE_ENHANCES vitrel)
set(CPACK_DEBIAN_BENCH_DESCRIPTION "simulation of hard anisotropic particles - benchmarks
vitrel simulates ellipses, disks, ellipsoids and spheres, from the liquid to
the glass.

This package contains vitrel-bench, which measures the numerical methods of
vitrel against reference implementations and other methods. It is compiled
for all processors of the architecture.")

# For cmake/packages/debian_files.cmake.
set(CPACK_VITREL_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/packages/debian_files.cmake)
include(CPack)
