# What an installed wfpsf is: the shared library, its headers, the CMake package and wfpsf.pc.
# Consumers need nothing else; what the library stands on is linked into it or by it.
include(CMakePackageConfigHelpers)

# The component `library` is what programs run with; all else is what they are built with.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

install(TARGETS wfpsf EXPORT wfpsf-targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
if(WFPSF_BUILD_STATIC)
  install(TARGETS wfpsf_static EXPORT wfpsf-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/capi/include/wfpsf
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_BINARY_DIR}/capi/include/wfpsf/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wfpsf)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/wfpsf)
install(EXPORT wfpsf-targets NAMESPACE wfpsf:: FILE wfpsf-config.cmake
  DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wfpsf-config-version.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wfpsf-config-version.cmake DESTINATION ${package_folder})

# The Julia package, to be loaded from there: Pkg.develop(path = ...) or LOAD_PATH.
set(julia_folder ${CMAKE_INSTALL_DATADIR}/wfpsf/julia)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/julia/src DESTINATION ${julia_folder})
install(FILES ${PROJECT_SOURCE_DIR}/bindings/julia/Project.toml DESTINATION ${julia_folder})
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR
  BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${julia_folder} OUTPUT_VARIABLE julia_libdir)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/julia_installed.txt CONTENT "${julia_libdir}\n")
install(FILES ${PROJECT_BINARY_DIR}/julia_installed.txt RENAME installed.txt
  DESTINATION ${julia_folder})

# The prefix is found from the .pc file's own place, so that the tree can be moved.
cmake_path(SET pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
  BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${pkgconfig_folder} OUTPUT_VARIABLE pkgconfig_prefix)
configure_file(${PROJECT_SOURCE_DIR}/cmake/wfpsf.pc.in ${PROJECT_BINARY_DIR}/wfpsf.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/wfpsf.pc DESTINATION ${pkgconfig_folder})
