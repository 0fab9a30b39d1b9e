// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_part.hpp"

#include <fmt/format.h>

#include <limits>
#include <type_traits>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/contact/shapes/shape_properties.hpp"

namespace limber::contact {
namespace {

Pose find_frame(const Vector3& normal) {
  Pose X;
  X.R.col(2) = normal;
  X.R.col(0) = normal.unitOrthogonal();
  X.R.col(1) = normal.cross(Vector3(X.R.col(0)));
  return X;
}

Matrix3X find_corners(const flexbody::ContactPart& part, const Pose& X_PS) {
  return X_PS.R.transpose() * (part.corners_B.colwise() - part.centre_B);
}

}  // namespace

PatchPart::PatchPart(const PlacedBody& body) : body_(body) {
  if (solid() == nullptr) {
    shape_ = std::visit(
        [&](const auto& kind) {
          using Kind = std::decay_t<decltype(kind)>;
          if constexpr (std::is_same_v<Kind, ConvexSolid>)
            return Shape{};
          else
            return Shape{kind, body.X_BS};
        },
        body.kind);
    ball_ = {body.X_BS.p, find_extent({shape_->kind, {}}, {})};
  } else if (solid()->is_bounded()) {
    ball_ = {body.X_BS * solid()->ball().centre, solid()->ball().radius};
  } else {
    ball_ = {body.X_BS.p, std::numeric_limits<double>::infinity()};
  }
}

PatchPart::PatchPart(const flexbody::ContactPart& part, double flexibility)
    : PatchPart(PlacedBody{
          ConvexSolid::make_slab(find_corners(part, find_frame(part.normal_B)),
                                 part.rim, part.depth),
          find_frame(part.normal_B)}) {
  centre_B_ = part.centre_B;
  motion_B_ = part.motion_B;
  flexibility_ = flexibility * part.normal_B * part.normal_B.transpose();
}

PatchPart::PatchPart(const flexbody::ContactSlice& slice,
                     const PlacedBody& body)
    : PatchPart(PlacedBody{
          body.kind, Pose{Matrix3::Identity(), -slice.centre_B} * body.X_BS}) {
  centre_B_ = slice.centre_B;
  motion_B_ = slice.motion_B;
  flexibility_ = slice.flexibility_B;
}

void PatchPart::check(int modes) const {
  if (!is_flexible() || motion_B_.cols() == modes) return;
  throw InputError(
      fmt::format("contact: a surface of {} modes is on a body of {}",
                  motion_B_.cols(), modes));
}

Vector6 PatchPart::move(const double* eta) const {
  return motion_B_ * Eigen::Map<const VectorX>(eta, motion_B_.cols());
}

joints::PairBody PatchPart::find_motion(const joints::PairBody& body) const {
  joints::PairBody part;
  Vector6 motion = Vector6::Zero();
  Vector6 rate = Vector6::Zero();
  if (is_flexible()) {
    motion = move(body.eta);
    if (body.etadot != nullptr) rate = move(body.etadot);
  }
  const Vector3 arm = centre_B_ + motion.head<3>();
  const Vector3 turn = motion.tail<3>();
  const Matrix3 R_BP = exp_rotation(turn);
  const Vector3 spin = body.w_WB_B + left_jacobian(turn) * rate.tail<3>();
  part.R_WB = body.R_WB * R_BP;
  part.p_WB = body.p_WB + body.R_WB * arm;
  part.v_WB_W =
      body.v_WB_W + body.R_WB * (body.w_WB_B.cross(arm) + rate.head<3>());
  part.w_WB_B = R_BP.transpose() * spin;
  return part;
}

void PatchPart::set_place(const joints::PairBody& body, const Vector3& p_W,
                          joints::PairPlace& out) const {
  const Vector3 arm = body.R_WB.transpose() * (p_W - body.p_WB);
  out.x_B = arm;
  if (!is_flexible()) return;
  const Vector6 motion = move(body.eta);
  const Vector3 r = arm - centre_B_ - motion.head<3>();
  const Matrix3 by_turn = -skew(r) * left_jacobian(motion.tail<3>());
  out.Phi_B = motion_B_.topRows<3>();
  out.Phi_B.noalias() += by_turn.lazyProduct(motion_B_.bottomRows<3>());
  out.x_B.noalias() -= out.Phi_B.lazyProduct(
      Eigen::Map<const VectorX>(body.eta, out.Phi_B.cols()));
}

}  // namespace limber::contact
