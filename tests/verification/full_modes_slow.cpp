// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "limber/fem/mesh/mesh_reader.hpp"
#include "limber/fem/mesh/node_weights.hpp"
#include "verification/full_beam.hpp"

/// The whole mesh of the reference beam, small motion and large bending.
namespace limber::full_modes_slow {
namespace {

using dynamics::IntegratorKind;
using dynamics::SystemModel;
using dynamics::SystemState;

// --- Small motion is the eigenmodes' ----------------------------------------

// From a mode's shape, u stays Phi times what central differences make of
// cos(omega t): cos(n theta), cos(theta) = 1 - (omega h)^2 / 2, with omega of
// the reference file. At omega t = 4.8 its phase shows.
TEST(FullBeamModes, VibrateAtTheFrequenciesOfTheReference) {
  for (const bool is_clamped : {true, false}) {
    const std::vector<double> lambda = test::reference_eigenvalues(
        "beam579", is_clamped ? "clamped" : "free", 5);
    const test::BeamBodies beam = test::make_beam({}, 4, is_clamped);
    dynamics::SystemBuilder builder;
    builder.add_full_body("beam", beam.reduced, beam.full, {});
    const SystemModel model = builder.build();
    for (const int mode : {0, 3}) {
      const VectorX phi = beam.reduced->rows.Phi_B.col(mode);
      const VectorX start = 1e-8 / phi.lpNorm<Eigen::Infinity>() * phi;
      SystemState state = make_state(model);
      place_nodes(model, start, {}, state);
      const double omega = std::sqrt(lambda[static_cast<std::size_t>(mode)]);
      const double end = 4.8 / omega;
      const double steps = std::ceil(end / 1e-5);
      simulate(model, state,
               {.integrator = IntegratorKind::central_differences,
                .end_time = end,
                .step = end / steps},
               {});
      const double turn = 2.0 * std::asin(0.5 * omega * end / steps);
      // A frequency off by 1e-7 is off by 5e-7 here.
      EXPECT_LT((state.u_H - std::cos(steps * turn) * start).norm(),
                1e-6 * start.norm())
          << (is_clamped ? "clamped " : "free ") << mode;
    }
  }
}

// --- Large bending ----------------------------------------------------------

// tests/data/beam/static.csv, nlgeom: 4e8 N of dead traction across the tip
// bend it by a fifth of its length. Implicit Euler settles there.
TEST(FullBeamStatic, SettlesWhereTheReferenceIsBentByAFifthOfItsLength) {
  const test::BeamBodies beam = test::make_beam({}, 1, true);
  const fem::Mesh mesh = fem::read_mesh(test::beam_file("beam579_v41.msh"));
  const fem::WeightedNodes tip =
      fem::weigh_group(mesh, mesh.groups[fem::find_group(mesh, "tip")]);
  const flexbody::NodeSet set = {"tip", tip.nodes, tip.weights, tip.moments};
  dynamics::SystemBuilder builder;
  builder.add_full_body("beam", beam.reduced, beam.full, {});
  const Vector3 mean = beam.full->x_B(Eigen::all, set.nodes) * set.weights;
  const auto end = builder.attach_nodes("tip", dynamics::BodyIndex(0), set,
                                        {Matrix3::Identity(), mean});
  builder.add_load("traction", end, {4e8, 0.0, 0.0}, Vector3::Zero(),
                   dynamics::LoadFrame::world,
                   dynamics::Table{{0.0, 0.2, 10.0}, {0.0, 1.0, 1.0}});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  place_nodes(model, {}, {}, state);
  const Vector3 start = find_frame_motion(model, state, end).X_WF.p;
  simulate(model, state,
           {.integrator = IntegratorKind::implicit_euler,
            .end_time = 1.0,
            .step = 0.02},
           {});
  const Vector3 expected(0.985989683796, -1.20123498922e-06, -0.118222457447);
  EXPECT_LT(
      (find_frame_motion(model, state, end).X_WF.p - start - expected).norm(),
      1e-8);
}

}  // namespace
}  // namespace limber::full_modes_slow
