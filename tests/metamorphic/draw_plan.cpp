// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/draw_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/joints/joint_kind.hpp"
#include "metamorphic/draw_law.hpp"
#include "metamorphic/random_draw.hpp"

namespace limber::metamorphic {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

FramePlan at_end(int body, const BodyPlan& plan, bool is_far,
                 const Matrix3& R_BF) {
  FramePlan frame{body, "", {R_BF, Vector3::Zero()}};
  if (plan.modes > 0) frame.interface = is_far ? "far" : "near";
  frame.X.p.z() = (is_far ? 0.5 : -0.5) * plan.length;
  return frame;
}

class PlanDraw {
 public:
  explicit PlanDraw(unsigned seed) : seed_(seed), draw_(seed) {}

  ScenePlan draw() {
    size_ = draw_.log_uniform(0.1, 10.0);
    mass_ = draw_.log_uniform(0.01, 100.0);
    frequency_ = draw_.log_uniform(1.0, 100.0);
    is_free_ = draw_.chance(0.5);
    const int bodies = draw_.integer(1, 6);
    for (int b = 0; b < bodies; ++b) add_body(b);
    for (int b = 0; b < bodies; ++b) join(b);
    add_lines(bodies);
    add_gear();
    for (int b = 0; b < bodies; ++b) {
      if (draw_.chance(0.3)) push(b);
    }
    if (draw_.chance(0.5)) {
      plan_.gravity_W = size_ * frequency_ * frequency_ *
                        draw_.log_uniform(1e-2, 0.5) * draw_.direction();
    }
    plan_.settings = draw_settings();
    add_more();
    return std::move(plan_);
  }

 private:
  void add_body(int b) {
    using dynamics::Fidelity;
    BodyPlan body;
    body.name = "body" + std::to_string(b);
    body.mass = mass_ * draw_.log_uniform(0.2, 5.0);
    body.length = size_ * draw_.log_uniform(0.3, 3.0);
    body.lowest = frequency_ * draw_.log_uniform(3.0, 10.0);
    body.variant = static_cast<unsigned>(draw_.integer(0, 999));
    body.damping = draw_.chance(0.5) ? 0.0 : draw_.log_uniform(1e-4, 0.3);
    body.modes = draw_.chance(0.35) ? 0 : draw_.integer(1, 5);
    constexpr Fidelity kLevels[] = {Fidelity::coupled, Fidelity::coupled,
                                    Fidelity::one_way, Fidelity::uncoupled,
                                    Fidelity::rigid};
    body.level = kLevels[draw_.integer(0, 4)];
    body.eta = VectorX::Zero(body.modes);
    body.etadot = VectorX::Zero(body.modes);
    if (draw_.chance(0.5)) excite(body);
    parents_.push_back(b == 0 || draw_.chance(0.7) ? b - 1
                                                   : draw_.integer(0, b - 1));
    place(body);
    plan_.bodies.push_back(std::move(body));
  }

  void excite(BodyPlan& body) {
    const double scale = 0.01 * std::sqrt(body.mass) * size_;
    for (double& x : body.eta) x = scale * draw_.uniform(-1.0, 1.0);
    for (double& v : body.etadot) {
      v = scale * frequency_ * draw_.uniform(-1.0, 1.0);
    }
  }

  // In line with its parent, turned as all are; with the same spin.
  void place(BodyPlan& body) {
    const int parent = parents_.back();
    if (parent < 0) {
      R_ = draw_.rotation();
      spin_ = (draw_.chance(0.5) ? 0.3 * frequency_ : 0.0) * draw_.direction();
      v_ = (is_free_ ? size_ * frequency_ : 0.0) * draw_.direction();
    }
    const Vector3 along = R_.col(2);
    const Vector3 start =
        parent < 0 ? Vector3(Vector3::Zero())
                   : Vector3(plan_.bodies[index(parent)].X_WB.p +
                             0.5 * plan_.bodies[index(parent)].length * along);
    body.X_WB = {R_, start + 0.5 * body.length * along};
    body.w_WB_B = R_.transpose() * spin_;
    body.v_WB_W = v_ + spin_.cross(body.X_WB.p);
    if (draw_.chance(0.3)) {
      body.w_WB_B += 0.2 * frequency_ * draw_.direction();
    }
  }

