// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/failure_diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/monitors/deflection_observer.hpp"
#include "limber/dynamics/monitors/linear_limit.hpp"
#include "limber/dynamics/system/linked_groups.hpp"

namespace limber::dynamics {
namespace {

constexpr double kMostStepRotation = 1.0;  // of a body within a step [rad]

// Whether long steps are unstable and not always divided.
bool may_be_unstable(IntegratorKind integrator) {
  const IntegratorTraits& traits = traits_of(integrator);
  return !traits.is_implicit && traits.limit != StepLimit::stability;
}

std::string describe_stability(const SystemModel& model,
                               const SystemState& state,
                               IntegratorKind integrator, double h) {
  const double stable = find_stable_step(model, state);
  // The limit of Runge-Kutta is 1.4 times that of central differences.
  if (!(h > 1.5 * stable)) return {};
  if (integrator == IntegratorKind::splitting) {
    return fmt::format(
        "the step of {:.3g} s may be too long for the couplers, which "
        "splitting treats explicitly; one of {:.3g} s resolves all motion",
        h, stable);
  }
  return fmt::format(
      "the step of {:.3g} s is too long for an explicit scheme, which is "
      "stable up to about {:.3g} s at t = {:.6g} s",
      h, stable, state.t);
}

std::string describe_overpowered(const SystemModel& model,
                                 const SystemState& state) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  DeflectionObserver observer(model);
  observer.include(state, terms);
  return observer.find_overpowered().value_or("");
}

std::string describe_rotation(const SystemModel& model,
                              const SystemState& state, double h) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double rotation = h * state.bodies[b].w_WB_B.norm();
    if (rotation > kMostStepRotation) {
      return fmt::format(
          "body '{}' rotates at {:.4g} rad/s, {:.3g} rad within a step of "
          "{:.3g} s",
          model.bodies[b].name, state.bodies[b].w_WB_B.norm(), rotation, h);
    }
  }
  return {};
}

// Of the controllers that the law of a coupler or transmission follows.
std::string name_controllers(const SystemModel& model,
                             const std::vector<int>& inputs) {
  std::vector<std::string> names;
  for (const ControllerModel& controller : model.controllers) {
    for (const int input : controller.writes) {
      if (std::find(inputs.begin(), inputs.end(), input) == inputs.end()) {
        continue;
      }
      names.push_back(fmt::format("'{}', period {:.4g} s", controller.name,
                                  controller.period));
    }
  }
  return names.empty()
             ? ""
             : fmt::format(" (controller {})", fmt::join(names, " and "));
}

std::string name_loads(const SystemModel& model, std::size_t body) {
  std::vector<std::string> names;
  if (!model.gravity_W.isZero(0.0)) names.emplace_back("weight");
  for (const Load& load : model.loads) {
    if (model.attachments[index(load.where)].body != static_cast<int>(body)) {
      continue;
    }
    const auto* follows = std::get_if<InputFunction>(&load.function);
    names.push_back(
        "'" + load.name + "'" +
        (follows == nullptr ? "" : name_controllers(model, {follows->input})));
  }
  for (const BodyLoad& load : model.body_loads) {
    if (load.body == static_cast<int>(body)) {
      names.push_back("'" + load.name + "'");
    }
  }
  return fmt::format("the loads ({}) on body '{}'", fmt::join(names, ", "),
                     model.bodies[body].name);
}

// @param supplied in the rows of EnergyRows [W]
std::string describe_power(const SystemModel& model, const VectorX& supplied) {
  if (supplied.size() == 0 || !supplied.allFinite()) return "";
  const EnergyRows rows(model);
  Eigen::Index row = 0;
  const double most = supplied.cwiseAbs().maxCoeff(&row);
  if (!(most > 0.0)) return "";
  std::string who;
  if (row < rows.couplers) {
    who = name_loads(model, static_cast<std::size_t>(row));
  } else if (row < rows.transmissions) {
    const Coupler& coupler =
        model.couplers[static_cast<std::size_t>(row - rows.couplers)];
    who = fmt::format("the drive of joint '{}'", coupler.name) +
          name_controllers(model, joints::find_inputs(coupler.law));
  } else {
    const Transmission& line =
        model.transmissions[static_cast<std::size_t>(row - rows.transmissions)];
    std::vector<int> inputs;
    for (const auto& law : line.laws) {
      const std::vector<int> own = joints::find_inputs(law);
      inputs.insert(inputs.end(), own.begin(), own.end());
    }
    who = fmt::format("the drive of tendon '{}'", line.name) +
          name_controllers(model, inputs);
  }
  return fmt::format("; the largest power is that of {}: {:.3g} W", who,
                     supplied[row]);
}

