// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/ball_on_skin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/law/hertz_law.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/contact/shapes/shape_properties.hpp"

namespace limber::contact {
namespace {

using joints::PairBodies;
using joints::PairBody;
using SkinPointer = std::shared_ptr<const Skin>;

Vector3 find_displacement(const Skin& skin, const SurfacePlace& place,
                          const ModalView& eta) {
  return skin.find_position(place, eta) - place.x_B;
}

}  // namespace

bool BallOnSkin::suits(const ContactSide& ball, const ContactSide& skin) {
  const bool is_mesh = !skin.bodies.empty() && skin.slices.empty();
  return std::holds_alternative<Sphere>(ball.shape.kind) && !is_mesh &&
         std::holds_alternative<SkinPointer>(skin.shape.kind);
}

BallOnSkin::BallOnSkin(const ContactSide& A, const ContactSide& B,
                       double modulus, std::optional<double> radius)
    : is_skin_A_(suits(B, A)),
      skin_(std::get<SkinPointer>((is_skin_A_ ? A : B).shape.kind)),
      ball_radius_(std::get<Sphere>((is_skin_A_ ? B : A).shape.kind).radius),
      centre_B_((is_skin_A_ ? B : A).shape.X_BS.p),
      modulus_(modulus),
      radius_(radius),
      most_radius_(find_roundness(A.shape, B.shape)) {
  check_shape(A.shape);
  check_shape(B.shape);
}

void BallOnSkin::check(int modes_A, int modes_B) const {
  const int modes = is_skin_A_ ? modes_A : modes_B;
  const int own = skin_->mode_count();
  if (own == 0 || own == modes) return;
  throw InputError(fmt::format(
      "contact: a surface has {} modes and its body {}; expected as many", own,
      modes));
}

Vector3 BallOnSkin::find_centre_W(const PairBodies& bodies) const {
  const PairBody& ball = is_skin_A_ ? bodies.B : bodies.A;
  return ball.p_WB + ball.R_WB * centre_B_;
}

std::optional<Skin::Hit> BallOnSkin::find_hit(const PairBodies& bodies,
                                              double reach) const {
  const PairBody& body = find_body(bodies);
  const Vector3 centre =
      body.R_WB.transpose() * (find_centre_W(bodies) - body.p_WB);
  return skin_->find_nearest(centre, find_modal_coordinates(*skin_, body),
                             ball_radius_ + reach, ball_radius_);
}

// The body, moved by the modes at the place.
PairBody BallOnSkin::find_motion(const PairBody& body,
                                 const SurfacePlace& place) const {
  PairBody part = body;
  part.modes = 0;
  part.eta = part.etadot = nullptr;
  if (skin_->mode_count() == 0) return part;
  const Vector3 u = find_displacement(*skin_, place, {body.eta, body.modes});
  part.p_WB += body.R_WB * u;
  if (body.etadot == nullptr) return part;
  const Vector3 rate =
      find_displacement(*skin_, place, {body.etadot, body.modes});
  part.v_WB_W += body.R_WB * (body.w_WB_B.cross(u) + rate);
  return part;
}

void BallOnSkin::set_frames(const PairBodies& bodies, const SurfacePlace& place,
                            PairBody& A, PairBody& B) const {
  A = bodies.A;
  B = bodies.B;
  (is_skin_A_ ? A : B) = find_motion(find_body(bodies), place);
  (is_skin_A_ ? B : A).modes = 0;
}

Patch BallOnSkin::press(const PairBody& body, const Skin::Hit& hit) const {
  Patch out;
  const double depth = ball_radius_ - hit.nearest.distance;
  if (depth <= 0.0) return out;  // not of NaN
  const double curvature = 1.0 / ball_radius_ + hit.nearest.curvature;
  const double R_e =
      radius_.value_or(1.0 / std::max(curvature, 1.0 / most_radius_));
  const HertzLaw law(
      {find_hertz_stiffness(modulus_, R_e), skin_->find_residual(hit.place)});
  const HertzLaw::Response pressed = law.evaluate(depth);
  const Vector3 out_W = body.R_WB * hit.nearest.normal;
  const Vector3 n = is_skin_A_ ? out_W : Vector3(-out_W);
  out.touches = true;
  out.exponent = 1.5;
  out.depth = depth;
  out.energy = pressed.energy();
  out.centre_W =
      body.p_WB + body.R_WB * hit.nearest.point - 0.5 * depth * out_W;
  out.gradient_W.head<3>() = -pressed.force * n;
  out.hessian_W.topLeftCorner<3, 3>() = pressed.stiffness * n * n.transpose();
  out.spread_W = 0.2 * R_e * pressed.hertz_depth *
                 (Matrix3::Identity() - n * n.transpose());
  (is_skin_A_ ? out.turns_B_W : out.turns_A_W).setZero();
  return out;
}

PatchTouches BallOnSkin::find_patches(const PairBodies& bodies,
                                      bool /*has_derivatives*/) const {
  PatchTouches touches;
  const auto hit = find_hit(bodies, 0.0);
  if (!hit) return touches;
  PatchTouch touch;
  touch.patch = press(find_body(bodies), *hit);
  if (!touch.patch.touches) return touches;
  touch.place = hit->place;
  set_frames(bodies, hit->place, touch.A, touch.B);
  touches.add(touch);
  return touches;
}

void BallOnSkin::set_places(const PairBodies& bodies, const PatchTouch& touch,
                            const Vector3& place_W,
                            joints::PairPoint& out) const {
  const auto find_arm = [&](const PairBody& body) -> Vector3 {
    return body.R_WB.transpose() * (place_W - body.p_WB);
  };
  out.on_A.x_B = find_arm(bodies.A);
  out.on_B.x_B = find_arm(bodies.B);
  if (skin_->mode_count() == 0) return;
  joints::PairPlace& on_skin = is_skin_A_ ? out.on_A : out.on_B;
  const PairBody& body = find_body(bodies);
  skin_->set_shape_functions(touch.place, on_skin.Phi_B);
  on_skin.x_B -= find_displacement(*skin_, touch.place, {body.eta, body.modes});
}

PatchFinder::Nearest BallOnSkin::find_nearest(const PairBodies& bodies) const {
  const auto hit = find_hit(bodies, std::numeric_limits<double>::infinity());
  Nearest nearest{0, {}, bodies.A, bodies.B};
  if (!hit) {  // behind an open surface
    nearest.gap.distance = find_distance(bodies);
    return nearest;
  }
  set_frames(bodies, hit->place, nearest.A, nearest.B);
  const PairBody& body = find_body(bodies);
  const Vector3 out_W = body.R_WB * hit->nearest.normal;
  const Vector3 on_skin = body.p_WB + body.R_WB * hit->nearest.point;
  const Vector3 on_ball = find_centre_W(bodies) - ball_radius_ * out_W;
  nearest.gap = {is_skin_A_ ? out_W : Vector3(-out_W),
                 is_skin_A_ ? on_skin : on_ball, is_skin_A_ ? on_ball : on_skin,
                 hit->nearest.distance - ball_radius_};
  return nearest;
}

double BallOnSkin::find_distance(const PairBodies& bodies) const {
  const PairBody& body = find_body(bodies);
  return skin_->find_clearance(
      body.R_WB.transpose() * (find_centre_W(bodies) - body.p_WB), ball_radius_,
      find_modal_coordinates(*skin_, body));
}

}  // namespace limber::contact
