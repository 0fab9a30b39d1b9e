// SPDX-License-Identifier: BSD-3-Clause
#include "support/linked_bodies.hpp"

#include <cstddef>
#include <random>

#include "limber/common/rotation.hpp"
#include "support/draw_vector.hpp"
#include "support/point_mass_body.hpp"

namespace limber::testing {

joints::Joint make_test_joint(joints::JointKind kind, double damping,
                              std::vector<joints::JointElement> more) {
  return joints::make_joint(kind, Vector3(1, 2, 2) / 3.0,
                            Vector3(2, 1, -2) / 3.0,
                            {.translational_stiffness = 300.0,
                             .rotational_stiffness = 40.0,
                             .translational_damping = damping,
                             .rotational_damping = damping,
                             .free_damping = damping},
                            std::move(more));
}

Link link_joints(const std::string& name, joints::JointKind kind,
                 double damping, std::vector<joints::JointElement> more) {
  return {name, [=](dynamics::SystemBuilder& builder, const BodyEnds& ends) {
            const joints::Joint joint = make_test_joint(kind, damping, more);
            builder.add_coupler("first", joint, ends.far[0], ends.near[1]);
            builder.add_coupler("second", joint, ends.far[1], ends.near[2]);
          }};
}

std::vector<Link> make_all_links(double damping) {
  using joints::JointKind;
  const joints::ScalarSpring spring(
      {.curve = joints::SpringCurve(
           {.stiffness = 20.0, .quadratic = 3.0, .extensions = {}}),
       .damping = damping,
       .rest = 0.4});
  const joints::EndStop stop({.lower = -0.2,
                              .upper = 0.3,
                              .stiffness = 70.0,
                              .damping = 0.3 * damping});
  const joints::Drive drive({.mode = joints::DriveMode::position,
                             .signal = {.base = joints::ConstantSignal{0.7}},
                             .stiffness = 30.0,
                             .damping = damping,
                             .max_effort = 12.0});
  std::vector<Link> links;
  for (const JointKind kind :
       {JointKind::fixed, JointKind::revolute, JointKind::prismatic,
        JointKind::planar, JointKind::universal, JointKind::ball}) {
    links.push_back(
        link_joints(std::string(joints::to_string(kind)), kind, damping));
  }
  for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
    const std::string name(joints::to_string(kind));
    links.push_back(
        link_joints(name + "_spring", kind, damping, {{0, spring}}));
    links.push_back(link_joints(name + "_stop", kind, damping, {{0, stop}}));
    links.push_back(link_joints(name + "_drive", kind, damping, {{0, drive}}));
  }
  links.push_back(link_joints("universal_springs", JointKind::universal,
                              damping, {{0, spring}, {1, spring}}));
  links.push_back(
      {"tendon", [=](dynamics::SystemBuilder& builder, const BodyEnds& e) {
         builder.add_path("tendon",
                          {e.near[0], e.far[0], e.near[1], e.far[1], e.far[2]},
                          {spring});
       }});
  links.push_back(
      {"gear", [=](dynamics::SystemBuilder& builder, const BodyEnds& ends) {
         link_joints("", JointKind::revolute, damping).add(builder, ends);
         builder.add_joint_sum("gear",
                               {.terms = {{dynamics::CouplerIndex(0), 0, 1.0},
                                          {dynamics::CouplerIndex(1), 0, -2.5}},
                                .offset = 0.3},
                               {spring});
       }});
  links.push_back(
      {"line", [=](dynamics::SystemBuilder& builder, const BodyEnds& ends) {
         builder.add_coupler("line",
                             joints::PointSpring({.stiffness = 90.0,
                                                  .damping = damping,
                                                  .free_length = 0.2,
                                                  .quadratic = 5.0}),
                             ends.far[0], ends.near[1]);
       }});
  return links;
}

LinkedBodies make_linked_bodies(const Link& link,
                                std::array<bool, 3> is_flexible, unsigned seed,
                                double speed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    return draw_vector([&] { return uniform(random); });
  };
  const PointMassBody body = make_point_mass_body(20, 4, 3.0, 1.0, 8.0, 11);
  const auto reduced = share(body);
  const auto near = make_interface(body, 0, 6);
  const auto far = make_interface(body, 6, 12);
  dynamics::SystemBuilder builder;
  BodyEnds ends{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto b =
        builder.add_flexible_body("body" + std::to_string(i), reduced,
                                  is_flexible[i] ? dynamics::Fidelity::coupled
                                                 : dynamics::Fidelity::rigid,
                                  {});
    const Pose X_near{exp_rotation(vector()), near.p_B + 0.2 * vector()};
    const Pose X_far{exp_rotation(vector()), far.p_B + 0.2 * vector()};
    ends.near[i] = builder.attach_interface("near", b, near, X_near);
    ends.far[i] = builder.attach_interface("far", b, far, X_far);
  }
  link.add(builder, ends);
  LinkedBodies out{builder.build(), {}};
  out.state = dynamics::make_state(out.model);
  dynamics::SystemState& s = out.state;
  for (double& x : s.eta) x = 0.2 * uniform(random);
  for (double& x : s.etadot) x = speed * uniform(random);
  s.bodies[0].p_WB = vector();
  s.bodies[0].quat_WB = exp_quaternion(2.0 * vector());
  const Vector3 a = Vector3(1, 2, 2) / 3.0;
  const Vector3 b = Vector3(2, 1, -2) / 3.0;
  for (std::size_t i = 0; i < 3; ++i) {
    s.bodies[i].v_WB_W = speed * vector();
    s.bodies[i].w_WB_B = speed * vector();
    if (i == 0) continue;
    // The near end on the far end before it, turned and strained.
    const Matrix3 lean = exp_rotation(1.2 * uniform(random) * b);
    const Matrix3 turn = exp_rotation(3.0 * uniform(random) * a);
    const Matrix3 strain = exp_rotation(0.05 * vector());
    const Pose X_FM{strain * turn * lean, 0.3 * vector()};
    const Pose X_BM = find_frame_motion(out.model, s, ends.near[i]).X_WF;
    const Pose X_WF = find_frame_motion(out.model, s, ends.far[i - 1]).X_WF;
    const Pose X_WB = X_WF * X_FM * X_BM.inverse();
    s.bodies[i].p_WB = X_WB.p;
    s.bodies[i].quat_WB = Quaternion(X_WB.R).normalized();
  }
  return out;
}

}  // namespace limber::testing
