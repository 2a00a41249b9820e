# The installed CMake package `lanescape`, with an export set for each of its components, and a pkg-config file. All compute their
# prefix from their own location, so an installation can be moved.
include(CMakePackageConfigHelpers)

set(LANESCAPE_FORTRAN_SOURCE ${CMAKE_INSTALL_DATADIR}/lanescape/fortran/lanescape.f90)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lanescape-config.cmake.in ${PROJECT_BINARY_DIR}/lanescape-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape PATH_VARS LANESCAPE_FORTRAN_SOURCE)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lanescape-config-version.cmake COMPATIBILITY SameMinorVersion)

# lanescape_install_config(<component>): with a component's own file, lanescape-<component in small letters>.cmake, what finds it.
function(lanescape_install_config component)
  install(FILES ${PROJECT_BINARY_DIR}/lanescape-config.cmake ${PROJECT_BINARY_DIR}/lanescape-config-version.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape COMPONENT ${component})
endfunction()

# lanescape_install_component(<component> <targets>): installs targets as an install component, which is a component of the package too.
function(lanescape_install_component component)
  string(TOLOWER ${component} name)
  install(TARGETS ${ARGN} EXPORT lanescape-${name} COMPONENT ${component}
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT lanescape-${name} NAMESPACE lanescape:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape COMPONENT ${component})
  lanescape_install_config(${component})
endfunction()

lanescape_install_component(CXX lanescape)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/api/lanescape ${PROJECT_BINARY_DIR}/generated/lanescape DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        COMPONENT CXX FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/cmake/LanescapeVerification.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape
        RENAME lanescape-verification.cmake COMPONENT Verification)
install(FILES ${PROJECT_SOURCE_DIR}/src/api/lanescape/host_kernel.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lanescape COMPONENT Verification)
lanescape_install_config(Verification)

# Users of a static library must link its dependencies. A prefix holds only one form of the library, so the pkg-config file lists
# these without --static.
if(NOT BUILD_SHARED_LIBS)
  set(LANESCAPE_PC_REQUIRES "fmt")
  set(LANESCAPE_PC_LIBS "-lpthread")
endif()
# For C, and for Fortran with the module of bindings/fortran.
lanescape_install_component(C lanescape_c)
install(FILES ${PROJECT_SOURCE_DIR}/src/api/lanescape/lanescape.h ${PROJECT_SOURCE_DIR}/src/api/lanescape/dynamics.h
              ${PROJECT_SOURCE_DIR}/src/api/lanescape/engine.h ${PROJECT_SOURCE_DIR}/src/api/lanescape/listed_potential.h
              ${PROJECT_SOURCE_DIR}/src/api/lanescape/shortening.h ${PROJECT_SOURCE_DIR}/src/api/lanescape/states.h
              ${PROJECT_BINARY_DIR}/generated/lanescape/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lanescape COMPONENT C)

file(RELATIVE_PATH LANESCAPE_PC_TO_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" LANESCAPE_PC_TO_PREFIX "${LANESCAPE_PC_TO_PREFIX}")
configure_file(${PROJECT_SOURCE_DIR}/cmake/lanescape.pc.in ${PROJECT_BINARY_DIR}/lanescape.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lanescape.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT CXX)
configure_file(${PROJECT_SOURCE_DIR}/cmake/lanescape-c.pc.in ${PROJECT_BINARY_DIR}/lanescape-c.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lanescape-c.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT C)
