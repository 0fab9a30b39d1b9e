// SPDX-License-Identifier: BSD-3-Clause
// Probes of the motion relative to another body.
#include <gtest/gtest.h>

#include <memory>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/kinematics.hpp"
#include "limber/scene/probes/point_probe.hpp"

namespace limber::scene::relative_probe_test {
namespace {

struct TwoBodies {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

TwoBodies make_bodies() {
  dynamics::SystemBuilder builder;
  builder.add_rigid_body("a", {1.0, Matrix3::Identity()});
  builder.add_rigid_body("b", {1.0, Matrix3::Identity()});
  TwoBodies out{builder.build(), {}};
  out.state = dynamics::make_state(out.model);
  dynamics::BodyState& a = out.state.bodies[0];
  a.p_WB = {1.0, -2.0, 0.5};
  a.quat_WB = exp_quaternion(Vector3(0.3, 1.2, -0.4));
  a.v_WB_W = {0.2, 0.1, -0.7};
  a.w_WB_B = {1.1, -0.3, 0.8};
  dynamics::BodyState& b = out.state.bodies[1];
  b.p_WB = {-0.4, 0.9, 0.3};
  b.quat_WB = exp_quaternion(Vector3(-0.9, 0.1, 0.5));
  b.v_WB_W = {0.6, -0.2, 0.3};
  b.w_WB_B = {-0.5, 0.4, 0.9};
  return out;
}

PointProbe make_probe(Quantity quantity) {
  auto base = std::make_shared<PointProbe>();
  base->body = dynamics::BodyIndex(1);
  base->p_B = {0.2, 0.1, -0.3};
  base->R_BL = exp_rotation(Vector3(0.1, -0.7, 0.2));
  PointProbe probe;
  probe.quantity = quantity;
  probe.body = dynamics::BodyIndex(0);
  probe.p_B = {-0.1, 0.4, 0.2};
  probe.base = base;
  return probe;
}

dynamics::SystemState advance(const dynamics::SystemState& state, double h) {
  dynamics::SystemState later = state;
  for (dynamics::BodyState& body : later.bodies) {
    body.p_WB += h * body.v_WB_W;
    body.quat_WB = body.quat_WB * exp_quaternion(h * body.w_WB_B);
  }
  return later;
}

TEST(RelativeProbe, HasThePositionInTheAxesOfItsBasesLink) {
  const TwoBodies two = make_bodies();
  const PointProbe probe = make_probe(Quantity::position);
  const auto pose = [&](std::size_t i) {
    const dynamics::BodyState& body = two.state.bodies[i];
    return Pose{body.quat_WB.toRotationMatrix(), body.p_WB};
  };
  const Pose X_Wb = pose(1) * Pose{probe.base->R_BL, probe.base->p_B};
  const Vector3 expected = X_Wb.inverse() * (pose(0) * probe.p_B);
  EXPECT_LT((evaluate(probe, two.model, two.state) - expected).norm(), 1e-14);
}

TEST(RelativeProbe, HasTheRatesOfItsPositionAndRotation) {
  const TwoBodies two = make_bodies();
  constexpr double h = 1e-5;
  const auto differentiate = [&](Quantity quantity) {
    PointProbe probe = make_probe(quantity);
    set_start(probe, two.model, two.state);
    return Vector3((evaluate(probe, two.model, advance(two.state, h)) -
                    evaluate(probe, two.model, advance(two.state, -h))) /
                   (2.0 * h));
  };
  const auto value = [&](Quantity quantity) {
    return evaluate(make_probe(quantity), two.model, two.state);
  };
  EXPECT_LT((differentiate(Quantity::displacement) - value(Quantity::velocity))
                .norm(),
            1e-8);
  EXPECT_LT(
      (differentiate(Quantity::rotation) - value(Quantity::angular_velocity))
          .norm(),
      1e-8);
}

TEST(RelativeProbe, IsAtRestInABodyThatItMovesWith) {
  const TwoBodies two = make_bodies();
  PointProbe probe = make_probe(Quantity::displacement);
  probe.body = probe.base->body;
  set_start(probe, two.model, two.state);
  EXPECT_LT(evaluate(probe, two.model, advance(two.state, 0.7)).norm(), 1e-14);
}

TEST(RelativeProbe, OfTheWorldIsThatOfTheWorld) {
  const TwoBodies two = make_bodies();
  PointProbe probe = make_probe(Quantity::position);
  auto world = std::make_shared<PointProbe>();
  world->body = dynamics::kWorld;
  probe.base = world;
  const Vector3 relative = evaluate(probe, two.model, two.state);
  probe.base = nullptr;
  EXPECT_EQ(relative, evaluate(probe, two.model, two.state));
}

}  // namespace
}  // namespace limber::scene::relative_probe_test
