# The target `docs`: the reference of the libraries from their headers, in build/<preset>/docs/html. It fails
# with the first undocumented or wrong reference.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()

set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_FILE_PATTERNS *.h *.md)
set(DOXYGEN_IMAGE_PATH ${PROJECT_SOURCE_DIR}/bench ${PROJECT_SOURCE_DIR}/docs)
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_FULL_PATH_NAMES YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_EXTRACT_STATIC YES)
set(DOXYGEN_HIDE_UNDOC_RELATIONS YES)
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_GENERATE_TREEVIEW YES)
set(DOXYGEN_HTML_EXTRA_STYLESHEET ${PROJECT_SOURCE_DIR}/docs/reference.css)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${PROJECT_SOURCE_DIR}/README.md)
set(DOXYGEN_EXCLUDE_PATTERNS */bench/*.h)
# Formulas in TeX, shown without a network.
set(DOXYGEN_FILTER_PATTERNS */how-it-works/*.md=${PROJECT_SOURCE_DIR}/cmake/doxygen_page
    */tutorials/*.md=${PROJECT_SOURCE_DIR}/cmake/doxygen_page)
set(DOXYGEN_USE_MATHJAX YES)
set(DOXYGEN_MATHJAX_EXTENSIONS TeX/AMSmath TeX/AMSsymbols)
set(DOXYGEN_MATHJAX_RELPATH /usr/share/javascript/mathjax)
doxygen_add_docs(docs README.md CONTRIBUTING.md core mc edmd analysis workflow app/README.md python/README.md bench params scripts tests/README.md docs
                 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                 COMMENT "Writing the reference to ${DOXYGEN_OUTPUT_DIRECTORY}/html")
