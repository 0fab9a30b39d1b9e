// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/control/closed_loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/control/pid_controller.hpp"
#include "limber/dynamics/control/saturation_observer.hpp"

namespace limber::scene {
namespace {

using dynamics::LoopController;
using dynamics::PidController;
using dynamics::SampledLoop;

constexpr Eigen::Index kMostStates = 600;
constexpr double kShortest = 1.0 / 64.0;    // of the periods
constexpr double kLongestFilter = 64.0;     // in periods
constexpr double kVisibleGrowth = 10.0;     // over a run
constexpr Eigen::Index kMostStepped = 400;  // states
constexpr int kMostSteps = 64;              // shortened to, of a step
// Growth by steps, above that of exact motion, that is one of steps alone.
constexpr double kFalseGrowth = 3.0;

// -1: none.
Eigen::Index find_row(const std::vector<dynamics::LinearSignal>& signals,
                      const std::string& name) {
  const auto found =
      std::find_if(signals.begin(), signals.end(),
                   [&](const auto& signal) { return signal.name == name; });
  return found == signals.end() ? -1 : found - signals.begin();
}

// Of the controllers' input `written`.
dynamics::LoopInput find_loop_input(const dynamics::LinearSystem& system,
                                    const dynamics::Input& input, int written) {
  const auto& inputs = system.inputs;
  const auto value =
      std::find_if(inputs.begin(), inputs.end(),
                   [&](const auto& one) { return one.written == written; });
  LIMBER_EXPECT(value != inputs.end());
  dynamics::LoopInput found{value - inputs.begin(), -1, input.hold};
  // Its rate follows, if anything depends on it (find_linear_inputs).
  const auto next = value + 1;
  if (next != inputs.end() && next->name == value->name + ".rate") {
    found.rate = found.value + 1;
  }
  return found;
}

const PidController& pid_of(const dynamics::ControllerModel& controller) {
  const auto* pid = dynamic_cast<const PidController*>(controller.law.get());
  LIMBER_EXPECT(pid != nullptr);
  return *pid;
}

// Why a controller cannot be in a linear loop; empty if it can.
std::string find_obstacle(const dynamics::ControllerModel& controller,
                          const LinearScene& linear) {
  if (dynamic_cast<const PidController*>(controller.law.get()) == nullptr) {
    return "it is a function, not a linear law";
  }
  for (const dynamics::Measurement& measured : controller.measures) {
    if (find_row(linear.model.outputs, measured.name) < 0) {
      return fmt::format("'{}', which it measures, has no linear model",
                         measured.name);
    }
  }
  return "";
}

// The reference with which a controller writes what it does at the state of the
// linear model, without error if it integrates.
double find_reference(const PidController& pid, const LoopController& made,
                      const LinearScene& linear) {
  const dynamics::PidParameters& p = pid.parameters();
  const auto measured = [&](std::size_t i) {
    return linear.model.outputs[index(static_cast<int>(made.measures[i]))]
        .value;
  };
  if (p.integral != 0.0 || p.proportional == 0.0) return measured(0);
  const double written =
      linear.system.inputs[index(static_cast<int>(made.writes.front().value))]
          .value;
  const double braked = p.has_rate ? p.derivative * measured(1) : 0.0;
  return measured(0) + (written + braked) / p.proportional;
}

LoopController make_loop_controller(const dynamics::SystemModel& model,
                                    const dynamics::ControllerModel& own,
                                    const LinearScene& linear) {
  const std::string obstacle = find_obstacle(own, linear);
  if (!obstacle.empty()) {
    throw InputError(
        fmt::format("controller '{}' cannot be in a linear closed loop: {}",
                    own.name, obstacle));
  }
  const PidController& pid = pid_of(own);
  LoopController made{own.name, own.period, own.offset, pid.linearise(),
                      {},       {},         {},         0.0};
  for (const dynamics::Measurement& measured : own.measures) {
    made.measures.push_back(find_row(linear.model.outputs, measured.name));
  }
  for (const int input : own.writes) {
    made.writes.push_back(
        find_loop_input(linear.system, model.inputs[index(input)], input));
  }
  made.reference_value = find_reference(pid, made, linear);
  const auto* follows =
      std::get_if<joints::InputSignal>(&pid.parameters().reference.base);
  if (follows != nullptr) {
    made.reference = {
        find_loop_input(linear.system, model.inputs[index(follows->input)],
                        follows->input)
            .value,
        follows->factor};
  }
  return made;
}

joints::ScalarLaw without_dry(const joints::ScalarLaw& law) {
  const auto* friction = std::get_if<joints::Friction>(&law);
  if (friction == nullptr) return law;
  joints::Friction::Parameters parameters = friction->parameters();
  parameters.coulomb = 0.0;
  return joints::Friction(parameters);
}

// Dry friction at rest is a large damper, which hides an unstable loop.
dynamics::SystemModel without_dry_friction(dynamics::SystemModel model) {
  for (dynamics::Coupler& coupler : model.couplers) {
    const auto* joint = std::get_if<joints::Joint>(&coupler.law);
    if (joint == nullptr) continue;
    joints::Joint::Parameters parameters = joint->parameters();
    for (joints::JointElement& element : parameters.elements) {
      element.law = without_dry(element.law);
    }
    coupler.law = joints::Joint(parameters.constraint, parameters.coordinates,
                                parameters.elements, parameters.is_ideal);
  }
  for (dynamics::Transmission& line : model.transmissions) {
    for (joints::ScalarLaw& law : line.laws) law = without_dry(law);
  }
  return model;
}

// The same controllers, some of them with other parameters.
template <typename Change>
std::vector<LoopController> change_laws(const dynamics::SystemModel& model,
                                        const ClosedLoop& loop,
                                        const std::vector<std::size_t>& changed,
                                        const Change& change) {
  std::vector<LoopController> controllers = loop.controllers;
  for (const std::size_t i : changed) {
    dynamics::PidParameters parameters =
        pid_of(model.controllers[i]).parameters();
    change(parameters);
    controllers[i].period = parameters.period;
    controllers[i].law = PidController(parameters).linearise();
  }
  return controllers;
}

// With other periods; a delay stays as long.
std::vector<LoopController> change_periods(
    const dynamics::SystemModel& model, const ClosedLoop& loop,
    const std::vector<std::size_t>& changed, double factor) {
  return change_laws(model, loop, changed, [factor](auto& parameters) {
    parameters.period *= factor;
    parameters.delay = static_cast<std::size_t>(
        std::lround(static_cast<double>(parameters.delay) / factor));
  });
}

// The shortest filter of the measurements, in doubled periods, that makes the
// loop stable.
std::optional<double> find_stable_filter(
    const dynamics::SystemModel& model, const ClosedLoop& loop,
    const std::vector<std::size_t>& changed, const Progress& progress) {
  const double period = loop.controllers[changed.front()].period;
  for (double factor = 1.0; factor <= kLongestFilter; factor *= 2.0) {
    report(progress, "search for a stable filter",
           std::log(factor) / std::log(kLongestFilter));
    SampledLoop trial(*loop.plant,
                      change_laws(model, loop, changed, [&](auto& parameters) {
                        parameters.filter_time = factor * period;
                      }));
    if (!trial.find_instability()) return factor * period;
  }
  return std::nullopt;
}

// The longest of the halves of the period that is stable: exact halves, which
// delays and the other periods are multiples of.
std::optional<double> find_stable_period(
    const dynamics::SystemModel& model, const ClosedLoop& loop,
    const std::vector<std::size_t>& changed, const Progress& progress) {
  const double period = loop.controllers[changed.front()].period;
  for (double factor = 0.5; factor >= kShortest; factor *= 0.5) {
    report(progress, "search for a stable period",
           std::log(2.0 * factor) / std::log(kShortest));
    try {
      SampledLoop trial(*loop.plant,
                        change_periods(model, loop, changed, factor));
      if (!trial.find_instability()) return factor * period;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch)
      // No common period with the others.
    }
  }
  return std::nullopt;
}

std::string describe_loops(const dynamics::SystemModel& model,
                           const std::vector<std::size_t>& loops) {
  std::vector<std::string> names;
  for (const std::size_t i : loops) {
    const dynamics::ControllerModel& own = model.controllers[i];
    names.push_back(fmt::format(
        "'{}' ({}, period {:.4g} s)", own.name,
        dynamics::name_followers(model, own.writes.front()), own.period));
  }
  return fmt::format("controller{} {}", names.size() == 1 ? "" : "s",
                     fmt::join(names, " and "));
}

std::string describe_remedy(const dynamics::SystemModel& model,
                            const ClosedLoop& loop,
                            const SampledLoop::Instability& found,
                            const Progress& progress) {
  if (const auto stable =
          find_stable_period(model, loop, found.loops, progress)) {
    return fmt::format("with a period of {:.6g} s it is stable", *stable);
  }
  if (found.loops.size() < loop.controllers.size()) {
    std::vector<std::size_t> all(loop.controllers.size());
    std::iota(all.begin(), all.end(), 0U);
    if (const auto stable = find_stable_period(model, loop, all, progress)) {
      return fmt::format("with all periods {:.3g} times as long it is stable",
                         *stable / loop.controllers.front().period);
    }
  }
  const std::string no_period =
      fmt::format("no period down to {:.2g} s makes it stable",
                  kShortest * loop.controllers[found.loops.front()].period);
  if (const auto filter =
          find_stable_filter(model, loop, found.loops, progress)) {
    return fmt::format("{}, but filter = {:.3g} does", no_period, *filter);
  }
  return no_period + ": check the signs and sizes of its gains and its delay";
}

// The steps of a run; none if they vary or are not those of generalized-alpha.
std::optional<dynamics::LoopSteps> find_steps(
    const dynamics::SimulationSettings& settings, Eigen::Index coordinates) {
  using enum dynamics::IntegratorKind;
  const bool is_alpha = settings.integrator == generalized_alpha;
  const bool is_euler = settings.integrator == implicit_euler;
  if (!(is_alpha || is_euler)) return {};
  if (settings.tolerance > 0.0 || !settings.step_changes.empty()) return {};
  return dynamics::LoopSteps{
      is_alpha ? dynamics::find_alpha_parameters(settings.rho_inf)
               : dynamics::AlphaParameters{},
      settings.step, coordinates};
}

double growth_of(const std::optional<SampledLoop::Instability>& found) {
  return found ? found->growth : 0.0;
}

/// A loop, and what of its growth matters.
struct Judged {
  const ClosedLoop& loop;
  const std::optional<SampledLoop::Instability>& exact;
  double visible = 0.0;  // least growth that is seen in the run [1/s]
  const Progress& progress;

