// SPDX-License-Identifier: BSD-3-Clause
#include "fem/static_solid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/errors.hpp"
#include "fem/assembly.hpp"
#include "fem/cholesky.hpp"
#include "fem/element_matrices.hpp"
#include "fem/mesh_checks.hpp"
#include "fem/nonlinear_solid.hpp"

namespace limber::fem {
namespace {

std::vector<int> find_free_nodes(const Mesh& mesh,
                                 const std::vector<int>& held) {
  std::vector<int> nodes;
  for (int n = 0; n < static_cast<int>(mesh.node_count()); ++n) {
    if (!std::binary_search(held.begin(), held.end(), n)) nodes.push_back(n);
  }
  return nodes;
}

class StaticSolver {
 public:
  StaticSolver(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
               Elasticity law, const std::vector<int>& held)
      : mesh_(mesh),
        materials_(materials),
        law_(law),
        free_(find_free_nodes(mesh, held)),
        solid_(mesh, materials, law),
        workspace_(solid_.make_workspace()),
        assembly_(mesh),
        matrices_(assembly_.make_zero()),
        internal_(3, mesh.x.cols()) {}

  StaticSolution solve(const Matrix3X& load, const StaticSettings& settings) {
    StaticSolution solution{Matrix3X::Zero(3, mesh_.x.cols())};
    for (int step = 1; step <= settings.load_steps; ++step) {
      const double share = static_cast<double>(step) / settings.load_steps;
      const char* why = "Newton's method does not converge";
      bool done = false;
      try {
        done = balance(share * load, settings, solution);
      } catch (const NumericalError& error) {
        fail(share, settings, error.what());
      }
      if (!done) fail(share, settings, why);
    }
    return solution;
  }

 private:
  [[noreturn]] void fail(double share, const StaticSettings& settings,
                         const std::string& why) const {
    throw NumericalError(fmt::format(
        "{}: no equilibrium between {:.4g} and {:.4g} of the load: {}. Take "
        "more load steps, or expect a limit point there.",
        mesh_.source, share - 1.0 / settings.load_steps, share, why));
  }

  bool balance(const Matrix3X& load, const StaticSettings& settings,
               StaticSolution& solution) {
    for (int i = 0; i < settings.newton_iterations; ++i) {
      solution.strain_energy =
          solid_.calc_force(solution.u, internal_, workspace_);
      const Matrix3X residual = load - internal_;
      const Matrix3X free_residual = residual(Eigen::all, free_);
      if (free_residual.norm() <= settings.tolerance * load.norm()) return true;
      factor(solution.u);
      const MatrixX correction = factor_->solve(free_residual.reshaped());
      solution.u(Eigen::all, free_) +=
          correction.reshaped(3, free_residual.cols());
      ++solution.newton_iterations;
    }
    return false;
  }

  void factor(const Matrix3X& u) {
    assembly_.assemble(
        [&](const ElementBlock& block, std::size_t e) {
          const int* nodes = block.element_nodes(e);
          const std::vector<int> own(nodes, nodes + block.element->node_count);
          return calc_element_tangent(
              *block.element, mesh_.x(Eigen::all, own), u(Eigen::all, own),
              materials_[static_cast<std::size_t>(block.regions[e])], law_);
        },
        matrices_.K);
    const StructuralMatrices free = restrict_to(matrices_, free_);
    if (factor_) {
      factor_->factor(free.K);
    } else {
      factor_.emplace(free.K, order_dofs(free.M_s), "the tangent stiffness");
    }
  }

  const Mesh& mesh_;
  const std::vector<ElasticMaterial>& materials_;
  Elasticity law_;
  std::vector<int> free_;
  NonlinearSolid solid_;
  NonlinearSolid::Workspace workspace_;
  StiffnessAssembly assembly_;
  StructuralMatrices matrices_;  // K is the tangent
  Matrix3X internal_;
  std::optional<SparseCholesky> factor_;
};

}  // namespace

StaticSolution solve_static(const Mesh& mesh,
                            const std::vector<ElasticMaterial>& materials,
                            Elasticity law, const Matrix3X& load,
                            const std::vector<int>& held,
                            const StaticSettings& settings) {
  LIMBER_EXPECT(load.cols() == mesh.x.cols());
  return StaticSolver(mesh, materials, law, held).solve(load, settings);
}

}  // namespace limber::fem
