// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/second_order.hpp"

#include <cmath>
#include <numeric>

#include "metamorphic/random_draw.hpp"

namespace limber::metamorphic {
namespace {

MatrixX draw_matrix(RandomDraw& draw, Eigen::Index rows, Eigen::Index columns) {
  MatrixX m(rows, columns);
  for (double& x : m.reshaped()) x = draw.uniform(-1.0, 1.0);
  return m;
}

// Of components (xx, yy, zz, xy, xz, yz).
void reflect_moments(const Matrix3& M, Matrix6X& moments) {
  moments.row(3) *= M(0, 0) * M(1, 1);
  moments.row(4) *= M(0, 0) * M(2, 2);
  moments.row(5) *= M(1, 1) * M(2, 2);
}

}  // namespace

void add_second_order(flexbody::ReducedBody& body, const Matrix3& reflection,
                      double length, unsigned variant) {
  RandomDraw draw(variant);
  const int modes = body.mode_count();
  const Eigen::Index pairs = flexbody::count_pairs(modes);
  const double each = 1.0 / (modes * 0.3 * std::sqrt(body.mass) * length);
  flexbody::QuadraticManifold& manifold = body.manifold.emplace();
  manifold.paired.resize(static_cast<std::size_t>(modes));
  std::iota(manifold.paired.begin(), manifold.paired.end(), 0);
  manifold.Q = each * body.lambda.cwiseSqrt().asDiagonal() *
               draw_matrix(draw, modes, pairs);
  manifold.self.resize(0, pairs);
  manifold.S2 = 0.3 * draw_matrix(draw, 6, pairs);
  reflect_moments(reflection, manifold.S2);
  const double rows = body.rows.Phi_B.cwiseAbs().maxCoeff();
  manifold.Theta_B =
      each * rows * draw_matrix(draw, body.rows.Phi_B.rows(), pairs);
  for (Eigen::Index n = 0; n < manifold.Theta_B.rows(); n += 3) {
    manifold.Theta_B.middleRows<3>(n) =
        reflection * manifold.Theta_B.middleRows<3>(n);
  }
  const double turn = reflection.determinant();  // rotations are axial
  for (flexbody::InterfaceTable& table : body.interfaces) {
    table.Phi2_B = each * table.Phi_B.cwiseAbs().maxCoeff() * reflection *
                   draw_matrix(draw, 3, pairs);
    table.Psi2_B = each * table.Psi_B.cwiseAbs().maxCoeff() * turn *
                   reflection * draw_matrix(draw, 3, pairs);
  }
}

}  // namespace limber::metamorphic
