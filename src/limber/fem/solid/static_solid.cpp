// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/solid/static_solid.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/nonlinear_solid.hpp"
#include "limber/fem/solid/tangent.hpp"

namespace limber::fem {
namespace {

class StaticSolver {
 public:
  StaticSolver(const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
               Elasticity law, const std::vector<int>& held)
      : mesh_(mesh),
        no_mass_(mesh.x.cols(), mesh.x.cols()),
        solid_(mesh, materials, law),
        workspace_(solid_.make_workspace()),
        tangent_(mesh, materials, law, no_mass_, find_free_nodes(mesh, held)),
        internal_(3, mesh.x.cols()) {}

  StaticSolution solve(const Matrix3X& load, const StaticSettings& settings) {
    StaticSolution solution{Matrix3X::Zero(3, mesh_.x.cols())};
    for (int step = 1; step <= settings.load_steps; ++step) {
      const double fraction = static_cast<double>(step) / settings.load_steps;
      const char* why = "Newton's method does not converge";
      bool done = false;
      try {
        done = balance(fraction * load, settings, solution);
      } catch (const NumericalError& error) {
        fail(fraction, settings, error.what());
      }
      if (!done) fail(fraction, settings, why);
    }
    return solution;
  }

 private:
  [[noreturn]] void fail(double fraction, const StaticSettings& settings,
                         const std::string& why) const {
    throw NumericalError(fmt::format(
        "{}: no equilibrium between {:.4g} and {:.4g} of the load: {}. Take "
        "more load steps, or expect a limit point there.",
        mesh_.source, fraction - 1.0 / settings.load_steps, fraction, why));
  }

  bool balance(const Matrix3X& load, const StaticSettings& settings,
               StaticSolution& solution) {
    for (int i = 0; i < settings.newton_iterations; ++i) {
      solution.strain_energy =
          solid_.calc_force(solution.u, internal_, workspace_);
      const Matrix3X residual = load - internal_;
      const std::vector<int>& free = tangent_.free_nodes();
      const Matrix3X free_residual = residual(Eigen::all, free);
      if (free_residual.norm() <= settings.tolerance * load.norm()) return true;
      tangent_.factor(solution.u, 0.0);
      const MatrixX correction = tangent_.solve(free_residual.reshaped());
      solution.u(Eigen::all, free) +=
          correction.reshaped(3, free_residual.cols());
      ++solution.newton_iterations;
    }
    return false;
  }

  const Mesh& mesh_;
  SparseMatrix no_mass_;
  NonlinearSolid solid_;
  NonlinearSolid::Workspace workspace_;
  TangentFactor tangent_;
  Matrix3X internal_;
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
