# Installs Limber, in components of which scripts/package makes packages:
#   command   limber, its page, manual pages, completion, examples
#   mesher    limber-mesh, which Gmsh runs in
#   verifier  limber-verify, which links Simbody
#   dev       libraries, headers, and what find_package(limber) reads
#   python    the Python module (python/CMakeLists.txt)
include(CMakePackageConfigHelpers)

set(layers common flexbody joints contact dynamics results scene runs)

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
    DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/limber COMPONENT mesher)
endif()
if(LIMBER_REFERENCE)
  list(APPEND layers reference)
  install(TARGETS limber_verify
    DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/limber COMPONENT verifier)
endif()
foreach(layer IN LISTS layers)
  list(APPEND targets limber_${layer})
endforeach()

# The public headers: those of docs/reference/compatibility.md and what limber.hpp includes.
set(public_headers
  limber.hpp
  common/errors.hpp
  contact/make_contact.hpp
  dynamics/analysis/balanced_truncation.hpp
  dynamics/analysis/equilibrium.hpp
  dynamics/analysis/linear_system.hpp
  dynamics/analysis/natural_frequencies.hpp
  dynamics/analysis/steady_spin.hpp
  dynamics/equations/energy.hpp
  dynamics/equations/joint_state.hpp
  dynamics/equations/node_motion.hpp
  dynamics/simulation/simulation.hpp
  dynamics/simulation/simulator.hpp
  dynamics/system/system_builder.hpp
  flexbody/file/body_file.hpp
  flexbody/file/cache.hpp
  joints/joint_kind.hpp
  joints/pairs/point_springs.hpp
  results/linear_model_file.hpp
  results/motion_error.hpp
  results/probes_csv.hpp
  results/results_file.hpp
  runs/batch.hpp
  runs/analyses/linear_run.hpp
  runs/analyses/static_run.hpp
  runs/compare/comparison.hpp
  runs/compare/comparison_selection.hpp
  runs/run.hpp
  scene/build/build_system.hpp
  scene/build/load_scene.hpp)
if(LIMBER_REDUCTION)
  list(APPEND public_headers reduction/reduce.hpp)
endif()
if(LIMBER_REFERENCE)
  list(APPEND public_headers reference/verification.hpp)
endif()
install(CODE "
  set(source [[${PROJECT_SOURCE_DIR}/src/limber]])
  set(public [[${public_headers}]])
  set(folder [[${CMAKE_INSTALL_INCLUDEDIR}]])
  set(work [[${PROJECT_BINARY_DIR}/headers]])
  include([[${PROJECT_SOURCE_DIR}/cmake/install_headers.cmake]])" COMPONENT dev)
install(FILES ${PROJECT_BINARY_DIR}/include/limber/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limber COMPONENT dev)

install(TARGETS ${targets} EXPORT limber
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT command
    NAMELINK_COMPONENT dev
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS limber DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT command)
# Scenarios name their robots, and robots their meshes, by paths from one to the other.
install(DIRECTORY examples models meshes
  DESTINATION ${CMAKE_INSTALL_DATADIR}/limber COMPONENT command
  PATTERN CMakeLists.txt EXCLUDE PATTERN *.cpp EXCLUDE)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/limber)
install(EXPORT limber NAMESPACE limber:: FILE limber-targets.cmake
  DESTINATION ${package_dir} COMPONENT dev)
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
  DESTINATION ${package_dir} COMPONENT dev)
