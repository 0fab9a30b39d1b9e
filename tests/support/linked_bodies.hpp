// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/joint_kind.hpp"

/// Three bodies A, B, C, rigid or flexible, with every kind of link between
/// them, in random configurations.
namespace limber::testing {

/// Frames at the near and the far end of each body.
struct BodyEnds {
  std::array<dynamics::AttachmentIndex, 3> near;
  std::array<dynamics::AttachmentIndex, 3> far;
};

/// Adds couplers or transmissions to three bodies. The joint that a link
/// turns, if any, is coupler 0 from A's far end to B's near end and coupler 1
/// from B's far end to C's near end.
struct Link {
  std::string name;
  std::function<void(dynamics::SystemBuilder&, const BodyEnds&)> add;
};

joints::Joint make_test_joint(joints::JointKind kind, double damping,
                              std::vector<joints::JointElement> more);

/// Two joints of the same kind with the same elements.
Link link_joints(const std::string& name, joints::JointKind kind,
                 double damping, std::vector<joints::JointElement> more = {});

/// Every kind; `damping` in all that can have some.
std::vector<Link> make_all_links(double damping);

struct LinkedBodies {
  dynamics::SystemModel model;
  dynamics::SystemState state;
};

/// Bodies A and C flexible, or A rigid, or all; the joints rotated by up to 3
/// rad about each free axis, their constraints slightly strained.
LinkedBodies make_linked_bodies(const Link& link,
                                std::array<bool, 3> is_flexible, unsigned seed,
                                double speed);

}  // namespace limber::testing
