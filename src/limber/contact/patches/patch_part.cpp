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
  if (nodes_ != nullptr && nodes_->least_coordinates() <= modes) return;
  throw InputError(fmt::format(
      "contact: a surface has {} modes and its body {}; expected as many",
      motion_B_.cols(), modes));
}

Vector6 PatchPart::move(const double* eta) const {
  return motion_B_ * Eigen::Map<const VectorX>(eta, motion_B_.cols());
}

PatchPart::Motion PatchPart::find_own_motion(
    const joints::PairBody& body) const {
  Motion out;
  if (!is_flexible()) return out;
  if (nodes_ != nullptr) {
    const NodalMotion::State state = nodes_->find_state(body.eta);
    out.X = state.X;
    if (body.etadot != nullptr) {
      out.rate = nodes_->find_rate(state, body.etadot);
    }
    return out;
  }
  const Vector6 motion = move(body.eta);
  const Vector3 rotation = motion.tail<3>();
  out.X = {exp_rotation(rotation), motion.head<3>()};
  if (body.etadot == nullptr) return out;
  const Vector6 rate = move(body.etadot);
  out.rate << out.X.R.transpose() * rate.head<3>(),
      out.X.R.transpose() * (left_jacobian(rotation) * rate.tail<3>());
  return out;
}

joints::PairBody PatchPart::find_motion(const joints::PairBody& body) const {
  const Motion own = find_own_motion(body);
  const Vector3 arm = centre_B_ + own.X.p;
  joints::PairBody part;
  part.R_WB = body.R_WB * own.X.R;
  part.p_WB = body.p_WB + body.R_WB * arm;
  part.v_WB_W = body.v_WB_W + body.R_WB * (body.w_WB_B.cross(arm) +
                                           own.X.R * own.rate.head<3>());
  part.w_WB_B = own.X.R.transpose() * body.w_WB_B + own.rate.tail<3>();
  return part;
}

void PatchPart::set_modal_rows(const joints::PairBody& body, const Vector3& arm,
                               Matrix3X& out) const {
  const Vector6 motion = move(body.eta);
  const Vector3 r = arm - centre_B_ - motion.head<3>();
  const Matrix3 by_rotation = -skew(r) * left_jacobian(motion.tail<3>());
  out = motion_B_.topRows<3>();
  out.noalias() += by_rotation.lazyProduct(motion_B_.bottomRows<3>());
}

void PatchPart::set_place(const joints::PairBody& body, const Vector3& p_W,
                          joints::PairPlace& out) const {
  const Vector3 arm = body.R_WB.transpose() * (p_W - body.p_WB);
  out.x_B = arm;
  if (!is_flexible()) return;
  if (nodes_ != nullptr) {
    const NodalMotion::State state = nodes_->find_state(body.eta);
    nodes_->set_rows(state, state.X.inverse() * (arm - centre_B_), out.Phi_B);
  } else {
    set_modal_rows(body, arm, out.Phi_B);
  }
  out.x_B.noalias() -= out.Phi_B.lazyProduct(
      Eigen::Map<const VectorX>(body.eta, out.Phi_B.cols()));
}

}  // namespace limber::contact
