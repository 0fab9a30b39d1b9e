// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/joint_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/names.hpp"
#include "limber/dynamics/terms/kinematics.hpp"

namespace limber::dynamics {
namespace {

using joints::JointCoordinates;
using joints::JointShape;
using joints::RelativeMotion;

constexpr double kClosed = 1e-6;  // fraction of the size or speed; [rad]
// Of velocities, relative to the largest of the bodies.
constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Distance of a joint's frames from their constrained position, and its
/// rate.
struct Gap {
  double distance;  ///< [m]
  double rotation;  ///< [rad]
  double speed;     ///< [m/s]
  double spin;      ///< [rad/s]
};

Gap find_gap(const joints::Joint& joint, const RelativeMotion& motion) {
  const joints::ConstraintStiffness held = std::visit(
      [](const auto& constraint) {
        return joints::find_constraint_stiffness(constraint);
      },
      joint.constraint());
  const joints::ConstraintDeflection deflection =
      joint.find_deflection(held, motion);
  const Matrix6 K = std::visit(
      [&](const auto& constraint) {
        return constraint.evaluate(motion).stiffness;
      },
      joint.constraint());
  // Only the constrained part of a velocity stores energy.
  const auto held_part = [](const Matrix3& k, double stiffness,
                            const Vector3& v) {
    if (stiffness == 0.0) return 0.0;
    return std::sqrt(std::max(v.dot(k * v), 0.0) / stiffness);
  };
  return {
      deflection.distance, deflection.rotation,
      held_part(K.topLeftCorner<3, 3>(), held.translational, motion.v_FM_F),
      held_part(K.bottomRightCorner<3, 3>(), held.rotational, motion.w_FM_F)};
}

class Placing {
 public:
  Placing(const SystemModel& model, const JointStates& joints,
          SystemState& state)
      : model_(model),
        joints_(joints),
        state_(state),
        is_placed_(model.bodies.size(), false),
        places_(model.couplers.size(), false) {}

  void run() {
    find_shapes();
    check_coordinates();
    raise();
    for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
      is_placed_[b] = model_.bodies[b].is_held();
    }
    follow_joints();
    while (const auto root = find_root()) {
      is_placed_[*root] = true;
      follow_joints();
    }
    place_nodes(model_, {}, {}, state_);
    check_loops();
    raise();
    store_turns(model_, joints_, state_);
  }

 private:
  void find_shapes() {
    for (const Coupler& coupler : model_.couplers) {
      const auto* joint = std::get_if<joints::Joint>(&coupler.law);
      shapes_.emplace_back();
      if (joint == nullptr) continue;
      try {
        shapes_.back() = joints::find_shape(*joint);
      } catch (const InputError& error) {
        add(coupler.name, error.what());
      }
    }
  }

