# Debian packages and the source tarball: `cpack --config build/release/CPackConfig.cmake` and
# `cpack --config build/release/CPackSourceConfig.cmake`.
set(WFPSF_PACKAGE_CONTACT "wfpsf developers <wfpsf@packages.invalid>" CACHE STRING
  "Maintainer named in packages: Name <address>")

set(documentation ${CMAKE_INSTALL_DATADIR}/doc)
set(library_package libwfpsf${WFPSF_ABI_NUMBER})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)

# What Debian's policy wants in every package: copyright and changelog.
configure_file(${PROJECT_SOURCE_DIR}/cmake/debian_changelog.in
  ${PROJECT_BINARY_DIR}/packages/changelog @ONLY)
find_program(GZIP gzip)
foreach(component_and_package
    library:${library_package} development:libwfpsf-dev python:python3-wfpsf)
  string(REPLACE ":" ";" pair ${component_and_package})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian_copyright RENAME copyright
    DESTINATION ${documentation}/${package} COMPONENT ${component})
  if(GZIP)
    execute_process(COMMAND ${GZIP} -9nkf ${PROJECT_BINARY_DIR}/packages/changelog
      COMMAND_ERROR_IS_FATAL ANY)
    install(FILES ${PROJECT_BINARY_DIR}/packages/changelog.gz RENAME changelog.gz
      DESTINATION ${documentation}/${package} COMPONENT ${component})
  endif()
endforeach()
install(FILES README.md DESTINATION ${documentation}/libwfpsf-dev)
install(DIRECTORY docs DESTINATION ${documentation}/libwfpsf-dev FILES_MATCHING PATTERN "*.md")
install(DIRECTORY examples DESTINATION ${documentation}/libwfpsf-dev
  PATTERN CMakeLists.txt EXCLUDE PATTERN "__pycache__" EXCLUDE)

# What the library is made of, with the versions it was built with (SPDX 2.3).
find_package(Eigen3 QUIET NO_MODULE)
find_package(ZLIB QUIET)
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/licences.txt components REGEX "^[^#]")
set(packages)
set(relations)
foreach(line ${components})
  string(REPLACE "|" ";" fields "${line}")
  list(TRANSFORM fields STRIP)
  list(GET fields 0 name)
  list(GET fields 1 variable)
  list(GET fields 2 licence)
  list(GET fields 3 linked)
  if(${variable})
    set(version ${${variable}})
  else()
    set(version NOASSERTION)
  endif()
  string(APPEND packages ",
    {\"SPDXID\": \"SPDXRef-${name}\", \"name\": \"${name}\", \"versionInfo\": \"${version}\",
     \"licenseDeclared\": \"${licence}\", \"licenseConcluded\": \"${licence}\",
     \"downloadLocation\": \"NOASSERTION\", \"copyrightText\": \"NOASSERTION\",
     \"filesAnalyzed\": false}")
  string(APPEND relations ",
    {\"spdxElementId\": \"SPDXRef-wfpsf\", \"relationshipType\": \"${linked}\",
     \"relatedSpdxElement\": \"SPDXRef-${name}\"}")
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/cmake/sbom.spdx.json.in
  ${PROJECT_BINARY_DIR}/packages/sbom.spdx.json @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/packages/sbom.spdx.json
  DESTINATION ${documentation}/${library_package} COMPONENT library)

set(CPACK_PACKAGE_CONTACT ${WFPSF_PACKAGE_CONTACT})
set(CPACK_PACKAGE_VENDOR wfpsf)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL library development python)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_package})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packages/triggers
  CONTENT "activate-noawait ldconfig\n")
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packages/shlibs
  CONTENT "libwfpsf ${WFPSF_ABI_NUMBER} ${library_package} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
  ${PROJECT_BINARY_DIR}/packages/triggers ${PROJECT_BINARY_DIR}/packages/shlibs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "Roman PSFs, interpixel capacitance and moments, library
 Point-spread functions of WFIRST and Roman, interpixel capacitance and other
 effects of near-infrared detectors, and adaptive moments, behind a C interface.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libwfpsf-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Roman PSFs, interpixel capacitance and moments, headers
 C headers, Fortran modules, CMake package, pkg-config files, documentation and
 examples of wfpsf.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-wfpsf)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_COMPONENT_PYTHON_DEPENDS library)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Roman PSFs, interpixel capacitance and moments, Python
 The Python package of wfpsf, on NumPy arrays, and its plugin for GalSim.")

# The tarball needs nothing that it does not hold, but the packages of install_dependencies.sh.
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME wfpsf-${PROJECT_VERSION})
set(CPACK_SOURCE_IGNORE_FILES "/\\\\.git" "/build/" "/out/" "__pycache__" "~$")
include(CPack)
