// SPDX-License-Identifier: BSD-3-Clause
#include "metamorphic/scene_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::metamorphic {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

Output observe(const dynamics::SystemModel& model,
               const dynamics::SystemState& state,
               const dynamics::EnergyBalance& energy) {
  Output output{state.t, {}, energy};
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const dynamics::BodyState& body = state.bodies[b];
    const int first = model.bodies[b].offset;
    const int modes = model.bodies[b].modes;
    output.bodies.push_back(
        {body.p_WB, body.quat_WB.toRotationMatrix(), body.v_WB_W, body.w_WB_B,
         state.eta.segment(first, modes), state.etadot.segment(first, modes)});
  }
  return output;
}

bool has_break(const std::vector<double>& times, const Scene& scene) {
  return std::any_of(times.begin(), times.end(), [&](double t) {
    return t > 0.0 && t < scene.settings.end_time;
  });
}

bool has_break(const Scene& scene) {
  const dynamics::SystemModel& model = scene.model;
  return !model.controllers.empty() ||
         std::any_of(model.loads.begin(), model.loads.end(),
                     [&](const dynamics::Load& load) {
                       return has_break(break_times(load.function), scene);
                     }) ||
         std::any_of(model.couplers.begin(), model.couplers.end(),
                     [&](const dynamics::Coupler& coupler) {
                       return has_break(joints::break_times(coupler.law),
                                        scene);
                     });
}

std::size_t find(const Motion& motion, const std::string& name) {
  const auto at = std::find(motion.names.begin(), motion.names.end(), name);
  return static_cast<std::size_t>(at - motion.names.begin());
}

// Outputs of another run are rounded, or fewer.
const Output& find_output(const Motion& motion, double t) {
  return *std::min_element(motion.outputs.begin(), motion.outputs.end(),
                           [&](const Output& a, const Output& b) {
                             return std::abs(a.t - t) < std::abs(b.t - t);
                           });
}

// Keeps NaN.
void include(double value, double& largest) {
  if (!(value <= largest)) largest = value;
}

void include(const BodyPlan& body, const BodyMotion& a, const BodyMotion& b,
             Difference& difference) {
  const double l = body.length;
  const double root = std::sqrt(body.mass);
  include((a.p_WB - b.p_WB).norm(), difference.position);
  include(l * (a.R_WB - b.R_WB).norm(), difference.position);
  include((a.eta - b.eta).norm() / root, difference.position);
  include((a.v_WB_W - b.v_WB_W).norm(), difference.velocity);
  include(l * (a.w_WB_B - b.w_WB_B).norm(), difference.velocity);
  include((a.etadot - b.etadot).norm() / root, difference.velocity);
  ++difference.compared;
}

void include(const dynamics::EnergyBalance& a, const dynamics::EnergyBalance& b,
             Difference& difference) {
  include(std::abs(a.elastic - b.elastic), difference.strain);
  include(std::abs(a.coupler - b.coupler), difference.strain);
  include(std::abs(a.kinetic_rigid + a.kinetic_modal - b.kinetic_rigid -
                   b.kinetic_modal),
          difference.energy);
  include(std::abs(a.work - b.work), difference.energy);
  include(std::abs(a.dissipated - b.dissipated), difference.energy);
  include(difference.strain, difference.energy);
}

double find_force(const ScenePlan& plan) {
  double force = 0.0;
  for (const BodyPlan& b : plan.bodies) force += b.mass * plan.gravity_W.norm();
  for (const LoadPlan& l : plan.loads) force += l.force.norm();
  return force;
}

}  // namespace

Motion run(const ScenePlan& plan) {
  Motion motion;
  for (const BodyPlan& b : plan.bodies) motion.names.push_back(b.name);
  try {
    Scene scene = build(plan);
    motion.has_jumps = has_break(scene);
    const dynamics::SimulationStatistics statistics = dynamics::simulate(
        scene.model, scene.state, scene.settings,
        [&](const dynamics::SystemState& state,
            const dynamics::EnergyBalance& energy) {
          motion.outputs.push_back(observe(scene.model, state, energy));
        });
    motion.steps = statistics.steps;
    motion.has_halved_steps = statistics.halved_steps > 0;
    motion.has_events = !statistics.events.empty();
  } catch (const InputError& error) {
    motion.refusal = error.what();
  } catch (const NumericalError& error) {
    motion.refusal = error.what();
  }
  return motion;
}

Difference compare(const ScenePlan& plan, const Motion& first,
                   const Motion& other) {
  Difference difference;
  for (const Output& b : other.outputs) {
    const Output& a = find_output(first, b.t);
    include(a.energy, b.energy, difference);
    for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
      const std::size_t j = find(other, plan.bodies[i].name);
      include(plan.bodies[i], a.bodies[i], b.bodies.at(j), difference);
    }
  }
  return difference;
}

Magnitude measure(const ScenePlan& plan, const Motion& motion) {
  Magnitude largest;
  largest.force = find_force(plan);
  for (const Output& output : motion.outputs) {
    for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
      const BodyMotion& b = output.bodies[i];
      const double l = plan.bodies[i].length;
      const double root = std::sqrt(plan.bodies[i].mass);
      include(b.p_WB.norm() + l, largest.length);
      include(b.v_WB_W.norm() + l * b.w_WB_B.norm() + b.etadot.norm() / root,
              largest.speed);
    }
    const dynamics::EnergyBalance& e = output.energy;
    include(e.total() + std::abs(e.work) + e.dissipated, largest.energy);
  }
  return largest;
}

ScenePlan disturb(ScenePlan plan, double place, double speed,
                  RandomDraw& draw) {
  const double x = kEps * place;
  const double v = kEps * speed;
  for (BodyPlan& body : plan.bodies) {
    const double root = std::sqrt(body.mass);
    body.X_WB.p += x * draw.direction();
    const Vector3 turn = x / body.length * draw.direction();
    body.X_WB.R = body.X_WB.R * exp_rotation(turn);
    body.v_WB_W += v * draw.direction();
    body.w_WB_B += v / body.length * draw.direction();
    for (double& q : body.eta) q += draw.chance(0.5) ? root * x : -root * x;
    for (double& q : body.etadot) q += draw.chance(0.5) ? root * v : -root * v;
  }
  for_each_frame(plan, [&](FramePlan& f) {
    if (f.body < 0) f.X.p += x * draw.direction();
  });
  return plan;
}

}  // namespace limber::metamorphic
