// SPDX-License-Identifier: BSD-3-Clause
#include "support/full_lattice.hpp"

#include <random>

#include "limber/common/rotation.hpp"

namespace limber::testing {

VectorX make_field(Eigen::Index size, double scale, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return VectorX::NullaryExpr(size, [&] { return uniform(random); });
}

Lattice::Lattice(const LatticeOptions& options,
                 const dynamics::ModalDamping& damping, int modes)
    : network(make_lattice(options)),
      full(make_full(network)),
      reduced(make_reduced(network, modes)) {
  builder.add_full_body("lattice", reduced, full, damping);
}

dynamics::SystemState stir(const dynamics::SystemModel& model) {
  dynamics::SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(1, 2, 3);
  state.bodies[0].quat_WB = exp_quaternion(Vector3(2.0, -1.0, 0.5));
  state.bodies[0].v_WB_W = Vector3(0.5, -1.0, 0.3);
  state.bodies[0].w_WB_B = Vector3(3.0, 1.0, -2.0);
  place_nodes(model, make_field(model.nodal_count, 0.02, 1),
              make_field(model.nodal_count, 1.0, 2), state);
  return state;
}

}  // namespace limber::testing