  [[nodiscard]] std::optional<SampledLoop::Instability> find_false(
      const dynamics::LoopSteps& steps) const {
    SampledLoop stepped(*loop.plant, loop.controllers, steps);
    auto found = stepped.find_instability();
    const double most = std::max(visible, kFalseGrowth * growth_of(exact));
    if (!(growth_of(found) > most)) found.reset();
    return found;
  }
};

std::string find_better_step(const Judged& judged, dynamics::LoopSteps steps) {
  for (int parts = 2; parts <= kMostSteps; parts *= 2) {
    report(judged.progress, "search for a step",
           std::log(0.5 * parts) / std::log(kMostSteps));
    steps.longest *= 0.5;
    if (!judged.find_false(steps)) {
      return fmt::format("use a step of {:.3g} s", steps.longest);
    }
  }
  return "give the controller a filter";
}

// A vibration of modes that the steps do not resolve, whose phase at the
// samples is wrong.
std::optional<std::string> describe_false_vibration(
    const dynamics::SystemModel& model, const Judged& judged,
    const std::optional<dynamics::LoopSteps>& steps) {
  if (!steps || judged.loop.plant->A.rows() > kMostStepped) return {};
  const auto found = judged.find_false(*steps);
  if (!found) return {};
  const std::string truth =
      judged.exact
          ? fmt::format("grows tenfold in {:.2g} s; {}",
                        std::log(10.0) / judged.exact->growth,
                        describe_remedy(model, judged.loop, *judged.exact,
                                        judged.progress))
          : "is stable; " + find_better_step(judged, *steps);
  return fmt::format(
      "{}: with a step of {:.3g} s the sampled loop vibrates at {:.3g} Hz, "
      "growing tenfold in {:.2g} s; without errors of the steps it {}",
      describe_loops(model, found->loops), steps->longest, found->frequency,
      std::log(10.0) / found->growth, truth);
}

}  // namespace

