// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/ball_on_surface.hpp"

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
using SurfacePointer = std::shared_ptr<const MeshSurface>;

Vector3 find_displacement(const MeshSurface& mesh_surface,
                          const SurfacePlace& place, const ModalView& eta) {
  return mesh_surface.find_position(place, eta) - place.x_B;
}

}  // namespace

bool BallOnSurface::suits(const ContactSide& ball,
                          const ContactSide& mesh_surface) {
  const bool is_mesh =
      !mesh_surface.bodies.empty() && mesh_surface.slices.empty();
  return std::holds_alternative<Sphere>(ball.shape.kind) && !is_mesh &&
         std::holds_alternative<SurfacePointer>(mesh_surface.shape.kind);
}

BallOnSurface::BallOnSurface(const ContactSide& A, const ContactSide& B,
                             double modulus, std::optional<double> radius)
    : is_surface_A_(suits(B, A)),
      mesh_surface_(
          std::get<SurfacePointer>((is_surface_A_ ? A : B).shape.kind)),
      ball_radius_(std::get<Sphere>((is_surface_A_ ? B : A).shape.kind).radius),
      centre_B_((is_surface_A_ ? B : A).shape.X_BS.p),
      modulus_(modulus),
      radius_(radius),
      most_radius_(find_roundness(A.shape, B.shape)) {
  check_shape(A.shape);
  check_shape(B.shape);
}

void BallOnSurface::check(int modes_A, int modes_B) const {
  const int modes = is_surface_A_ ? modes_A : modes_B;
  const int own = mesh_surface_->mode_count();
  if (own == 0 || own == modes) return;
  throw InputError(fmt::format(
      "contact: a surface has {} modes and its body {}; expected as many", own,
      modes));
}

Vector3 BallOnSurface::find_centre_W(const PairBodies& bodies) const {
  const PairBody& ball = is_surface_A_ ? bodies.B : bodies.A;
  return ball.p_WB + ball.R_WB * centre_B_;
}

std::optional<MeshSurface::Hit> BallOnSurface::find_hit(
    const PairBodies& bodies, double reach) const {
  const PairBody& body = find_body(bodies);
  const Vector3 centre =
      body.R_WB.transpose() * (find_centre_W(bodies) - body.p_WB);
  return mesh_surface_->find_nearest(
      centre, find_modal_coordinates(*mesh_surface_, body),
      ball_radius_ + reach, ball_radius_);
}

// The body, moved by the modes at the place.
PairBody BallOnSurface::find_motion(const PairBody& body,
                                    const SurfacePlace& place) const {
  PairBody part = body;
  part.modes = 0;
  part.eta = part.etadot = nullptr;
  if (mesh_surface_->mode_count() == 0) return part;
  const Vector3 u =
      find_displacement(*mesh_surface_, place, {body.eta, body.modes});
  part.p_WB += body.R_WB * u;
  if (body.etadot == nullptr) return part;
  const Vector3 rate =
      find_displacement(*mesh_surface_, place, {body.etadot, body.modes});
  part.v_WB_W += body.R_WB * (body.w_WB_B.cross(u) + rate);
  return part;
}

void BallOnSurface::set_frames(const PairBodies& bodies,
                               const SurfacePlace& place, PairBody& A,
                               PairBody& B) const {
  A = bodies.A;
  B = bodies.B;
  (is_surface_A_ ? A : B) = find_motion(find_body(bodies), place);
  (is_surface_A_ ? B : A).modes = 0;
}

Patch BallOnSurface::press(const PairBody& body,
                           const MeshSurface::Hit& hit) const {
  Patch out;
  const double depth = ball_radius_ - hit.nearest.distance;
  if (depth <= 0.0) return out;  // not of NaN
  const double curvature = 1.0 / ball_radius_ + hit.nearest.curvature;
  const double R_e =
      radius_.value_or(1.0 / std::max(curvature, 1.0 / most_radius_));
  const HertzLaw law({find_hertz_stiffness(modulus_, R_e),
                      mesh_surface_->find_residual(hit.place)});
  const HertzLaw::Response pressed = law.evaluate(depth);
  const Vector3 out_W = body.R_WB * hit.nearest.normal;
  const Vector3 n = is_surface_A_ ? out_W : Vector3(-out_W);
  out.touches = true;
  out.exponent = 1.5;
  out.depth = depth;
  out.series_depth = depth - pressed.hertz_depth;
  out.energy = pressed.energy();
  out.series_energy = pressed.residual_energy;
  out.centre_W =
      body.p_WB + body.R_WB * hit.nearest.point - 0.5 * depth * out_W;
  out.gradient_W.head<3>() = -pressed.force * n;
  out.hessian_W.topLeftCorner<3, 3>() = pressed.stiffness * n * n.transpose();
  out.spread_W = 0.2 * R_e * pressed.hertz_depth *
                 (Matrix3::Identity() - n * n.transpose());
  (is_surface_A_ ? out.turns_B_W : out.turns_A_W).setZero();
  return out;
}

PatchTouches BallOnSurface::find_patches(const PairBodies& bodies,
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

void BallOnSurface::set_places(const PairBodies& bodies,
                               const PatchTouch& touch, const Vector3& place_W,
                               joints::PairPoint& out) const {
  const auto find_arm = [&](const PairBody& body) -> Vector3 {
    return body.R_WB.transpose() * (place_W - body.p_WB);
  };
  out.on_A.x_B = find_arm(bodies.A);
  out.on_B.x_B = find_arm(bodies.B);
  if (mesh_surface_->mode_count() == 0) return;
  joints::PairPlace& on_surface = is_surface_A_ ? out.on_A : out.on_B;
  const PairBody& body = find_body(bodies);
  mesh_surface_->set_shape_functions(touch.place, on_surface.Phi_B);
  on_surface.x_B -=
      find_displacement(*mesh_surface_, touch.place, {body.eta, body.modes});
}

PatchFinder::Nearest BallOnSurface::find_nearest(
    const PairBodies& bodies) const {
  const auto hit = find_hit(bodies, std::numeric_limits<double>::infinity());
  Nearest nearest{0, {}, bodies.A, bodies.B};
  if (!hit) {  // behind an open surface
    nearest.gap.distance = find_distance(bodies);
    return nearest;
  }
  set_frames(bodies, hit->place, nearest.A, nearest.B);
  const PairBody& body = find_body(bodies);
  const Vector3 out_W = body.R_WB * hit->nearest.normal;
  const Vector3 on_surface = body.p_WB + body.R_WB * hit->nearest.point;
  const Vector3 on_ball = find_centre_W(bodies) - ball_radius_ * out_W;
  nearest.gap = {is_surface_A_ ? out_W : Vector3(-out_W),
                 is_surface_A_ ? on_surface : on_ball,
                 is_surface_A_ ? on_ball : on_surface,
                 hit->nearest.distance - ball_radius_};
  return nearest;
}

double BallOnSurface::find_distance(const PairBodies& bodies) const {
  const PairBody& body = find_body(bodies);
  return mesh_surface_->find_clearance(
      body.R_WB.transpose() * (find_centre_W(bodies) - body.p_WB), ball_radius_,
      find_modal_coordinates(*mesh_surface_, body));
}

}  // namespace limber::contact
