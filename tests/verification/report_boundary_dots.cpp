// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "limber/dynamics/equations/node_motion.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "verification/body_reference.hpp"

/// Simulated dots of the report's Figure 9: the free beam with ten modes turns
/// at Omega about x and is given alpha about x by a couple on its end faces.
/// The error of `uncoupled` is the largest root mean square difference in
/// deformation from `coupled` over all nodes. bench/report has the whole sweep.
namespace limber::report_boundary_dots {
namespace {

using dynamics::Fidelity;
using Body = std::shared_ptr<const flexbody::ReducedBody>;

/// The report's boundaries on |alpha| + |Omega|^2 [1/s^2].
constexpr double kMicrometre = 1.19;
constexpr double kFiveCentimetres = 59570.0;
constexpr double kEnd = 0.015;  // almost three periods of the first mode [s]

const Body& beam() {
  static const Body body = [] {
    flexbody::Recipe recipe = test::beam_recipe("beam579_v41.msh");
    recipe.basis.eigenmodes = 10;
    recipe.rows.extent = flexbody::KeptRows::Extent::all;
    return std::make_shared<const flexbody::ReducedBody>(
        flexbody::reduce(recipe));
  }();
  return body;
}

/// Equal forces along -y on the nodes of z = 5 and along y on those of z = 0,
/// of moment J alpha about x.
MatrixX make_couple(const flexbody::ReducedBody& body, double alpha) {
  MatrixX force = MatrixX::Zero(body.rows.x_B.size(), 1);
  double moment = 0.0;
  for (Eigen::Index n = 0; n < body.rows.x_B.cols(); ++n) {
    const double z = body.rows.x_B(2, n);
    if (std::abs(std::abs(z) - 2.5) > 1e-6) continue;
    force(3 * n + 1, 0) = z > 0.0 ? -1.0 : 1.0;
    moment += std::abs(z);
  }
  return force * (alpha * body.inertia()(0, 0) / moment);
}

MatrixX simulate_deformation(Fidelity level, double alpha, double Omega) {
  dynamics::SystemBuilder builder;
  const auto index = builder.add_flexible_body("beam", beam(), level, {});
  builder.add_nodal_load(
      "couple", index,
      flexbody::reduce_nodal_load(*beam(), {0.0}, make_couple(*beam(), alpha)));
  const auto model = builder.build();
  dynamics::SystemState state = make_state(model);
  state.bodies[0].w_WB_B = Omega * Vector3::UnitX();
  dynamics::SimulationSettings settings{
      .integrator = dynamics::IntegratorKind::runge_kutta_4,
      .end_time = kEnd,
      .step = 5e-5,
      .output_times = {}};
  for (int i = 0; i <= 100; ++i)
    settings.output_times.push_back(kEnd * i / 100.0);
  std::vector<dynamics::SystemState> states;
  simulate(model, state, settings,
           [&](const dynamics::SystemState& now,
               const dynamics::EnergyBalance&) { states.push_back(now); });
  // Rigid about a principal axis; `coupled` slows down as the beam stretches.
  if (level == Fidelity::uncoupled) {
    EXPECT_NEAR(states.back().bodies[0].w_WB_B[0] / (Omega + alpha * kEnd), 1.0,
                1e-9);
  }
  MatrixX u(beam()->rows.x_B.size(), std::ssize(states));
  calc_node_deformations(model, index, states, u);
  return u;
}

/// Error of `uncoupled` [m].
double find_difference(double alpha, double Omega) {
  const MatrixX d = simulate_deformation(Fidelity::coupled, alpha, Omega) -
                    simulate_deformation(Fidelity::uncoupled, alpha, Omega);
  const Eigen::Index nodes = d.rows() / 3;
  return d.colwise().norm().maxCoeff() / std::sqrt(nodes);
}

/// The start at which the run ends on the boundary, from that alpha.
double find_omega(double alpha, double boundary) {
  return std::sqrt(boundary - alpha) - alpha * kEnd;
}

TEST(ReportBoundaryDots, NoneBelowTheBoundaryDiffersByMore) {
  for (const double fraction : {0.0, 0.5, 0.95}) {
    const double near = fraction * kMicrometre;
    EXPECT_LT(find_difference(near, find_omega(near, kMicrometre)), 1e-6)
        << "alpha " << near;
  }
  for (const double alpha : {0.0, 100.0, 5000.0}) {
    EXPECT_LT(find_difference(alpha, find_omega(alpha, kFiveCentimetres)), 0.05)
        << "alpha " << alpha;
  }
}

// The report's boundary is cautious by up to four in Omega^2 (its own remark,
// and docs/theory/choosing.md), not by more.
TEST(ReportBoundaryDots, AtFiveTimesTheBoundaryTheyDifferByMore) {
  EXPECT_GT(find_difference(0.0, std::sqrt(5.0 * kMicrometre)), 1e-6);
  EXPECT_GT(find_difference(0.0, std::sqrt(5.0 * kFiveCentimetres)), 0.05);
}

}  // namespace
}  // namespace limber::report_boundary_dots
