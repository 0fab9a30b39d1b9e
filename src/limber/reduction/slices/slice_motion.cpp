// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/slice_motion.hpp"

#include <cmath>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

using Matrix63 = SliceMotion::Contribution;

// Of the motion that moves the faces most; what facets of a round rod have of
// its axis is less, the end face of a slender one more [-].
constexpr double kLeastPressed = 2e-3;

/// Sums over samples: H, and each node's B.
struct Fit {
  Matrix6 H = Matrix6::Zero();
  std::map<int, Matrix63> nodes;

  void add(const SurfaceSample& s, const Vector3& r, const Matrix3& weight) {
    Matrix63 J;  // by (u, theta), transposed
    J << Matrix3::Identity(), skew(r);
    const Matrix63 weighted = J * weight;
    H += weighted * J.transpose();
    for (std::size_t k = 0; k < s.face->nodes.size(); ++k) {
      const auto found =
          nodes.try_emplace(s.face->nodes[k], Matrix63::Zero()).first;
      found->second += s.shape[static_cast<Eigen::Index>(k)] * weighted;
    }
  }
};

}  // namespace

SliceMotion::SliceMotion(const std::vector<const SurfaceSample*>& samples) {
  double area = 0.0;
  for (const SurfaceSample* s : samples) {
    area += s->area;
    centre_ += s->area * s->x;
  }
  centre_ /= area;
  Fit pressed;
  Fit whole;
  double second = 0.0;
  for (const SurfaceSample* s : samples) {
    const Vector3 r = s->x - centre_;
    pressed.add(*s, r, s->area * s->normal * s->normal.transpose());
    whole.add(*s, r, s->area * Matrix3::Identity());
    second += s->area * r.squaredNorm();
  }
  Vector6 scale = Vector6::Ones();
  scale.tail<3>() /= std::sqrt(second / area);
  const Matrix6 scaled = scale.asDiagonal() * pressed.H * scale.asDiagonal();
  const auto [values, vectors] = dense::find_eigenpairs(scaled);
  Matrix6 G = Matrix6::Zero();
  Matrix6 P = Matrix6::Zero();
  for (int k = 0; k < 6; ++k) {
    const Vector6 v = scale.cwiseProduct(vectors.col(k));
    if (values[k] > kLeastPressed * values[5]) {
      G += v * v.transpose() / values[k];
    } else {
      P += v * vectors.col(k).cwiseQuotient(scale).transpose();
    }
  }
  const Matrix6 along = P * dense::find_inverse(whole.H);
  for (const auto& [node, B] : pressed.nodes) {
    nodes_[node] = G * B + along * whole.nodes.at(node);
  }
}

MatrixX SliceMotion::find_motion(const MatrixX& Phi) const {
  MatrixX motion = MatrixX::Zero(6, Phi.cols());
  for (const auto& [node, contribution] : nodes_) {
    motion += contribution * Phi.middleRows<3>(3 * node);
  }
  return motion;
}

MatrixX SliceMotion::find_loads(Eigen::Index nodes) const {
  MatrixX loads = MatrixX::Zero(3 * nodes, 3);
  for (const auto& [node, contribution] : nodes_) {
    loads.middleRows<3>(3 * node) = contribution.topRows<3>().transpose();
  }
  return loads;
}

}  // namespace limber::flexbody
