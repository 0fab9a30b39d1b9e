// SPDX-License-Identifier: BSD-3-Clause
#include "support/point_mass_body.hpp"

#include <cstddef>
#include <random>

#include "limber/common/dense/qr.hpp"
#include "support/draw_vector.hpp"

namespace limber::testing {
namespace {

// Integrals of a body whose masses sit at its rows.
void fill_integrals(PointMassBody& body) {
  flexbody::ReducedBody& r = body.reduced;
  const Eigen::Index n = body.masses.size();
  const int m = r.mode_count();
  auto& s = r.integrals;
  s.S0.setZero();
  s.S1.assign(static_cast<std::size_t>(m), Matrix3::Zero());
  const auto count = static_cast<std::size_t>(m);
  s.S2.assign(count * count, Matrix3::Zero());
  s.P = Matrix3X::Zero(3, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3 x = r.rows.x_B.col(i);
    s.S0 += body.masses[i] * x * x.transpose();
    for (int k = 0; k < m; ++k) {
      const Vector3 phi_k = r.rows.Phi_B.block<3, 1>(3 * i, k);
      s.P.col(k) += body.masses[i] * phi_k;
      s.S1[static_cast<std::size_t>(k)] +=
          body.masses[i] * x * phi_k.transpose();
      for (int l = 0; l < m; ++l) {
        const Vector3 phi_l = r.rows.Phi_B.block<3, 1>(3 * i, l);
        s.S2[static_cast<std::size_t>(k) * count +
             static_cast<std::size_t>(l)] +=
            body.masses[i] * phi_k * phi_l.transpose();
      }
    }
  }
}

}  // namespace

PointMassBody make_point_mass_body(int nodes, int modes, double mass,
                                   double length, double lowest,
                                   unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  PointMassBody body;
  flexbody::ReducedBody& r = body.reduced;
  r.name = "points";
  body.masses.resize(nodes);
  for (double& m : body.masses) m = 1.0 + uniform(random);
  body.masses *= mass / body.masses.sum();
  r.mass = mass;
  r.rows.x_B.resize(3, nodes);
  for (int i = 0; i < nodes; ++i) {
    const Vector3 place = draw_vector([&] { return uniform(random); });
    r.rows.x_B.col(i) = length * place.cwiseQuotient(Vector3(3.0, 3.0, 1.0));
    r.rows.tags.push_back(static_cast<std::size_t>(i) + 1);
  }
  const Vector3 center = r.rows.x_B * body.masses / mass;
  r.rows.x_B.colwise() -= center;

  // Columns: sqrt(mass)-weighted rigid modes, then random fields; QR makes the
  // latter orthonormal to each other and to the rigid ones.
  MatrixX basis(3 * nodes, 6 + modes);
  const VectorX root = body.masses.cwiseSqrt();
  for (int i = 0; i < nodes; ++i) {
    const Vector3 x = r.rows.x_B.col(i);
    basis.block<3, 3>(3 * i, 0) = root[i] * Matrix3::Identity();
    for (int a = 0; a < 3; ++a) {
      basis.block<3, 1>(3 * i, 3 + a) = root[i] * Vector3::Unit(a).cross(x);
    }
    for (int k = 0; k < modes; ++k) {
      for (int a = 0; a < 3; ++a) basis(3 * i + a, 6 + k) = uniform(random);
    }
  }
  const MatrixX q = dense::find_q(basis, 6 + modes);
  r.rows.Phi_B.resize(3 * nodes, modes);
  for (int i = 0; i < nodes; ++i) {
    r.rows.Phi_B.middleRows<3>(3 * i) = q.block(3 * i, 6, 3, modes) / root[i];
  }
  r.lambda.resize(modes);
  for (int k = 0; k < modes; ++k) {
    const double omega = lowest * (1.0 + 0.5 * k);
    r.lambda[k] = omega * omega;
  }
  fill_integrals(body);
  return body;
}

flexbody::InterfaceTable make_interface(const PointMassBody& body, int first,
                                        int last) {
  const flexbody::NodeRows& rows = body.reduced.rows;
  const int m = body.reduced.mode_count();
  const double count = last - first;
  flexbody::InterfaceTable table;
  table.Phi_B = Matrix3X::Zero(3, m);
  table.Psi_B = Matrix3X::Zero(3, m);
  for (int i = first; i < last; ++i) {
    table.p_B += rows.x_B.col(i) / count;
    table.Phi_B += rows.Phi_B.middleRows<3>(3 * i) / count;
  }
  Matrix3 inertia = Matrix3::Zero();
  for (int i = first; i < last; ++i) {
    const Vector3 d = rows.x_B.col(i) - table.p_B;
    inertia += d.squaredNorm() * Matrix3::Identity() - d * d.transpose();
    for (int k = 0; k < m; ++k) {
      table.Psi_B.col(k) += d.cross(Vector3(rows.Phi_B.block<3, 1>(3 * i, k)));
    }
  }
  table.Psi_B = inertia.inverse() * table.Psi_B;
  table.rotation_axes = Matrix3::Identity();
  table.node_count = static_cast<std::size_t>(last - first);
  return table;
}

std::shared_ptr<const flexbody::ReducedBody> share(const PointMassBody& body) {
  return std::make_shared<const flexbody::ReducedBody>(body.reduced);
}

}  // namespace limber::testing
