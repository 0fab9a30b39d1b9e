// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/body_plan.hpp"

#include <fmt/format.h>

#include "limber/common/index.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

/// Inertia of a mass `m` at distance `d` from a point.
Matrix3 steiner(double m, const Vector3& d) {
  return m * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
}

class Planner {
 public:
  Planner(const Robot& robot, const std::vector<ReducedPointer>& reduced)
      : robot_(robot), reduced_(reduced), problems_(robot.file.string()) {}

  BodyPlans run() {
    LIMBER_EXPECT(reduced_.size() == robot_.links.size());
    plans_.body_of_link.assign(robot_.links.size(), 0);
    plans_.X_BL.assign(robot_.links.size(), Pose{});
    add_body(0);
    plans_.bodies.front().is_world = robot_.has_world_root();
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) add_joint(int(i));
    for (std::size_t i = robot_.tree_size(); i < robot_.links.size(); ++i) {
      add_body(static_cast<int>(i));
    }
    for (BodyPlan& body : plans_.bodies) place(body);
    problems_.raise();
    return plans_;
  }

 private:
  void add_body(int link) {
    BodyPlan body;
    body.name = robot_.links[index(link)].name;
    body.links = {link};
    body.reduced = reduced_[index(link)];
    plans_.body_of_link[index(link)] = static_cast<int>(plans_.bodies.size());
    plans_.bodies.push_back(body);
  }

  void add_joint(int i) {
    const Joint& joint = robot_.joints[index(i)];
    const int parent = plans_.body_of_link[index(joint.parent)];
    if (merges(robot_, joint)) {
      plans_.body_of_link[index(joint.child)] = parent;
      plans_.bodies[index(parent)].links.push_back(joint.child);
      // Temporarily in the frame of the body's first link.
      plans_.X_BL[index(joint.child)] =
          plans_.X_BL[index(joint.parent)] * joint.X_PJ;
      return;
    }
    add_body(joint.child);
    const ReducedPointer& child = reduced_[index(joint.child)];
    if (child && child->clamped) {
      check_clamped(joint, plans_.bodies[index(parent)]);
    } else {
      plans_.coupled_joints.push_back(i);
    }
  }

  void check_clamped(const Joint& joint, const BodyPlan& parent) {
    if (parent.is_world && joint.kind == joints::JointKind::fixed) return;
    problems_.add(
        0, fmt::format("link '{}' is clamped to the world, so it must be the "
                       "root link or hang on 'world' by a fixed joint; joint "
                       "'{}' does neither",
                       robot_.links[index(joint.child)].name, joint.name));
  }

  void place(BodyPlan& body) {
    if (body.reduced) {
      place_flexible(body);
    } else if (!body.is_world) {
      place_rigid(body);
    }
  }

  void place_flexible(BodyPlan& body) {
    const int link = body.links.front();
    const Pose X_LM = robot_.links[index(link)].flexible->X_LM;
    const Pose X_MB{Matrix3::Identity(), body.reduced->p_MoBcm_M};
    plans_.X_BL[index(link)] = (X_LM * X_MB).inverse();
    body.mass = body.reduced->mass;
    body.inertia = body.reduced->inertia();
  }

  void place_rigid(BodyPlan& body) {
    Vector3 moment = Vector3::Zero();
    for (const int link : body.links) {
      const auto& inertia = robot_.links[index(link)].inertia;
      if (!inertia) continue;
      body.mass += inertia->mass;
      moment += inertia->mass * (plans_.X_BL[index(link)] * inertia->p_LBcm);
    }
    if (!(body.mass > 0.0)) {
      problems_.add(0, fmt::format("link '{}' moves but has no mass; give it "
                                   "an <inertial>, or fix it to a link that "
                                   "has one",
                                   body.name));
      return;
    }
    const Vector3 center = moment / body.mass;
    for (const int link : body.links) {
      Pose& X_BL = plans_.X_BL[index(link)];
      X_BL.p -= center;
      const auto& inertia = robot_.links[index(link)].inertia;
      if (!inertia) continue;
      body.inertia += X_BL.R * inertia->inertia * X_BL.R.transpose() +
                      steiner(inertia->mass, X_BL * inertia->p_LBcm);
    }
  }

  const Robot& robot_;
  const std::vector<ReducedPointer>& reduced_;
  Problems problems_;
  BodyPlans plans_;
};

}  // namespace

BodyPlans plan_bodies(const Robot& robot,
                      const std::vector<ReducedPointer>& reduced) {
  return Planner(robot, reduced).run();
}

}  // namespace limber::scene
