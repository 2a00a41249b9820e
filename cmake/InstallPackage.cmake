# The installed CMake package `lanescape` with its target `lanescape::lanescape`, and a pkg-config file.
include(CMakePackageConfigHelpers)

install(TARGETS lanescape EXPORT lanescape-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${PROJECT_SOURCE_DIR}/src/api/lanescape/lanescape.hpp ${PROJECT_BINARY_DIR}/generated/lanescape/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lanescape)
install(EXPORT lanescape-targets NAMESPACE lanescape:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lanescape-config.cmake.in ${PROJECT_BINARY_DIR}/lanescape-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lanescape-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lanescape-config.cmake ${PROJECT_BINARY_DIR}/lanescape-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape)
configure_file(${PROJECT_SOURCE_DIR}/cmake/lanescape.pc.in ${PROJECT_BINARY_DIR}/lanescape.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lanescape.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
