// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/fem/matrices/matrix_model.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// Models whose mass is that of points on known fields, so that their mass
/// matrix and the integrals over the points are both sums without any formula
/// of limber's.
namespace limber::flexbody::matrices_test {

/// A point of mass m that moves by sum_i N_i (u_i + theta_i x d_i).
struct MassPoint {
  double m = 0.0;          ///< [kg]
  std::vector<int> nodes;  ///< whose motion it follows
  std::vector<double> N;   ///< weights, sum to one
  std::vector<Vector3> d;  ///< from each node [m]; sum N (x + d) = place
};

struct PointModel {
  Matrix3X x;  ///< nodes [m]
  std::vector<MassPoint> points;

  [[nodiscard]] Eigen::Index rows() const { return 6 * x.cols(); }

  /// Displacement of a point per unit of the rows, 3 x 6N.
  [[nodiscard]] MatrixX field(const MassPoint& point) const {
    MatrixX field = MatrixX::Zero(3, rows());
    for (std::size_t i = 0; i < point.nodes.size(); ++i) {
      field.middleCols<3>(6 * point.nodes[i]) +=
          point.N[i] * Matrix3::Identity();
      field.middleCols<3>(6 * point.nodes[i] + 3) -=
          point.N[i] * skew(point.d[i]);
    }
    return field;
  }

  [[nodiscard]] Vector3 place(const MassPoint& point) const {
    Vector3 place = Vector3::Zero();
    for (std::size_t i = 0; i < point.nodes.size(); ++i)
      place += point.N[i] * (x.col(point.nodes[i]) + point.d[i]);
    return place;
  }

  [[nodiscard]] double mass() const {
    double sum = 0.0;
    for (const MassPoint& point : points) sum += point.m;
    return sum;
  }

  [[nodiscard]] Vector3 center() const {
    Vector3 sum = Vector3::Zero();
    for (const MassPoint& point : points) sum += point.m * place(point);
    return sum / mass();
  }

  [[nodiscard]] MatrixX mass_matrix() const {
    MatrixX M = MatrixX::Zero(rows(), rows());
    for (const MassPoint& point : points) {
      const MatrixX F = field(point);
      M += point.m * F.transpose() * F;
    }
    return M;
  }

  /// The integrals as sums over the points, about the centre of mass.
  [[nodiscard]] InertiaShapeIntegrals sum(const MatrixX& Phi) const {
    const auto m = static_cast<std::size_t>(Phi.cols());
    InertiaShapeIntegrals sums;
    sums.S1.assign(m, Matrix3::Zero());
    sums.S2.assign(m * m, Matrix3::Zero());
    sums.P = Matrix3X::Zero(3, Phi.cols());
    for (const MassPoint& point : points) {
      const Vector3 y = place(point) - center();
      const MatrixX u = field(point) * Phi;
      sums.S0 += point.m * y * y.transpose();
      sums.P += point.m * u;
      for (std::size_t k = 0; k < m; ++k) {
        const Vector3 u_k = u.col(static_cast<Eigen::Index>(k));
        sums.S1[k] += point.m * y * u_k.transpose();
        for (std::size_t l = 0; l < m; ++l)
          sums.S2[k * m + l] +=
              point.m * u_k * u.col(static_cast<Eigen::Index>(l)).transpose();
      }
    }
    return sums;
  }
};

/// Random numbers in [-1, 1], the same in every run.
class Draw {
 public:
  double operator()() { return distribution_(random_); }
  Vector3 vector() { return {(*this)(), (*this)(), (*this)()}; }
  MatrixX matrix(Eigen::Index rows, Eigen::Index columns) {
    MatrixX A(rows, columns);
    for (double& value : A.reshaped()) value = (*this)();
    return A;
  }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> distribution_{-1.0, 1.0};
};

/// A model of any matrices, six rows a node; K and M both triangles.
inline fem::MatrixModel make_model(const Matrix3X& x, const MatrixX& K,
                                   const MatrixX& M, int rows_per_node = 6) {
  fem::MatrixModel model;
  model.source = "part";
  model.x = x;
  for (int n = 0; n < x.cols(); ++n) {
    model.tags.push_back(static_cast<std::size_t>(n) + 1);
    for (int c = 0; c < rows_per_node; ++c) model.rows.push_back({n, c});
  }
  model.stiffness = {"part/K.mtx", K.sparseView(), 17};
  model.mass = {"part/M.mtx", M.sparseView(), 17};
  return model;
}

}  // namespace limber::flexbody::matrices_test
