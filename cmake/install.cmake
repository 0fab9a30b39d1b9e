# Installs the libraries, the command, and what find_package(limber) reads.
include(CMakePackageConfigHelpers)

set(layers common flexbody joints contact dynamics results scene)

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
endif()
if(LIMBER_REFERENCE)
  list(APPEND layers reference)
  install(TARGETS limber_verify
    DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/limber)
endif()
foreach(layer IN LISTS layers)
  list(APPEND targets limber_${layer})
endforeach()

# The public headers: these, and what they include. All others are details.
set(public_headers
  limber.hpp
  common/errors.hpp
  common/restitution.hpp
  common/rotation.hpp
  contact/law/hertz_law.hpp
  contact/law/impact_estimate.hpp
  contact/law/materials.hpp
  contact/make_contact.hpp
  contact/shapes/skin.hpp
  dynamics/analysis/balanced_truncation.hpp
  dynamics/analysis/equilibrium.hpp
  dynamics/analysis/level_advice.hpp
  dynamics/analysis/linear_system.hpp
  dynamics/analysis/natural_frequencies.hpp
  dynamics/analysis/steady_spin.hpp
  dynamics/equations/coupler_motion.hpp
  dynamics/equations/energy.hpp
  dynamics/equations/joint_state.hpp
  dynamics/equations/kinematics.hpp
  dynamics/simulation/run_record.hpp
  dynamics/system/model_check.hpp
  flexbody/file/cache.hpp
  flexbody/modal/decision_boundary.hpp
  flexbody/modal/fourier.hpp
  flexbody/modal/modal_response.hpp
  joints/pairs/point_springs.hpp
  results/checkpoint_file.hpp
  results/linear_model_file.hpp
  results/motion_error.hpp
  results/pictures.hpp
  results/probes_csv.hpp
  results/results_file.hpp
  results/xdmf.hpp
  scene/build/build_system.hpp
  scene/build/load_scene.hpp
  scene/control/linear_scene.hpp
  scene/control/measured_probe.hpp
  scene/build/scenario_writer.hpp
  scene/robot/robot_reader.hpp
  scene/scenario/scenario_reader.hpp)
if(LIMBER_REDUCTION)
  list(APPEND public_headers
    fem/gmsh/gmsh_reader.hpp
    fem/mesh/mesh_reader.hpp
    fem/solid/assembly.hpp
    fem/solid/eigenmodes.hpp
    fem/solid/static_solid.hpp
    reduction/departure.hpp
    reduction/full_body_maker.hpp
    reduction/mode_study.hpp
    reduction/operating_states.hpp
    reduction/power.hpp
    reduction/reduce.hpp)
endif()
if(LIMBER_REFERENCE)
  list(APPEND public_headers reference/verification.hpp)
endif()
set(installed)
while(public_headers)
  list(POP_FRONT public_headers header)
  if(header IN_LIST installed OR "${header}" STREQUAL "version.hpp")
    continue()
  endif()
  list(APPEND installed ${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/src/${header} includes
    REGEX "^#include \"limber/")
  list(TRANSFORM includes REPLACE "^#include \"limber/([^\"]+)\".*" "\\1")
  list(APPEND public_headers ${includes})
endwhile()
foreach(header IN LISTS installed)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limber/${folder})
endforeach()

install(FILES ${PROJECT_BINARY_DIR}/include/limber/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limber)

install(TARGETS ${targets} EXPORT limber
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
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
