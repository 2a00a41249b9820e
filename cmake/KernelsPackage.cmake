# The kernels alone: target lanescape_kernels holds the kernels of all instruction sets and the dispatch between them, and needs
# only the standard library. Install component `kernels`, package `lanescape-kernels`, target lanescape::kernels.
add_library(lanescape_kernels STATIC ${PROJECT_SOURCE_DIR}/src/dispatch/isa.cpp)
add_library(lanescape::kernels ALIAS lanescape_kernels)
lanescape_link_isa_objects(lanescape_kernels lanescape_kernels)
set(kernel_headers ${CMAKE_INSTALL_INCLUDEDIR}/lanescape-kernels)
target_include_directories(
  lanescape_kernels PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src/api> $<BUILD_INTERFACE:${LANESCAPE_INTERNAL_HEADERS}>
                           $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/kernels> $<INSTALL_INTERFACE:${kernel_headers}>)
target_compile_features(lanescape_kernels PUBLIC cxx_std_20)
target_link_libraries(lanescape_kernels PRIVATE $<BUILD_INTERFACE:lanescape_warnings>)
set_target_properties(lanescape_kernels PROPERTIES EXPORT_NAME kernels)

if(NOT LANESCAPE_INSTALL)
  set_target_properties(lanescape_kernels PROPERTIES EXCLUDE_FROM_ALL ON)
  return()
endif()
set(kernels_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lanescape-kernels)
install(TARGETS lanescape_kernels EXPORT lanescape-kernels-config COMPONENT kernels ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT kernels)
install(EXPORT lanescape-kernels-config NAMESPACE lanescape:: DESTINATION ${kernels_package_dir} COMPONENT kernels)
install(FILES ${PROJECT_SOURCE_DIR}/src/core/error.hpp DESTINATION ${kernel_headers}/core COMPONENT kernels)
install(FILES ${PROJECT_SOURCE_DIR}/src/api/lanescape/error.hpp ${PROJECT_SOURCE_DIR}/src/api/lanescape/export.hpp
        DESTINATION ${kernel_headers}/lanescape COMPONENT kernels)
install(FILES ${PROJECT_SOURCE_DIR}/src/dispatch/isa.hpp ${LANESCAPE_INTERNAL_HEADERS}/dispatch/instruction_sets.hpp
        DESTINATION ${kernel_headers}/dispatch COMPONENT kernels)
foreach(name IN ITEMS kernel_table.hpp kernel_list.def pair_kernels.hpp pair_forms.hpp views)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/${name})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/kernels/${name} DESTINATION ${kernel_headers} COMPONENT kernels)
  else()
    install(FILES ${PROJECT_SOURCE_DIR}/kernels/${name} DESTINATION ${kernel_headers} COMPONENT kernels)
  endif()
endforeach()
