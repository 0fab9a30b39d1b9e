// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"

namespace limber::bench {
namespace {

using dynamics::MotionScale;
using dynamics::SystemState;
using States = std::vector<SystemState>;

constexpr double kAccurate = 0.01;   // of the range
constexpr double kGarbage = 10.0;    // of it
constexpr double kConverged = 1e-3;  // of it
constexpr double kShortSteps = 1e4;  // of a span, if no tolerance is kept

bool is_finite(const SystemState& state) {
  return state.eta.allFinite() && state.etadot.allFinite() &&
         std::all_of(state.bodies.begin(), state.bodies.end(),
                     [](const dynamics::BodyState& body) {
                       return body.p_WB.allFinite() &&
                              body.quat_WB.coeffs().allFinite() &&
                              body.v_WB_W.allFinite() &&
                              body.w_WB_B.allFinite();
                     });
}

struct Run {
  States states;
  bool is_finite = true;
  dynamics::SimulationStatistics statistics;
};

Run run(const Scene& scene, const dynamics::SimulationSettings& settings) {
  Run result;
  SystemState state = scene.state;
  result.statistics = dynamics::simulate(
      scene.model, state, settings,
      [&](const SystemState& now, const dynamics::EnergyBalance& energy) {
        result.is_finite =
            result.is_finite && is_finite(now) && std::isfinite(energy.total());
        result.states.push_back(now);
      });
  return result;
}

double find_range(const MotionScale& scale, const States& states) {
  double range = 0.0;
  for (const SystemState& state : states) {
    range = std::max(
        range, scale.measure_distance(states.front(), state).displacement);
  }
  return range;
}

double find_distance(const MotionScale& scale, const States& a,
                     const States& b) {
  double distance = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = scale.measure_distance(a[i], b[i]).displacement;
    if (!(d <= distance)) distance = d;  // so that NaN counts
  }
  return distance;
}

// The range is not known beforehand, so that the first tolerance is a guess.
Reference run_to_tolerance(const Scene& scene, double length) {
  const MotionScale scale(scene.model);
  dynamics::SimulationSettings settings = scene.settings;
  settings.integrator = dynamics::IntegratorKind::generalized_alpha;
  settings.step = settings.end_time;
  settings.tolerance = 1e-3 * length;
  settings.passes = dynamics::TolerancePasses::verified;
  constexpr int kTrials = 4;
  for (int i = 0; i < kTrials; ++i) {
    const Run result = run(scene, settings);
    const double range = find_range(scale, result.states);
    const double error = result.statistics.estimated_error / range;
    if (error <= 2.0 * kConverged) {
      return {result.states, range, error, "tolerance", ""};
    }
    settings.tolerance = kConverged * range;
  }
  throw NumericalError("no run converges");
}

Reference run_short_steps(const Scene& scene) {
  const MotionScale scale(scene.model);
  dynamics::SimulationSettings settings = scene.settings;
  settings.integrator = dynamics::IntegratorKind::generalized_alpha;
  settings.step = settings.end_time / kShortSteps;
  const Run coarse = run(scene, settings);
  settings.step *= 0.5;
  const Run fine = run(scene, settings);
  const double range = find_range(scale, fine.states);
  const double error =
      find_distance(scale, coarse.states, fine.states) / 3.0 / range;
  if (!(error <= 2.0 * kConverged)) {
    throw NumericalError(
        fmt::format("steps of {:g} s and half of it differ by {:.2g} of the "
                    "range",
                    2.0 * settings.step, 3.0 * error));
  }
  return {fine.states, range, error, "short steps", ""};
}

void put(std::string& bytes, const double* values, Eigen::Index count) {
  bytes.append(reinterpret_cast<const char*>(values),
               static_cast<std::size_t>(count) * sizeof(double));
}

// Numbers as they are in memory: the reader is the same program.
std::string pack(const Reference& reference) {
  const States& states = reference.states;
  const double head[] = {reference.range,
                         reference.error,
                         static_cast<double>(states.size()),
                         static_cast<double>(states[0].bodies.size()),
                         static_cast<double>(states[0].eta.size()),
                         reference.method == "tolerance" ? 1.0 : 0.0};
  std::string bytes;
  put(bytes, head, std::size(head));
  for (const SystemState& state : states) {
    for (const dynamics::BodyState& body : state.bodies) {
      put(bytes, body.p_WB.data(), 3);
      put(bytes, body.quat_WB.coeffs().data(), 4);
    }
    put(bytes, state.eta.data(), state.eta.size());
  }
  return bytes;
}

Reference unpack(const std::string& bytes) {
  const char* at = bytes.data();
  const auto get = [&at](double* values, Eigen::Index count) {
    const auto size = static_cast<std::size_t>(count) * sizeof(double);
    std::memcpy(values, at, size);
    at += size;
  };
  double head[6];
  get(head, std::size(head));
  Reference reference;
  reference.range = head[0];
  reference.error = head[1];
  reference.method = head[5] > 0.0 ? "tolerance" : "short steps";
  reference.states.resize(static_cast<std::size_t>(head[2]));
  for (SystemState& state : reference.states) {
    state.bodies.resize(static_cast<std::size_t>(head[3]));
    for (dynamics::BodyState& body : state.bodies) {
      get(body.p_WB.data(), 3);
      get(body.quat_WB.coeffs().data(), 4);
    }
    state.eta.resize(static_cast<Eigen::Index>(head[4]));
    get(state.eta.data(), state.eta.size());
  }
  return reference;
}

std::string tell(Class kind, double error, const std::string& text) {
  return fmt::format("{} {:.6g} {}", static_cast<int>(kind), error, text);
}

std::string judge_run(const Cell& cell, const Beams& beams,
                      const Reference& reference) {
  const Scene scene = make_scene(cell, beams);
  const Run result = run(scene, scene.settings);
  if (!result.is_finite) {
    return tell(Class::failed, -1.0, "an output is not finite");
  }
  if (!reference.exists()) {
    return tell(Class::inaccurate, -1.0, "no reference: " + reference.trouble);
  }
  const double error =
      find_distance(MotionScale(scene.model), result.states, reference.states) /
      reference.range;
  if (error < kAccurate) return tell(Class::accurate, error, "");
  if (error < kGarbage) {
    return tell(Class::inaccurate, error, "stable but inaccurate");
  }
  return tell(Class::failed, error, "garbage called a success");
}

}  // namespace

