// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/full_body_maker.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "limber/common/duration.hpp"
#include "limber/common/errors.hpp"
#include "limber/fem/linalg/factor_cost.hpp"
#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/solid/assembly.hpp"
#include "limber/fem/solid/cauchy_stress.hpp"
#include "limber/fem/solid/nodal_mass.hpp"
#include "limber/fem/solid/nonlinear_solid.hpp"
#include "limber/fem/solid/tangent.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/model/full_stress.hpp"
#include "limber/reduction/contact_surface.hpp"
#include "limber/reduction/matrices/reduce_matrices.hpp"
#include "limber/reduction/meshed_body.hpp"
#include "limber/reduction/modal/interfaces.hpp"
#include "limber/reduction/modal/support.hpp"

namespace limber::flexbody {
namespace {

fem::SparseMatrix make_diagonal(const VectorX& mass) {
  fem::SparseMatrix M_s(mass.size(), mass.size());
  M_s.setIdentity();
  M_s.diagonal() = mass;
  return M_s;
}

/// Data shared by all solvers of one body.
struct SolidParts {
  SolidParts(fem::Mesh mesh_, std::vector<fem::ElasticMaterial> materials_,
             const std::vector<int>& held, const fem::SparseMatrix& consistent,
             const FullOptions& options,
             std::vector<FullContactSurface> surfaces_)
      : mesh(std::move(mesh_)),
        materials(std::move(materials_)),
        law(find_elasticity(options.law)),
        free(fem::find_free_nodes(mesh, held)),
        solid(mesh, materials, law),
        is_lumped(options.mass == NodalMassKind::lumped),
        surfaces(std::move(surfaces_)) {
    if (is_lumped) {
      const VectorX lumped = fem::calc_lumped_mass(mesh, materials);
      M_s = make_diagonal(lumped);
      free_mass.emplace(VectorX(lumped(free)));
    } else {
      M_s = consistent;
      free_mass.emplace(fem::restrict_matrix(M_s, free));
    }
  }

  fem::Mesh mesh;
  std::vector<fem::ElasticMaterial> materials;
  fem::Elasticity law;
  std::vector<int> free;
  fem::NonlinearSolid solid;
  bool is_lumped;
  fem::SparseMatrix M_s;                    // of all nodes
  std::optional<fem::NodalMass> free_mass;  // of the free nodes
  std::vector<FullContactSurface> surfaces;
};

class MeshStress : public FullStress {
 public:
  MeshStress(const SolidParts& parts, const std::vector<int>& nodes)
      : stress_(parts.mesh, parts.materials, parts.law, nodes) {}

  [[nodiscard]] const std::vector<int>& nodes() const override {
    return stress_.nodes();
  }
  void calc_stress(FullBodySolver::ConstField u,
                   Eigen::Ref<Matrix6X> stress) const override {
    stress_.evaluate(u, stress);
  }

 private:
  fem::CauchyStress stress_;
};

class MeshSolver : public StressedSolver, public ContactSurfaces {
 public:
  explicit MeshSolver(std::shared_ptr<const SolidParts> parts)
      : parts_(std::move(parts)),
        workspace_(parts_->solid.make_workspace()),
        free_force_(3, std::ssize(parts_->free)),
        free_a_(3, std::ssize(parts_->free)) {}

  [[nodiscard]] const std::vector<FullContactSurface>& contact_surfaces()
      const override {
    return parts_->surfaces;
  }

  double calc_internal_force(ConstField u, Field force) override {
    return parts_->solid.calc_force(u, force, workspace_);
  }

  void multiply_mass(ConstField a, Field force) const override {
    force.noalias() = a * parts_->M_s;
  }

  void divide_mass(ConstField force, Field a) const override {
    const std::vector<int>& free = parts_->free;
    for (Eigen::Index i = 0; i < free_force_.cols(); ++i) {
      free_force_.col(i) = force.col(free[static_cast<std::size_t>(i)]);
    }
    parts_->free_mass->divide(free_force_, free_a_);
    a.setZero();
    for (Eigen::Index i = 0; i < free_force_.cols(); ++i) {
      a.col(free[static_cast<std::size_t>(i)]) = free_a_.col(i);
    }
  }

  [[nodiscard]] std::shared_ptr<const FullStress> make_stress(
      const std::vector<int>& nodes) const override {
    return std::make_shared<MeshStress>(*parts_, nodes);
  }

