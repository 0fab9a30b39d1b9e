// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/slice_motion.hpp"

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

using Matrix63 = Eigen::Matrix<double, 6, 3>;

// Of displacements along the surface, which no contact sees [-].
constexpr double kAlong = 1e-6;

}  // namespace

SliceMotion::SliceMotion(const std::vector<const SurfaceSample*>& samples) {
  double area = 0.0;
  for (const SurfaceSample* s : samples) {
    area += s->area;
    centre_ += s->area * s->x;
  }
  centre_ /= area;
  MatrixX H = MatrixX::Zero(6, 6);
  for (const SurfaceSample* s : samples) {
    Matrix63 J;  // by (u, theta), transposed
    J << Matrix3::Identity(), skew(s->x - centre_);
    const Matrix3 weight = s->area * (s->normal * s->normal.transpose() +
                                      kAlong * Matrix3::Identity());
    const Matrix63 weighted = J * weight;
    H += weighted * J.transpose();
    for (std::size_t k = 0; k < s->face->nodes.size(); ++k) {
      const auto found =
          nodes_.try_emplace(s->face->nodes[k], Matrix63::Zero()).first;
      found->second += s->shape[static_cast<Eigen::Index>(k)] * weighted;
    }
  }
  const MatrixX inverse = dense::find_inverse(H);
  for (auto& [node, share] : nodes_) share = inverse * share;
}

MatrixX SliceMotion::find_motion(const MatrixX& Phi) const {
  MatrixX motion = MatrixX::Zero(6, Phi.cols());
  for (const auto& [node, share] : nodes_) {
    motion += share * Phi.middleRows<3>(3 * node);
  }
  return motion;
}

MatrixX SliceMotion::find_loads(Eigen::Index nodes) const {
  MatrixX loads = MatrixX::Zero(3 * nodes, 3);
  for (const auto& [node, share] : nodes_) {
    loads.middleRows<3>(3 * node) = share.topRows<3>().transpose();
  }
  return loads;
}

}  // namespace limber::flexbody