  void check_coordinates() {
    std::vector<std::string> known;
    for (std::size_t c = 0; c < shapes_.size(); ++c) {
      if (shapes_[c]) known.push_back(model_.couplers[c].name);
    }
    for (const auto& [name, given] : joints_) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        problems_.push_back(describe_unknown("joint", name, known));
        continue;
      }
      const CouplerIndex c = model_.find_coupler(name);
      check(name, joints::coordinate_count(shapes_[index(c)]->kind),
            given.position, "position");
      check(name, joints::coordinate_count(shapes_[index(c)]->kind),
            given.velocity, "velocity");
    }
  }

  void check(const std::string& name, std::size_t count,
             const std::vector<double>& values, const char* what) {
    if (!values.empty() && values.size() != count) {
      add(name, fmt::format("its {} has {} numbers; it has {} coordinate{}",
                            what, values.size(), count, count == 1 ? "" : "s"));
    }
    for (const double value : values) {
      if (std::isfinite(value)) continue;
      add(name, fmt::format("its {} has the value {}; expected finite numbers",
                            what, value));
    }
  }

  [[nodiscard]] BodyIndex body_of(AttachmentIndex a) const {
    return model_.attachments[index(a)].body;
  }
  [[nodiscard]] bool is_placed(BodyIndex body) const {
    return body == kWorld || is_placed_[index(body)];
  }

  // Couplers in order, again while any of them places a body.
  void follow_joints() {
    for (bool is_new = true; is_new;) {
      is_new = false;
      for (std::size_t c = 0; c < shapes_.size(); ++c) {
        if (!shapes_[c]) continue;
        const Coupler& coupler = model_.couplers[c];
        const bool has_F = is_placed(body_of(coupler.frame_F));
        const bool has_M = is_placed(body_of(coupler.frame_M));
        if (has_F == has_M) continue;
        const auto given = joints_.find(coupler.name);
        const RelativeMotion motion = joints::find_joint_motion(
            *shapes_[c],
            given == joints_.end() ? JointCoordinates{} : given->second);
        has_F ? place(coupler.frame_F, motion, coupler.frame_M)
              : place(coupler.frame_M, invert(motion), coupler.frame_F);
        places_[c] = true;
        is_new = true;
      }
    }
  }

  // The first that has no parent, or of a ring the first.
  [[nodiscard]] std::optional<std::size_t> find_root() const {
    std::vector<bool> is_child(model_.bodies.size(), false);
    for (std::size_t c = 0; c < shapes_.size(); ++c) {
      const BodyIndex body = body_of(model_.couplers[c].frame_M);
      if (shapes_[c] && body != kWorld) is_child[index(body)] = true;
    }
    std::optional<std::size_t> first;
    for (std::size_t b = 0; b < is_placed_.size(); ++b) {
      if (is_placed_[b]) continue;
      if (!is_child[b]) return b;
      if (!first) first = b;
    }
    return first;
  }

  // Motion of an attachment's frame in its body's frame B.
  [[nodiscard]] FrameMotion find_local(AttachmentIndex i) const {
    const Attachment& attachment = model_.attachments[index(i)];
    if (attachment.nodal) return {{attachment.R_BF, attachment.p_BF}};
    SystemState home;
    home.bodies.resize(state_.bodies.size());
    home.eta = state_.eta;
    home.etadot = state_.etadot;
    return find_frame_motion(model_, home, i);
  }

  // A frame of a placed body in the world; nodes are not yet placed.
  [[nodiscard]] FrameMotion find_frame(AttachmentIndex i) const {
    const BodyIndex body = body_of(i);
    if (body == kWorld) return find_local(i);
    const FrameMotion local = find_local(i);
    const BodyState& b = state_.bodies[index(body)];
    const Matrix3 R_WB = b.quat_WB.toRotationMatrix();
    return follow({{R_WB, b.p_WB}, b.v_WB_W, R_WB * b.w_WB_B},
                  {local.X_WF.R, local.X_WF.p, local.v_WF_W, local.w_WF_W});
  }

  // The body of frame M, from the frame F of a placed one.
  void place(AttachmentIndex F, const RelativeMotion& motion,
             AttachmentIndex M) {
    const FrameMotion local = find_local(M);
    const FrameMotion B = follow(
        follow(find_frame(F), motion),
        invert({local.X_WF.R, local.X_WF.p, local.v_WF_W, local.w_WF_W}));
    BodyState& body = state_.bodies[index(body_of(M))];
    body.p_WB = B.X_WF.p;
    body.quat_WB = Quaternion(B.X_WF.R).normalized();
    body.v_WB_W = B.v_WF_W;
    body.w_WB_B = B.X_WF.R.transpose() * B.w_WF_W;
    is_placed_[index(body_of(M))] = true;
  }

  // Bodies that joints connect to this one, except by way of the world.
  [[nodiscard]] std::vector<bool> find_linked(std::size_t coupler) const {
    std::vector<bool> linked(model_.bodies.size(), false);
    const auto mark = [&](BodyIndex b) {
      if (b != kWorld) linked[index(b)] = true;
    };
    const auto has = [&](BodyIndex b) {
      return b != kWorld && linked[index(b)];
    };
    mark(body_of(model_.couplers[coupler].frame_F));
    mark(body_of(model_.couplers[coupler].frame_M));
    for (bool is_new = true; is_new;) {
      is_new = false;
      for (const Coupler& c : model_.couplers) {
        const BodyIndex F = body_of(c.frame_F);
        const BodyIndex M = body_of(c.frame_M);
        if (F == kWorld || M == kWorld || has(F) == has(M)) continue;
        mark(F);
        mark(M);
        is_new = true;
      }
    }
    return linked;
  }

  // What the gap of a loop is compared with.
  struct Scale {
    double size = 0.0;   // of arms, and between bodies [m]
    double speed = 0.0;  // relative to one of the bodies, or to the world [m/s]
    double spin = 0.0;   // [rad/s]
    double rounding = 0.0;  // of the speed [m/s]
  };

  [[nodiscard]] Scale find_scale(std::size_t coupler) const {
    const std::vector<bool> linked = find_linked(coupler);
    const BodyIndex F = body_of(model_.couplers[coupler].frame_F);
    const BodyIndex M = body_of(model_.couplers[coupler].frame_M);
    const BodyState* reference = nullptr;
    if (F != kWorld && M != kWorld) reference = &state_.bodies[index(F)];
    Scale scale;
    for (const Attachment& a : model_.attachments) {
      if (a.body == kWorld || !linked[index(a.body)]) continue;
      scale.size = std::max(scale.size, a.p_BF.norm());
    }
    for (std::size_t b = 0; b < linked.size(); ++b) {
      if (!linked[b]) continue;
      const BodyState& at = state_.bodies[b];
      scale.spin = std::max(scale.spin, at.w_WB_B.norm());
      scale.rounding = std::max(scale.rounding, kRounding * at.v_WB_W.norm());
      if (reference != nullptr) {
        scale.speed =
            std::max(scale.speed, (at.v_WB_W - reference->v_WB_W).norm());
        scale.size = std::max(scale.size, (at.p_WB - reference->p_WB).norm());
      } else {
        scale.speed = std::max(scale.speed, at.v_WB_W.norm());
      }
    }
    scale.speed += scale.spin * scale.size;
    return scale;
  }

  void check_loops() {
    for (std::size_t c = 0; c < shapes_.size(); ++c) {
      if (!shapes_[c] || places_[c]) continue;
      const Coupler& coupler = model_.couplers[c];
      if (const auto given = joints_.find(coupler.name);
          given != joints_.end() &&
          !(given->second.position.empty() && given->second.velocity.empty())) {
        add(coupler.name,
            "it closes a loop, so its coordinates follow from those of the "
            "preceding joints; leave them out");
      }
      const Gap gap =
          find_gap(std::get<joints::Joint>(coupler.law),
                   find_relative_motion(model_, state_, CouplerIndex(c)));
      const Scale scale = find_scale(c);
      if (!(gap.distance <= kClosed * scale.size && gap.rotation <= kClosed)) {
        add(coupler.name,
            fmt::format("it closes a loop, and its frames are {:.3g} m and "
                        "{:.3g} rad from where they must be; give the "
                        "preceding joints coordinates that close it",
                        gap.distance, gap.rotation));
      } else if (!(gap.speed <= kClosed * scale.speed + scale.rounding &&
                   gap.spin <= kClosed * scale.spin)) {
        add(coupler.name,
            fmt::format("it closes a loop, and its frames separate "
                        "at {:.3g} m/s and {:.3g} rad/s; give the "
                        "preceding joints rates that keep it closed",
                        gap.speed, gap.spin));
      }
    }
  }

  void add(const std::string& joint, const std::string& text) {
    problems_.push_back(fmt::format("joint '{}': {}", echo(joint), text));
  }
  void raise() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

  const SystemModel& model_;
  const JointStates& joints_;
  SystemState& state_;
  std::vector<std::optional<JointShape>> shapes_;  // none: no joint
  std::vector<bool> is_placed_;                    // one a body
  std::vector<bool> places_;                       // one a coupler
  std::vector<std::string> problems_;
};

}  // namespace

SystemState make_state(const SystemModel& model, const JointStates& joints) {
  SystemState state = make_state(model);
  place_bodies(model, joints, state);
  return state;
}

void place_bodies(const SystemModel& model, const JointStates& joints,
                  SystemState& state) {
  LIMBER_EXPECT(state.bodies.size() == model.bodies.size());
  LIMBER_EXPECT(state.eta.size() == model.modal_count);
  LIMBER_EXPECT(state.etadot.size() == model.modal_count);
  SystemState placed = state;
  Placing(model, joints, placed).run();
  state = std::move(placed);
}

void store_turns(const SystemModel& model, const JointStates& joints,
                 SystemState& state) {
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const auto start = joints.find(model.couplers[c].name);
    if (start == joints.end()) continue;
    const std::vector<double>& q = start->second.position;
    const auto& coordinates = joints::coordinates_of(model.couplers[c].law);
    for (std::size_t i = 0; i < coordinates.size() && i < q.size(); ++i) {
      state.memory[c].near[i] = q[i];
    }
  }
}

}  // namespace limber::dynamics
