// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_points.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::contact {
PatchPoints::PatchPoints(const Vector3& centre_W, const Vector3& normal_W,
                         double radius)
    : centre_W_(centre_W) {
  LIMBER_EXPECT(radius > 0.0);
  const Vector3 u = normal_W.unitOrthogonal();
  const Vector3 v = normal_W.cross(u);
  const double half = 0.5 * std::sqrt(3.0);
  arms_W_ = {radius * u, radius * (-0.5 * u + half * v),
             radius * (-0.5 * u - half * v)};
  // J = 3/2 R^2 (1 + n n')
  const double fraction = 2.0 / (3.0 * radius * radius);
  const Matrix3 inverse =
      fraction * (Matrix3::Identity() - 0.5 * normal_W * normal_W.transpose());
  for (std::size_t i = 0; i < kCount; ++i) {
    motions_[i] << Matrix3::Identity() / 3.0, inverse * skew(arms_W_[i]);
  }
}

std::array<Vector3, PatchPoints::kCount> PatchPoints::places_W() const {
  std::array<Vector3, kCount> places;
  for (std::size_t i = 0; i < kCount; ++i) places[i] = centre_W_ + arms_W_[i];
  return places;
}

void PatchPoints::set(const PatchWrench& patch, std::size_t first,
                      joints::PairResponse& out) const {
  for (std::size_t i = 0; i < kCount; ++i) {
    joints::PairPoint& point = out.points()[first + i];
    const auto Ti = motions_[i].transpose();
    point.force_W = Ti * patch.wrench_W;
    for (std::size_t j = 0; j < kCount; ++j) {
      const Matrix3 K = Ti * patch.stiffness_W * motions_[j];
      const Matrix3 C = Ti * patch.damping_W * motions_[j];
      if (j == i) {
        point.stiffness = K;
        point.damping = C;
      } else {
        out.coupling(first + i, first + j) = K;
        out.damping_coupling(first + i, first + j) = C;
      }
    }
  }
}

Vector6 PatchPoints::find_motion(
    const std::array<Vector3, kCount>& displacements) const {
  Vector6 motion = Vector6::Zero();
  for (std::size_t i = 0; i < kCount; ++i) {
    motion += motions_[i] * displacements[i];
  }
  return motion;
}

}  // namespace limber::contact
