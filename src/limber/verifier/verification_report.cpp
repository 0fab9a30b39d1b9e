// SPDX-License-Identifier: BSD-3-Clause
#include "limber/verifier/verification_report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace limber::app {
namespace {

using reference::Agreement;
using reference::Magnitudes;
using reference::Verification;

Json to_json(const Magnitudes& m) {
  return Json{{"position", m.position},
              {"rotation", m.rotation},
              {"velocity", m.velocity},
              {"angular_velocity", m.angular_velocity}};
}

/// Ratios to the motion; null for quantities without motion.
Magnitudes divide(const Magnitudes& a, const Magnitudes& b) {
  return {a.position / b.position, a.rotation / b.rotation,
          a.velocity / b.velocity, a.angular_velocity / b.angular_velocity};
}

double find_relative(const Agreement& run, const Verification& result) {
  return reference::find_relative(run.largest, result.motion);
}

/// log2 of the reduction of the difference when the step was halved.
double find_order(const Verification& result, std::size_t i) {
  return std::log2(find_relative(result.runs[i - 1], result) /
                   find_relative(result.runs[i], result));
}

Json to_json(const Verification& result, std::size_t i) {
  const Agreement& run = result.runs[i];
  Json bodies = Json::object();
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    bodies[result.bodies[b]] = to_json(run.bodies[b]);
  }
  Json json{{"step", run.step},
            {"difference", bodies},
            {"largest", to_json(run.largest)},
            {"relative", to_json(divide(run.largest, result.motion))},
            {"largest_relative", find_relative(run, result)},
            {"energy", run.energy},
            {"energy_relative", run.energy / result.energy}};
  if (i > 0) json["order"] = find_order(result, i);
  return json;
}

std::string verification_row(const std::string& name, const Magnitudes& m) {
  const auto cell = [](double x) {
    return std::isfinite(x) ? fmt::format("{:.3g}", x) : std::string("-");
  };
  return fmt::format("{:<24} {:>14} {:>14} {:>14} {:>14}\n", name,
                     cell(m.position), cell(m.rotation), cell(m.velocity),
                     cell(m.angular_velocity));
}

std::string body_table(const Verification& result) {
  const Agreement& run = result.runs.back();
  std::string text = fmt::format(
      "{:<24} {:>14} {:>14} {:>14} {:>14}\n", "largest difference",
      "position [m]", "angle [rad]", "velocity [m/s]", "spin [rad/s]");
  for (std::size_t b = 0; b < run.bodies.size(); ++b) {
    text += verification_row(result.bodies[b], run.bodies[b]);
  }
  text += verification_row("all bodies", run.largest);
  text += verification_row("largest motion", result.motion);
  text += verification_row("relative", divide(run.largest, result.motion));
  return text + fmt::format(
                    "energy: largest difference {:.3g} J of {:.3g} J "
                    "(kinetic and in couplers)\n",
                    run.energy, result.energy);
}

std::string step_table(const Verification& result) {
  std::string text = fmt::format("\n{:>12} {:>12} {:>8} {:>14}\n", "step [s]",
                                 "relative", "order", "energy, rel.");
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    const Agreement& run = result.runs[i];
    text +=
        fmt::format("{:>12.4g} {:>12.3g} {:>8} {:>14.3g}\n", run.step,
                    find_relative(run, result),
                    i == 0 ? "" : fmt::format("{:.2f}", find_order(result, i)),
                    run.energy / result.energy);
  }
  return text;
}

std::string joints_name(const VerificationReport& report) {
  return reference::joint_model_names()[static_cast<std::size_t>(
      report.options.simbody.joints)];
}

}  // namespace

Json to_json(const VerificationReport& report) {
  const Verification& result = report.result;
  Json runs = Json::array();
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    runs.push_back(to_json(result, i));
  }
  Json json{{"scenario", report.scenario},
            {"reference", reference::simbody_name()},
            {"joints", joints_name(report)},
            {"accuracy", report.options.simbody.accuracy},
            {"reference_steps", result.simbody_steps},
            {"integrator", dynamics::to_string(report.integrator)},
            {"motion", to_json(result.motion)},
            {"energy", result.energy},
            {"runs", runs}};
  if (report.tolerance > 0.0) json["tolerance"] = report.tolerance;
  return json;
}

std::string describe_runs(const VerificationReport& report) {
  const Verification& result = report.result;
  const std::string steps =
      report.tolerance > 0.0
          ? fmt::format("tolerance {:.3g} m", report.tolerance)
          : fmt::format("step {:g} s", result.runs.back().step);
  return fmt::format(
      "{}: joints {}, accuracy {:g}, {} steps\n"
      "limber: level rigid, {}, {}\n\n",
      reference::simbody_name(), joints_name(report),
      report.options.simbody.accuracy, result.simbody_steps,
      dynamics::to_string(report.integrator), steps);
}

std::string to_text(const VerificationReport& report) {
  const Verification& result = report.result;
  std::string text = describe_runs(report) + body_table(result);
  if (result.runs.size() > 1) text += step_table(result);
  return text;
}

}  // namespace limber::app
