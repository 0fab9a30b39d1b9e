// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/mode_study.hpp"

#include "limber/fem/solid/assembly.hpp"
#include "limber/flexbody/modal/mode_selection.hpp"
#include "limber/reduction/matrices/matrix_body.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/modal/selection.hpp"
#include "limber/reduction/modal/static_modes.hpp"

namespace limber::flexbody {
namespace {

std::vector<LoadCaseStudy> study_loads(const ElasticBody& body,
                                       const Recipe& recipe,
                                       const fem::Eigenmodes& modes,
                                       const Progress& progress) {
  if (recipe.load_patterns.empty() && recipe.nodal_forces.empty()) return {};
  const LoadCases cases =
      find_load_cases(body, recipe, ModeMeasure::compliance);
  const CaseContributions work =
      find_contributions(ModeMeasure::compliance, modes, cases, body, progress);
  CaseContributions masses{
      calc_report_effective_mass(modes.Phi, modes.lambda,
                                 body.support.matrices.M_s, cases.loads),
      VectorX()};
  const bool has_total = can_find_all_modes(body);
  if (has_total) masses.totals = find_report_totals(cases, body, progress);
  std::vector<LoadCaseStudy> studies;
  for (Eigen::Index k = 0; k < cases.count(); ++k) {
    LoadCaseStudy study;
    study.name = cases.names[static_cast<std::size_t>(k)];
    study.effective_mass = masses.by_mode.col(k);
    if (has_total) study.effective_mass_total = masses.totals[k];
    study.compliance = work.by_mode.col(k);
    study.compliance_total = work.totals[k];
    studies.push_back(std::move(study));
  }
  return studies;
}

BaseMotionStudy study_base(const ElasticBody& body,
                           const fem::Eigenmodes& modes) {
  const Participation participation = calc_base_participation(body, modes);
  return {participation.factors.topRows<3>(),
          participation.effective_mass.topRows<3>(),
          participation.rigid_mass.head<3>()};
}

fem::Eigenmodes find_eigenmodes(const ElasticBody& body, const Recipe& recipe,
                                const Progress& progress) {
  const int count = recipe.basis.eigenmodes;
  if (count > 0) return fem::find_eigenmodes(body.inverse, count, progress);
  return {VectorX(), MatrixX(body.support.matrices.dof_count(), 0)};
}

ModeStudy study_body(const ElasticBody& body, const Recipe& recipe,
                     const fem::Eigenmodes& modes, const Progress& progress) {
  ModeStudy result;
  result.clamped = body.support.is_clamped;
  result.lambda = modes.lambda;
  result.cases = study_loads(body, recipe, modes, progress);
  if (result.clamped) result.base = study_base(body, modes);
  return result;
}

ModeStudy study(const MeshedBody& body, const Recipe& recipe,
                const fem::Eigenmodes& modes, const Progress& progress) {
  const fem::MassProperties inertia =
      fem::calc_mass_properties(body.M_s, body.mesh.x);
  ModeStudy result = study_body(body, recipe, modes, progress);
  result.notices = body.made->notices;
  result.mesh_nodes = body.mesh.node_count();
  result.mesh_elements = body.mesh.element_count();
  result.size = body.mesh.size();
  result.mesh_boundary_nodes = body.mesh.boundary_nodes.size();
  result.mass = inertia.mass;
  result.p_MoBcm_M = inertia.center;
  result.inertia = inertia.S0.trace() * Matrix3::Identity() - inertia.S0;
  result.found = find_file_materials(body.mesh, recipe);
  result.locking = find_locking(body, recipe, modes.lambda, modes.Phi);
  report(progress, "studied", 1.0);
  return result;
}

ModeStudy study(const MatrixBody& body, const Recipe& recipe,
                const fem::Eigenmodes& modes, const Progress& progress) {
  const MatrixSystem& system = body.part->system;
  ModeStudy result = study_body(body, recipe, modes, progress);
  result.notices = system.notices;
  result.found = system.found;
  result.mesh_nodes = system.node_count();
  result.mesh_boundary_nodes = system.node_count();
  result.size = system.size();
  result.mass = body.part->inertia.mass;
  result.p_MoBcm_M = body.part->inertia.center;
  result.inertia = body.part->inertia.J0;
  report(progress, "studied", 1.0);
  return result;
}

/// `study` of the recipe's body, from matrices or from a mesh.
template <typename Study>
ModeStudy study_source(const Recipe& recipe, const Progress& progress,
                       const Study& study) {
  if (!is_node_model(recipe.mesh)) return study(MeshedBody(recipe, progress));
  return study(MatrixBody(recipe, read_matrix_part(recipe.mesh, progress)));
}

}  // namespace

PartMass find_part_mass(const Recipe& recipe, const Progress& progress) {
  if (is_node_model(recipe.mesh)) {
    const auto part = read_matrix_part(recipe.mesh, progress);
    return {part->inertia.mass, part->inertia.center, part->system.size(),
            part->system.notices};
  }
  const fem::TracedMesh made = read_source(recipe.mesh, progress);
  const fem::StructuralMatrices matrices =
      fem::assemble(made.mesh, find_materials(made.mesh, recipe), progress);
  const fem::MassProperties inertia =
      fem::calc_mass_properties(matrices.M_s, made.mesh.x);
  return {inertia.mass, inertia.center, made.mesh.size(), made.notices};
}

ModeStudy study_modes(const Recipe& recipe, const Progress& progress) {
  return study_source(recipe, progress, [&](const auto& body) {
    return study(body, recipe, find_eigenmodes(body, recipe, progress),
                 progress);
  });
}

ModeStudy study_basis(const Recipe& recipe, const Progress& progress) {
  return study_source(recipe, progress, [&](const auto& body) {
    const fem::Eigenmodes modes = find_eigenmodes(body, recipe, progress);
    const ReducedBasis basis =
        join_basis(body, modes, find_static_modes(body, recipe, modes),
                   recipe.basis.drop_tolerance);
    return study(body, recipe, {basis.lambda, basis.Phi}, progress);
  });
}

}  // namespace limber::flexbody