// The pair with the largest force.
std::string describe_push(const SystemModel& model, const SystemTerms& terms) {
  double most = 0.0;
  std::size_t pair = 0;
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    Vector3 force = Vector3::Zero();
    for (const auto& point : terms.pairs.responses[i].points()) {
      force += point.force_W;
    }
    if (!(force.norm() > most)) continue;
    most = force.norm();
    pair = i;
  }
  if (most == 0.0) return "";
  return fmt::format("; contact '{}' pushes with {:.3g} N",
                     model.pairs[pair].name, most);
}

}  // namespace

std::string find_cause(const SystemModel& model, const SystemState& state,
                       IntegratorKind integrator, double h) {
  if (may_be_unstable(integrator)) {
    try {
      std::string text = describe_stability(model, state, integrator, h);
      if (!text.empty()) return text;
    } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
      // The state is too corrupted to evaluate.
    }
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto soft =
        describe_softening(model.bodies[b], state.bodies[b].w_WB_B);
    if (soft) return *soft;
    const auto bent = describe_large_rotation(model, state, b);
    if (bent) return *bent;
  }
  try {
    std::string text = describe_overpowered(model, state);
    if (!text.empty()) return text;
  } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
    // A joint whose axis is reversed names itself.
  }
  return describe_rotation(model, state, h);
}

std::string find_start_clash(const SystemModel& model, const SystemState& state,
                             const SystemTerms& terms, double h) {
  constexpr double kMuch = 10.0;
  std::string clash;
  double most = 0.0;
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    const double power = terms.couplers[c].response.dissipation;
    if (power <= most) continue;
    const double relative = find_relative_kinetic(
        model, state, find_joined_bodies(model, model.couplers[c]));
    if (!(h * power > kMuch * relative)) continue;
    most = power;
    clash = fmt::format(
        "bodies start with velocities that coupler '{}' does not allow: its "
        "damper dissipates {:.3g} W at the start, and their relative motion "
        "has {:.3g} J; start with compatible velocities, or with less damping "
        "there",
        model.couplers[c].name, power, relative);
  }
  return clash;
}

std::string find_driver(const SystemModel& model, const SystemState& state) {
  SystemTerms terms = make_terms(model);
  try {
    calc_terms(model, state, Side::right, terms);
  } catch (const NumericalError&) {
    return "";  // too corrupted to evaluate
  }
  EnergyFlows powers = make_flows(model);
  powers.clear();
  add_powers(terms, 1.0, powers);
  return describe_power(model, powers.supplied) + describe_push(model, terms);
}

std::string find_most_energy(const SystemModel& model,
                             const SystemState& state) {
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  const std::vector<Vector3> drifts = find_drifts(model, state);
  double most = -1.0;
  std::string where;
  const auto offer = [&](double energy, const auto& name) {
    if (energy <= most) return;
    most = energy;
    where = name();
  };
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const BodyState& rigid = state.bodies[b];
    offer(0.5 * body.mass * (rigid.v_WB_W - drifts[b]).squaredNorm() +
              0.5 * rigid.w_WB_B.dot(terms.bodies[b].J * rigid.w_WB_B),
          [&] { return fmt::format("the motion of body '{}'", body.name); });
    const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity);
    if (lambda == nullptr) {
      const auto eta = state.eta.segment(body.offset, body.modes);
      const auto etadot = state.etadot.segment(body.offset, body.modes);
      offer(flexbody::calc_elastic_energy(body.elasticity, eta) +
                0.5 * etadot.squaredNorm(),
            [&] { return fmt::format("the modes of body '{}'", body.name); });
      continue;
    }
    for (int k = 0; k < body.modes; ++k) {
      const double eta = state.eta[body.offset + k];
      const double etadot = state.etadot[body.offset + k];
      offer(0.5 * ((*lambda)[k] * eta * eta + etadot * etadot), [&] {
        return fmt::format("mode {} ({:.4g} Hz) of body '{}'", k + 1,
                           std::sqrt((*lambda)[k]) / (2.0 * std::numbers::pi),
                           body.name);
      });
    }
  }
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    offer(terms.couplers[c].response.energy,
          [&] { return fmt::format("coupler '{}'", model.couplers[c].name); });
  }
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    offer(terms.pairs.responses[i].energy,
          [&] { return fmt::format("pair '{}'", model.pairs[i].name); });
  }
  return where;
}

}  // namespace limber::dynamics