const char* to_string(Class kind) {
  constexpr const char* kNames[] = {"accurate", "inaccurate", "refused",
                                    "failed"};
  return kNames[static_cast<int>(kind)];
}

std::string name_reference(const Cell& cell) {
  return fmt::format("{} {:g} {:g} {:g} {:g} {:g} {:g} {:g} {:.9g}",
                     cell.bodies, cell.length, cell.slenderness,
                     cell.mass_ratio, cell.stiffness, cell.damping, cell.spin,
                     cell.pulse, find_span(cell));
}

std::string run_reference(const Cell& cell, const Beams& beams) {
  try {
    const Scene scene = make_scene(cell, beams);
    try {
      return "+" + pack(run_to_tolerance(scene, cell.length));
    } catch (const NumericalError&) {
      return "+" + pack(run_short_steps(scene));
    }
  } catch (const std::exception& error) {
    return std::string("-") + error.what();
  }
}

Reference read_reference(const Ending& ending) {
  Reference none;
  if (ending.kind != Ending::Kind::done) {
    none.trouble = ending.kind == Ending::Kind::hung
                       ? "it takes too long to converge"
                       : "it crashed";
    return none;
  }
  if (ending.answer[0] == '+') return unpack(ending.answer.substr(1));
  none.trouble = ending.answer.substr(1);
  return none;
}

std::string judge(const Cell& cell, const Beams& beams,
                  const Reference& reference) {
  try {
    return judge_run(cell, beams, reference);
  } catch (const InputError& error) {
    return tell(Class::refused, -1.0, error.what());
  } catch (const NumericalError& error) {
    return tell(Class::refused, -1.0, error.what());
  } catch (const std::exception& error) {
    return tell(Class::failed, -1.0, error.what());
  }
}

Verdict read_verdict(const Ending& ending) {
  Verdict verdict;
  verdict.seconds = ending.seconds;
  if (ending.kind != Ending::Kind::done) {
    verdict.text = ending.kind == Ending::Kind::hung ? "hung" : "crashed";
    return verdict;
  }
  std::istringstream stream(ending.answer);
  int kind = 0;
  stream >> kind >> verdict.error;
  stream.get();
  std::getline(stream, verdict.text, '\0');
  verdict.kind = static_cast<Class>(kind);
  return verdict;
}

}  // namespace limber::bench