  void factor(ConstField u, double c) override {
    if (!tangent_) {
      tangent_.emplace(parts_->mesh, parts_->materials, parts_->law,
                       parts_->M_s, parts_->free);
    }
    tangent_->factor(u, c);
  }

  void solve(Eigen::Ref<MatrixX> x) const override {
    const std::vector<int>& free = parts_->free;
    if (3 * std::ssize(free) == x.rows()) {
      tangent_->solve_in_place(x);
      return;
    }
    const MatrixX answer = tangent_->solve(take_rows(x, free));
    x = put_rows(answer, free, x.rows() / 3);
  }

 private:
  std::shared_ptr<const SolidParts> parts_;
  fem::NonlinearSolid::Workspace workspace_;
  mutable Matrix3X free_force_;
  mutable Matrix3X free_a_;
  std::optional<fem::TangentFactor> tangent_;
};

/// (x - its mean) M_s, 3 x N.
Matrix3X find_first_moment(const Matrix3X& x, const fem::SparseMatrix& M_s,
                           const VectorX& node_mass) {
  const Vector3 mean = x * node_mass / node_mass.sum();
  const Matrix3X centered = x.colwise() - mean;
  return centered * M_s;
}

/// A geometry may give a different mesh each time.
void require_same_mesh(const Recipe& recipe, const fem::Mesh& mesh,
                       const std::string& key) {
  if (key.empty()) return;
  if (content_key(recipe, fem::find_mesh_content(mesh)) == key) return;
  throw InputError(fmt::format(
      "{}: it produced two different meshes, one for the reduced body and one "
      "for level full. Did it change in between, or does it depend on the "
      "time? Save its mesh as .msh and use that.",
      recipe.mesh.file.string()));
}

// Implicit steps and equilibria need factors, one or more each.
void report_factors(const std::string& name, const fem::SparseMatrix& M_s,
                    const Progress& progress) {
  constexpr Eigen::Index kMany = 10000;  // nodes; fewer are always fast
  constexpr double kLong = 5.0;          // s, of many
  if (!progress || M_s.cols() < kMany) return;
  const double seconds =
      fem::estimate_factor_seconds(M_s, fem::order_nodes(M_s));
  const std::string what =
      fmt::format("each factorisation of '{}' at level full, {} unknowns", name,
                  3 * M_s.cols());
  const std::string text = with_duration(what, seconds, kLong);
  if (text != what) report(progress, text, 0.0);
}

}  // namespace

std::shared_ptr<const FullBody> make_full_body(const Recipe& recipe,
                                               const FullOptions& options,
                                               const Progress& progress,
                                               const ReducedBody* reduced) {
  if (is_node_model(recipe.mesh))
    throw InputError(
        fmt::format("{}: level full needs the solid elements of a mesh; "
                    "matrices, beams and shells have none. Use level coupled",
                    recipe.mesh.file.string()));
  fem::Mesh mesh = read_source(recipe.mesh, progress).mesh;
  if (reduced != nullptr) {
    require_same_mesh(recipe, mesh, reduced->content_key);
  }
  const std::vector<Interface> interfaces = find_interfaces(mesh, recipe);
  const std::vector<int> held = find_clamped_nodes(mesh, recipe);
  std::vector<fem::ElasticMaterial> materials = find_materials(mesh, recipe);
  const fem::SparseMatrix M_s = fem::assemble(mesh, materials, progress).M_s;
  report_factors(recipe.name, M_s, progress);
  const Vector3 center = fem::calc_mass_properties(M_s, mesh.x).center;
  const Matrix3X x_B = mesh.x.colwise() - center;
  std::vector<FullContactSurface> surfaces =
      make_full_contact_surfaces(mesh, recipe, materials, center, reduced);
  const auto parts = std::make_shared<const SolidParts>(
      std::move(mesh), std::move(materials), held, M_s, options,
      std::move(surfaces));

  auto body = std::make_shared<FullBody>();
  body->x_B = x_B;
  body->node_mass = parts->M_s * VectorX::Ones(x_B.cols());
  body->first_moment = find_first_moment(x_B, parts->M_s, body->node_mass);
  body->held.assign(static_cast<std::size_t>(x_B.cols()), 0);
  for (const int n : held) body->held[static_cast<std::size_t>(n)] = 1;
  for (const Interface& interface : interfaces) {
    const fem::WeightedNodes& selection = interface.selection;
    body->interfaces.push_back({interface.name, selection.nodes,
                                selection.weights, selection.moments});
  }
  body->make_solver = [parts] { return std::make_unique<MeshSolver>(parts); };
  return body;
}

}  // namespace limber::flexbody
