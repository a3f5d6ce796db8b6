# What tests need besides the libraries. Tests whose needs are missing are left out, and the configuration names these
# needs; CI refuses to leave out any.
option(VITREL_REQUIRE_ALL_TESTS "Refuse to leave out tests because a program or a Python module is missing" OFF)
set(VITREL_MISSING "")

# Programs are looked for where the environment says; their paths are VITREL_<PROGRAM>.
foreach(program chromium clang-tidy gmsh lmp pdftoppm readelf snakemake)
  string(TOUPPER VITREL_${program} variable)
  find_program(${variable} ${program})
  if(NOT ${variable})
    list(APPEND VITREL_MISSING ${program})
  endif()
endforeach()

# Where scripts/build_manual takes it from.
if(NOT EXISTS /usr/share/javascript/mathjax)
  list(APPEND VITREL_MISSING mathjax)
endif()

find_package(Python3 3.11 QUIET COMPONENTS Interpreter)
set(modules ase furo gsd h5py ipykernel matplotlib MDAnalysis mypy myst_parser nbclient numpy numpydoc pandas pytest
    sphinx sphinx_copybutton tqdm vtk)
if(Python3_Interpreter_FOUND)
  # -P: folders of the build are no modules.
  execute_process(
    COMMAND ${Python3_EXECUTABLE} -P -c "import sys, importlib.util
print(*(name for name in sys.argv[1:] if not importlib.util.find_spec(name)), sep=';')" ${modules}
    OUTPUT_VARIABLE missing_modules OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  list(APPEND VITREL_MISSING ${missing_modules})
else()
  list(APPEND VITREL_MISSING Python ${modules})
endif()

# vitrel_python_test(<name> COMMAND … [NEEDS …] [FIXTURES …] [ENVIRONMENT …] [PATHS …] [TIMEOUT …]): a test by the
# interpreter with these arguments and the folders in front of PATH, unless a need of the lists above is missing.
function(vitrel_python_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "COMMAND;NEEDS;FIXTURES;ENVIRONMENT;PATHS" ${ARGN})
  foreach(need Python ${ARG_NEEDS})
    if(need IN_LIST VITREL_MISSING)
      return()
    endif()
  endforeach()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT ${VITREL_TEST_TIMEOUT})
  endif()
  list(TRANSFORM ARG_PATHS PREPEND PATH=path_list_prepend:)
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${ARG_COMMAND})
  set_tests_properties(${name} PROPERTIES
    TIMEOUT ${ARG_TIMEOUT} FIXTURES_REQUIRED "${ARG_FIXTURES}"
    ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;${ARG_ENVIRONMENT}" ENVIRONMENT_MODIFICATION "${ARG_PATHS}")
endfunction()

if(VITREL_MISSING)
  list(JOIN VITREL_MISSING ", " missing)
  set(kind STATUS)
  if(VITREL_REQUIRE_ALL_TESTS)
    set(kind FATAL_ERROR)
  endif()
  message(${kind} "Left out: tests that need ${missing} (modules of Python are those of ${Python3_EXECUTABLE}); "
                  "on Debian, scripts/install_dependencies installs them")
endif()
