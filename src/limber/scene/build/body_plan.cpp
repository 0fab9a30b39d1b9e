// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/body_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "limber/common/index.hpp"
#include "limber/common/piece_names.hpp"
#include "limber/dynamics/system/inertia_check.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

/// Inertia of a mass `m` at distance `d` from a point.
Matrix3 steiner(double m, const Vector3& d) {
  return m * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
}

class Planner {
 public:
  Planner(const Robot& robot, const std::vector<ReducedPieces>& reduced)
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
    const ReducedPieces& pieces = reduced_[index(link)];
    BodyPlan body;
    body.name = robot_.links[index(link)].name;
    body.links = {link};
    if (!pieces.empty()) body.reduced = pieces.front();
    plans_.body_of_link[index(link)] = static_cast<int>(plans_.bodies.size());
    if (pieces.size() < 2) {
      plans_.bodies.push_back(body);
      return;
    }
    body.piece_count = static_cast<int>(pieces.size());
    for (const ReducedPointer& piece : pieces) {
      BodyPlan part = body;
      part.piece = body.piece++;
      part.name = name_piece(body.name, part.piece);
      part.reduced = piece;
      part.p_FB = piece->p_MoBcm_M - pieces.front()->p_MoBcm_M;
      check_name(part);
      plans_.bodies.push_back(part);
    }
  }

  void check_name(const BodyPlan& piece) {
    for (const Link& link : robot_.links) {
      if (link.name != piece.name) continue;
      problems_.add(
          0,
          fmt::format(
              "link '{}' has the same name as piece {} of link '{}'; rename it",
              link.name, piece.piece + 1,
              robot_.links[index(piece.links[0])].name));
    }
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
    const ReducedPieces& child = reduced_[index(joint.child)];
    if (std::any_of(child.begin(), child.end(),
                    [](const ReducedPointer& body) { return body->clamped; })) {
      check_clamped(joint, plans_.bodies[index(parent)]);
    } else {
      plans_.coupled_joints.push_back(i);
    }
  }

  void check_clamped(const Joint& joint, const BodyPlan& parent) {
    if (parent.is_world && joint.kind == joints::JointKind::fixed) return;
    problems_.add(
        0,
        fmt::format(
            "link '{}' is clamped to the world, so it must be the root link or "
            "be attached to 'world' by a fixed joint; joint '{}' does neither",
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
    body.mass = body.reduced->mass;
    body.inertia = body.reduced->inertia();
    if (body.piece > 0) return;  // placed from the first
    const int link = body.links.front();
    const Pose X_LM = robot_.links[index(link)].flexible->X_LM;
    const Pose X_MB{Matrix3::Identity(), body.reduced->p_MoBcm_M};
    plans_.X_BL[index(link)] = (X_LM * X_MB).inverse();
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
      problems_.add(0, fmt::format("link '{}' moves but has no mass{} give it "
                                   "an <inertial>, or fix it to a link that "
                                   "has one",
                                   body.name, describe_neighbours(body)));
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
    check_inertia(body);
  }

  /// The joints of a body without mass, and what can stand for two of them.
  [[nodiscard]] std::string describe_neighbours(const BodyPlan& body) const {
    std::string on;
    std::vector<std::string> carries;
    for (const int i : plans_.coupled_joints) {
      const Joint& joint = robot_.joints[index(i)];
      if (joint.child == body.links.front()) on = joint.name;
      const auto& own = body.links;
      if (std::find(own.begin(), own.end(), joint.parent) != own.end()) {
        carries.push_back("'" + joint.name + "'");
      }
    }
    if (on.empty() || carries.empty()) return ";";
    return fmt::format(
        ", between joints '{}' and {}: only their forces would move it. Where "
        "their axes meet, one <coupler> of kind \"universal\" (axes at a right "
        "angle) or \"ball\" (three axes) can stand for them; else",
        on, fmt::join(carries, ", "));
  }

  /// Of each link merged in a body that is not a point, else of the body.
  void check_inertia(const BodyPlan& body) {
    bool is_bad = false;
    for (const int i : body.links) {
      const Link& link = robot_.links[index(i)];
      if (!link.inertia || link.inertia->inertia.isZero(0.0)) continue;
      is_bad |=
          add_problem(link.name, link.inertia->place, link.inertia->inertia);
    }
    if (!is_bad) add_problem(body.name, "", body.inertia);
  }

  /// @returns whether there is one
  bool add_problem(const std::string& link, const std::string& place,
                   const Matrix3& inertia) {
    const std::string problem = dynamics::find_inertia_problem(inertia);
    if (problem.empty()) return false;
    problems_.add(
        0, fmt::format("link '{}'{}{}: {}; --repair-inertia uses the "
                       "nearest that is physical",
                       link, place.empty() ? "" : " at ", place, problem));
    return true;
  }

  const Robot& robot_;
  const std::vector<ReducedPieces>& reduced_;
  Problems problems_;
  BodyPlans plans_;
};

}  // namespace

std::span<const BodyPlan> find_bodies(const BodyPlans& plans, int link) {
  const BodyPlan* first = &plans.bodies[index(plans.body_of_link[index(link)])];
  return {first, index(first->piece_count)};
}

Pose find_X_BL(const BodyPlans& plans, int link, int piece) {
  Pose X_BL = plans.X_BL[index(link)];
  // The axes of all pieces are the mesh's.
  X_BL.p -= find_bodies(plans, link)[index(piece)].p_FB;
  return X_BL;
}

std::vector<ReducedPieces> find_reduced(const Robot& robot,
                                        const dynamics::SystemModel& model) {
  std::map<std::string, ReducedPointer> by_name;
  for (const dynamics::BodyModel& body : model.bodies) {
    by_name[body.name] = body.reduced;
  }
  std::vector<ReducedPieces> reduced;
  for (const Link& link : robot.links) {
    ReducedPieces& pieces = reduced.emplace_back();
    if (!link.flexible) continue;
    if (const auto whole = by_name.find(link.name); whole != by_name.end()) {
      pieces = {whole->second};
      continue;
    }
    for (int piece = 0;; ++piece) {
      const auto found = by_name.find(name_piece(link.name, piece));
      if (found == by_name.end()) break;
      pieces.push_back(found->second);
    }
    LIMBER_EXPECT(!pieces.empty());
  }
  return reduced;
}

BodyPlans plan_bodies(const Robot& robot,
                      const std::vector<ReducedPieces>& reduced) {
  return Planner(robot, reduced).run();
}

}  // namespace limber::scene
