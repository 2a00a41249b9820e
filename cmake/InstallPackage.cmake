# The installed CMake package `lanescape` with its target `lanescape::lanescape`, and a pkg-config file. Both compute their prefix
# from their own location, so an installation can be moved.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape)
install(TARGETS lanescape EXPORT lanescape-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/api/lanescape ${PROJECT_BINARY_DIR}/generated/lanescape DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")

install(EXPORT lanescape-targets NAMESPACE lanescape:: DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lanescape-config.cmake.in ${PROJECT_BINARY_DIR}/lanescape-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lanescape-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lanescape-config.cmake ${PROJECT_BINARY_DIR}/lanescape-config-version.cmake DESTINATION ${package_dir})

# Users of a static library must link its dependencies. A prefix holds only one form of the library, so the pkg-config file lists
# these without --static.
if(NOT BUILD_SHARED_LIBS)
  set(LANESCAPE_PC_REQUIRES "fmt")
  set(LANESCAPE_PC_LIBS "${OpenMP_CXX_FLAGS} -lpthread")
endif()
file(RELATIVE_PATH LANESCAPE_PC_TO_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" LANESCAPE_PC_TO_PREFIX "${LANESCAPE_PC_TO_PREFIX}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/lanescape.pc.in ${PROJECT_BINARY_DIR}/lanescape.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lanescape.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
