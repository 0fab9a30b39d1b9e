// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/nodal_load.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::nodal_load_test {
namespace {

using testing::make_interface;
using testing::make_point_mass_body;
using testing::PointMassBody;
using testing::share;

/// The same force on each of the nodes 0 to 4, on for a while: as a load on
/// their interface (equal weights) and as nodal forces.
class NodalLoad : public ::testing::Test {
 protected:
  [[nodiscard]] flexbody::NodalLoad nodal() const {
    MatrixX forces = MatrixX::Zero(3 * 12, 2);
    for (int n = 0; n < kNodes; ++n) {
      forces.block<3, 1>(3 * n, 0) = force_ / kNodes;
    }
    return flexbody::reduce_nodal_load(body_.reduced, {0.0, 0.01}, forces);
  }

  [[nodiscard]] SystemState run(Fidelity fidelity, bool as_nodes,
                                EnergyBalance& last) const {
    SystemBuilder builder;
    const auto b = builder.add_flexible_body("b", share(body_), fidelity, {});
    if (as_nodes) {
      builder.add_nodal_load("f", b, nodal());
    } else {
      const auto table = make_interface(body_, 0, kNodes);
      const auto where = builder.attach_interface(
          "i", b, table, {Matrix3::Identity(), table.p_B});
      builder.add_load("f", where, force_, Vector3::Zero(), LoadFrame::body,
                       Pulse{PulseShape::rectangular, 0.0, 0.01});
    }
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].w_WB_B = Vector3(3.0, -2.0, 1.0);
    simulate(model, state,
             {.end_time = 0.05, .step = 1e-4, .output_times = {0.05}},
             [&](const SystemState&, const EnergyBalance& now) { last = now; });
    return state;
  }

  static constexpr int kNodes = 5;
  const PointMassBody body_ = make_point_mass_body(12, 4, 5.0, 1.0, 200.0, 9);
  const Vector3 force_{300.0, -100.0, 50.0};
};

TEST_F(NodalLoad, EqualsTheSameLoadOnAnInterface) {
  for (const Fidelity fidelity :
       {Fidelity::rigid, Fidelity::uncoupled, Fidelity::coupled}) {
    EnergyBalance nodes, interface;
    const SystemState a = run(fidelity, true, nodes);
    const SystemState b = run(fidelity, false, interface);
    constexpr double kRoundOff = 1e-11;
    EXPECT_LT((a.bodies[0].p_WB - b.bodies[0].p_WB).norm(), kRoundOff);
    EXPECT_LT((a.bodies[0].w_WB_B - b.bodies[0].w_WB_B).norm(), 1e-9);
    EXPECT_LT((a.eta - b.eta).norm(), kRoundOff);
    EXPECT_NEAR(nodes.work, interface.work, 1e-9 * interface.work);
    EXPECT_GT(nodes.work, 0.1);
  }
}

TEST_F(NodalLoad, DoesTheWorkThatTheEnergyGains) {
  EnergyBalance last;
  (void)run(Fidelity::coupled, true, last);
  SystemBuilder builder;
  builder.add_flexible_body("b", share(body_), Fidelity::coupled, {});
  const SystemModel model = builder.build();
  SystemState start = make_state(model);
  start.bodies[0].w_WB_B = Vector3(3.0, -2.0, 1.0);
  const double gained = last.total() - calc_energy(model, start).total();
  // The work is a trapezoidal sum, the scheme damps a little (rho_inf 0.9).
  EXPECT_NEAR(gained, last.work, 1e-3 * last.work);
}

TEST_F(NodalLoad, RefusesTimesThatDoNotIncreaseAndValuesThatAreNotFinite) {
  const MatrixX forces = MatrixX::Zero(36, 2);
  EXPECT_THROW(
      (void)flexbody::reduce_nodal_load(body_.reduced, {1.0, 1.0}, forces),
      InputError);
  EXPECT_THROW(
      (void)flexbody::reduce_nodal_load(body_.reduced, {0.0, 1.0},
                                        MatrixX::Constant(36, 2, std::nan(""))),
      InputError);
}

}  // namespace
}  // namespace limber::dynamics::nodal_load_test
