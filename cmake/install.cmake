# Installs the libraries, the command, and what find_package(limber) reads.
include(CMakePackageConfigHelpers)

set(layers common flexbody joints dynamics results scene)

# limber::limber: everything that is free of the GPL. Programs that reduce
# meshes ask for limber::reduction by name.
add_library(limber_all INTERFACE)
add_library(limber::limber ALIAS limber_all)
set_target_properties(limber_all PROPERTIES EXPORT_NAME limber)
foreach(layer IN LISTS layers)
  target_link_libraries(limber_all INTERFACE limber_${layer})
endforeach()

set(targets limber_all)
if(LIMBER_REDUCTION)
  list(APPEND layers fem)
  list(APPEND targets limber_gmsh limber_reduction)
  install(TARGETS limber_mesh
    DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/limber)
  set(without_reduction)
else()
  set(without_reduction
    PATTERN reduce.hpp EXCLUDE PATTERN reduce_*.hpp EXCLUDE
    PATTERN fem_*.hpp EXCLUDE)
endif()
if(LIMBER_REFERENCE)
  list(APPEND layers reference)
endif()
foreach(layer IN LISTS layers)
  list(APPEND targets limber_${layer})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${layer}/
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limber/${layer}
    FILES_MATCHING PATTERN *.hpp ${without_reduction}
    PATTERN simbody_*.hpp EXCLUDE)  # those need Simbody's headers
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/src/limber.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limber)

install(TARGETS ${targets} EXPORT limber
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    ${CMAKE_INSTALL_INCLUDEDIR}/limber)
install(TARGETS limber DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/limber)
install(EXPORT limber NAMESPACE limber:: FILE limber-targets.cmake
  DESTINATION ${package_dir})
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/limber-config.cmake.in
  ${PROJECT_BINARY_DIR}/limber-config.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/limber-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/limber-config.cmake
  ${PROJECT_BINARY_DIR}/limber-config-version.cmake
  DESTINATION ${package_dir})
