// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/contact_relations.hpp"

#include <cmath>
#include <utility>
#include <variant>

namespace limber::metamorphic {
namespace {

constexpr double kUnit = 1000.0;  // of a metre

using Answer = std::optional<ChangedContact>;

bool is_free(const ContactPlan& plan) { return !plan.bodies[1].is_world(); }

Answer exchange_sides(const ContactPlan& plan, RandomDraw&) {
  ChangedContact changed{.plan = plan};
  changed.plan.is_swapped = true;
  return changed;
}

Answer exchange_order(const ContactPlan& plan, RandomDraw&) {
  ChangedContact changed{.plan = plan};
  changed.plan.is_reversed = true;
  return changed;
}

// The strike as a whole moved by a pose, what is of the world as well.
Answer move_by(const ContactPlan& plan, const Pose& X) {
  ChangedContact changed{.plan = plan};
  for (StrikingBody& body : changed.plan.bodies) {
    if (body.is_world()) {
      body.shape.X_BS = X * body.shape.X_BS;
      continue;
    }
    body.X_WB = X * body.X_WB;
    body.v_WB_W = X.R * body.v_WB_W;
  }
  changed.plan.gravity_W = X.R * plan.gravity_W;
  changed.place = X.p.norm();
  changed.undo = [back = X.inverse()](Strike::Body& body) {
    body.X_WB = back * body.X_WB;
    body.v_WB_W = back.R * body.v_WB_W;
  };
  return changed;
}

Answer rotate_strike(const ContactPlan& plan, RandomDraw& draw) {
  return move_by(plan, {draw.rotation(), Vector3::Zero()});
}

Answer shift_strike(const ContactPlan& plan, RandomDraw& draw) {
  return move_by(plan, {Matrix3::Identity(), 1e3 * draw.direction()});
}

Answer boost_strike(const ContactPlan& plan, RandomDraw& draw) {
  if (!is_free(plan)) return {};
  constexpr double kSpeed = 100.0;
  const Vector3 v = kSpeed * draw.direction();
  ChangedContact changed{.plan = plan};
  for (StrikingBody& body : changed.plan.bodies) body.v_WB_W += v;
  changed.speed = kSpeed;
  changed.place = kSpeed * plan.settings.end_time;
  changed.undo = [v, t = plan.settings.end_time](Strike::Body& body) {
    body.X_WB.p -= t * v;
    body.v_WB_W -= v;
  };
  return changed;
}

// y reversed in the world, in every body and in every shape, each of which is
// its own image.
Answer mirror_strike(const ContactPlan& plan, RandomDraw&) {
  const Matrix3 M = Vector3(1.0, -1.0, 1.0).asDiagonal();
  ChangedContact changed{.plan = plan};
  const auto reflect = [M](Pose& X) { X = {M * X.R * M, M * X.p}; };
  for (StrikingBody& body : changed.plan.bodies) {
    reflect(body.shape.X_BS);
    reflect(body.X_WB);
    body.v_WB_W = M * body.v_WB_W;
    body.w_WB_B = -M * body.w_WB_B;
  }
  changed.plan.gravity_W = M * plan.gravity_W;
  changed.undo = [M, reflect](Strike::Body& body) {
    reflect(body.X_WB);
    body.v_WB_W = M * body.v_WB_W;
    body.w_WB_B = -M * body.w_WB_B;
  };
  return changed;
}

void scale(contact::Shape& shape, double factor) {
  shape.X_BS.p *= factor;
  if (auto* sphere = std::get_if<contact::Sphere>(&shape.kind)) {
    sphere->radius *= factor;
  } else if (auto* capsule = std::get_if<contact::Capsule>(&shape.kind)) {
    capsule->radius *= factor;
    capsule->half_length *= factor;
  } else if (auto* cylinder = std::get_if<contact::Cylinder>(&shape.kind)) {
    cylinder->radius *= factor;
    cylinder->half_length *= factor;
  } else if (auto* cone = std::get_if<contact::Cone>(&shape.kind)) {
    cone->radius *= factor;
    cone->half_length *= factor;
  } else if (auto* egg = std::get_if<contact::Ellipsoid>(&shape.kind)) {
    egg->radii *= factor;
  } else if (auto* box = std::get_if<contact::Box>(&shape.kind)) {
    box->half_size *= factor;
  }
}

// Millimetres, kg and s: a force is 1e3 times as large, a pressure 1e-3 times.
Answer strike_in_millimetres(const ContactPlan& plan, RandomDraw&) {
  ChangedContact changed{.plan = plan};
  for (StrikingBody& body : changed.plan.bodies) {
    scale(body.shape, kUnit);
    if (body.material) body.material->youngs_modulus /= kUnit;
    body.inertia_B *= kUnit * kUnit;
    body.X_WB.p *= kUnit;
    body.v_WB_W *= kUnit;
  }
  contact::ContactParameters& law = changed.plan.parameters;
  if (law.stiffness) *law.stiffness /= std::sqrt(kUnit);
  if (law.damping) *law.damping /= kUnit;
  changed.plan.gravity_W *= kUnit;
  changed.undo = [](Strike::Body& body) {
    body.X_WB.p /= kUnit;
    body.v_WB_W /= kUnit;
  };
  return changed;
}

Answer add_twin(const ContactPlan& plan, RandomDraw&) {
  ChangedContact changed{.plan = plan};
  changed.plan.has_twin = true;
  return changed;
}

}  // namespace

std::vector<ContactRelation> contact_relations() {
  return {{"SidesExchanged", exchange_sides},
          {"OrderExchanged", exchange_order},
          {"Rotated", rotate_strike},
          {"ShiftedByAKilometre", shift_strike},
          {"Boosted", boost_strike},
          {"Mirrored", mirror_strike},
          {"InMillimetres", strike_in_millimetres},
          {"WithATwin", add_twin}};
}

}  // namespace limber::metamorphic