  double find_mass(int b) const {
    const int parent = parents_[index(b)];
    const double own = plan_.bodies[index(b)].mass;
    return parent < 0 ? own : std::min(own, plan_.bodies[index(parent)].mass);
  }

  void join(int b) {
    const int parent = parents_[index(b)];
    if (parent < 0 && is_free_) return;
    const FramePlan M =
        at_end(b, plan_.bodies[index(b)], false, Matrix3::Identity());
    FramePlan F{-1, "", {R_, Vector3::Zero()}};
    if (parent >= 0) {
      F = at_end(parent, plan_.bodies[index(parent)], true,
                 Matrix3::Identity());
    }
    CouplerPlan coupler = draw_coupler(
        draw_,
        {.mass = find_mass(b), .length = size_, .frequency = frequency_});
    coupler.name = "joint" + std::to_string(b);
    coupler.F = F;
    coupler.M = M;
    plan_.couplers.push_back(std::move(coupler));
  }

  FramePlan draw_frame(int bodies) {
    const int body = draw_.integer(is_free_ ? 0 : -1, bodies - 1);
    if (body < 0) {
      return {-1, "", {draw_.rotation(), size_ * draw_.direction()}};
    }
    if (draw_.chance(0.5)) {
      return at_end(body, plan_.bodies[index(body)], draw_.chance(0.5),
                    draw_.rotation());
    }
    const Vector3 place =
        0.4 * plan_.bodies[index(body)].length * draw_.direction();
    return {body, "", {draw_.rotation(), place}};
  }

  [[nodiscard]] Vector3 find_place(const FramePlan& f) const {
    return f.body < 0 ? f.X.p : plan_.bodies[index(f.body)].X_WB * f.X.p;
  }
  // Points that coincide have no line.
  [[nodiscard]] bool are_apart(const FramePlan& a, const FramePlan& b) const {
    return a.body != b.body &&
           (find_place(a) - find_place(b)).norm() > 0.1 * size_;
  }

  // Springs and cables between points, and tendons over three.
  void add_lines(int bodies) {
    const LawScale scale{
        .mass = mass_ * 0.2, .length = size_, .frequency = frequency_};
    for (int i = draw_.integer(0, 2); i > 0; --i) {
      CouplerPlan spring = draw_point_spring(draw_, scale);
      spring.name = "spring" + std::to_string(i);
      spring.F = draw_frame(bodies);
      spring.M = draw_frame(bodies);
      if (!are_apart(spring.F, spring.M)) continue;
      plan_.couplers.push_back(std::move(spring));
    }
    if (!draw_.chance(0.3) || bodies < 2) return;
    PathPlan path;
    path.name = "tendon";
    for (int i = 0; i < 3; ++i) path.points.push_back(draw_frame(bodies));
    path.law = draw_tendon_law(draw_, scale);
    if (!are_apart(path.points[0], path.points[1]) ||
        !are_apart(path.points[1], path.points[2])) {
      return;
    }
    plan_.paths.push_back(std::move(path));
  }

  void add_gear() {
    GearPlan gear;
    for (const CouplerPlan& c : plan_.couplers) {
      if (c.is_hinge) gear.joints.push_back(c.name);
    }
    if (gear.joints.size() < 2) return;
    gear.joints.resize(2);
    gear.name = "gear";
    gear.factors = {1.0, draw_.uniform(-3.0, 3.0)};
    gear.law = draw_gear_law(
        draw_, {.mass = mass_ * 0.2, .length = size_, .frequency = frequency_});
    plan_.gears.push_back(std::move(gear));
  }