ClosedLoop find_closed_loop(const dynamics::SystemModel& model,
                            const LinearScene& linear) {
  ClosedLoop loop;
  loop.plant = std::make_unique<const dynamics::LinearModel>(linear.model);
  for (const dynamics::ControllerModel& c : model.controllers) {
    loop.controllers.push_back(make_loop_controller(model, c, linear));
  }
  return loop;
}

std::string describe_instability(const dynamics::SystemModel& model,
                                 const ClosedLoop& loop,
                                 const SampledLoop::Instability& found,
                                 const Progress& progress) {
  return fmt::format(
      "{}: the sampled loop is unstable at {:.3g} Hz, growing tenfold in "
      "{:.2g} "
      "s; {}",
      describe_loops(model, found.loops), found.frequency,
      std::log(10.0) / found.growth,
      describe_remedy(model, loop, found, progress));
}

std::optional<std::string> describe_unstable_loop(
    const Scenario& scenario, const dynamics::SystemModel& model,
    const dynamics::SystemState& state, const std::vector<Probe>& probes,
    const dynamics::SimulationSettings& settings, const Progress& progress) {
  if (model.controllers.empty() || !model.full_bodies.empty()) {
    return std::nullopt;
  }
  // A controller that is sampled once closes no loop.
  const double duration = settings.end_time - state.t;
  if (std::ranges::any_of(model.controllers, [&](const auto& controller) {
        return 2.0 * controller.period > duration;
      })) {
    return std::nullopt;
  }
  constexpr auto kLimits =
      " (linear, about the start, without dry friction and limits)";
  try {
    const dynamics::SystemModel smooth = without_dry_friction(model);
    const LinearScene linear = linearise(scenario, smooth, state, probes);
    const ClosedLoop loop = find_closed_loop(smooth, linear);
    if (loop.plant->A.rows() > kMostStates) return std::nullopt;
    SampledLoop sampled(*loop.plant, loop.controllers);
    const auto found = sampled.find_instability();
    const double visible = std::log(kVisibleGrowth) / duration;
    auto text = describe_false_vibration(
        smooth, {loop, found, visible, progress},
        find_steps(settings, linear.system.coordinates));
    if (!text && growth_of(found) >= visible) {
      text = describe_instability(smooth, loop, *found, progress);
    }
    if (text) *text += kLimits;
    return text;
  } catch (const InputError&) {
    return std::nullopt;  // no linear model about this state
  } catch (const NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace limber::scene
