// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/state_balance.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/fem/solid/surface_matrix.hpp"

namespace limber::flexbody {

NetLoad sum_load(const Matrix3X& x, const Matrix3X& load,
                 const Vector3& about) {
  NetLoad net;
  net.force = load.rowwise().sum();
  for (Eigen::Index n = 0; n < x.cols(); ++n)
    net.moment += Vector3(x.col(n) - about).cross(Vector3(load.col(n)));
  return net;
}

void check_load(const MeshedBody& body, const Matrix3X& load) {
  LIMBER_EXPECT(load.cols() == body.mesh.x.cols());
  if (!load.allFinite())
    throw InputError(
        fmt::format("{}: a nodal force is not finite; expected numbers [N].",
                    body.mesh.source));
  if (load.isZero(0.0))
    throw InputError(fmt::format(
        "{}: no load: the operating state is trivial, the body undeformed and "
        "at rest. Expected a nodal force other than 0.",
        body.mesh.source));
}

void fill_state(const MeshedBody& body, const VectorX& x, const Matrix3X& load,
                OperatingState& state) {
  const Support& support = body.support;
  const Eigen::Index nodes = body.mesh.x.cols();
  const MatrixX Kx = fem::multiply_stiffness(support.matrices, x);
  state.u = put_rows(x, support.free_nodes, nodes).reshaped(3, nodes);
  state.internal_force =
      put_rows(Kx, support.free_nodes, nodes).reshaped(3, nodes);
  state.strain_energy = 0.5 * x.dot(Kx.col(0));
  const fem::LargestGradient gradient =
      fem::calc_largest_gradient(body.mesh, state.u);
  state.trust = {std::sqrt(state.u.colwise().squaredNorm().maxCoeff()) /
                     body.mesh.size().maxCoeff(),
                 gradient.strain, gradient.rotation};
  const fem::MassProperties mass =
      fem::calc_mass_properties(body.M_s, body.mesh.x);
  const NetLoad net = sum_load(body.mesh.x, load, mass.center);
  state.support_force = -net.force;
  state.support_moment = -net.moment;
}

}  // namespace limber::flexbody