  void push(int b) {
    LoadPlan load;
    const BodyPlan& body = plan_.bodies[index(b)];
    load.name = "push" + std::to_string(b);
    load.where = at_end(b, body, true, draw_.rotation());
    const double force = body.mass * size_ * frequency_ * frequency_;
    load.force = force * draw_.log_uniform(0.01, 0.5) * draw_.direction();
    load.moment =
        0.1 * force * size_ * draw_.uniform(0.0, 1.0) * draw_.direction();
    load.frame = draw_.chance(0.5) ? dynamics::LoadFrame::body
                                   : dynamics::LoadFrame::world;
    const double period = 1.0 / frequency_;
    const double start = draw_.uniform(0.0, 1.0) * period;
    const double duration = draw_.uniform(0.2, 2.0) * period;
    if (draw_.chance(0.5)) {
      const auto shape = static_cast<dynamics::PulseShape>(draw_.integer(0, 2));
      load.function = [=](double delay) {
        return dynamics::Pulse{shape, start + delay, duration};
      };
    } else {
      load.function = [=](double delay) {
        return dynamics::Sinusoid{.frequency = 0.2 / duration,
                                  .from = start + delay};
      };
    }
    plan_.loads.push_back(std::move(load));
  }

  // Of seeds that draw nothing for it, so that other scenes stay as they are.
  void add_more() {
    if (seed_ % 5 == 2) {
      for (BodyPlan& body : plan_.bodies) {
        if (body.modes > 0 && draw_.chance(0.7)) {
          body.level = dynamics::Fidelity::nonlinear;
        }
      }
    }
    if (seed_ % 7 == 4 || seed_ % 7 == 6) {
      const auto last = static_cast<int>(plan_.bodies.size()) - 1;
      const int controllers = draw_.integer(1, 2);
      for (int i = 0; i < controllers; ++i) add_controller(i, last);
    }
  }

  void add_controller(int number, int last_body) {
    ControllerPlan controller;
    controller.name = "brake" + std::to_string(number);
    controller.where.body = draw_.integer(0, last_body);
    controller.axis = draw_.direction();
    controller.gain = frequency_ * draw_.log_uniform(0.003, 0.1);
    controller.period =
        draw_.log_uniform(2.0, 20.0) * plan_.settings.end_time / 96.0;
    controller.hold = draw_.chance(0.5) ? dynamics::InputHold::held
                                        : dynamics::InputHold::linear;
    plan_.controllers.push_back(controller);
  }

  dynamics::SimulationSettings draw_settings() {
    using dynamics::IntegratorKind;
    dynamics::SimulationSettings settings;
    settings.integrator =
        draw_.chance(0.4)
            ? IntegratorKind::generalized_alpha
            : static_cast<IntegratorKind>(draw_.integer(
                  0, static_cast<int>(dynamics::kLastIntegrator)));
    settings.rho_inf = draw_.uniform(0.0, 1.0);
    // Newton's error is round-off.
    settings.newton_tolerance = kNewtonTolerance;
    const auto& traits = dynamics::traits_of(settings.integrator);
    settings.step = (traits.is_implicit ? draw_.log_uniform(0.003, 0.03)
                                        : draw_.log_uniform(0.003, 0.01)) /
                    frequency_;
    constexpr int kOutputs = 8;
    constexpr int kStepsBetween = 12;
    settings.end_time = kOutputs * kStepsBetween * settings.step;
    for (int i = 0; i <= kOutputs; ++i) {
      settings.output_times.push_back(i * kStepsBetween * settings.step);
    }
    if (traits.is_adaptive && draw_.chance(0.25)) {
      settings.tolerance = size_ * draw_.log_uniform(1e-5, 1e-3);
      settings.step = settings.end_time;
    }
    return settings;
  }

  unsigned seed_;
  RandomDraw draw_;
  ScenePlan plan_;
  double size_ = 1.0;
  double mass_ = 1.0;
  double frequency_ = 1.0;  // [rad/s]
  bool is_free_ = false;
  Matrix3 R_ = Matrix3::Identity();
  Vector3 spin_ = Vector3::Zero();
  Vector3 v_ = Vector3::Zero();
  std::vector<int> parents_;
};

}  // namespace

ScenePlan draw_plan(unsigned seed) { return PlanDraw(seed).draw(); }

}  // namespace limber::metamorphic
