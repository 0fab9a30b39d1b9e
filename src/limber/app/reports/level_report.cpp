// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/level_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

namespace limber::app {
namespace {

using dynamics::Fidelity;
using dynamics::Peak;

/// The boundaries of one body; empty if they do not exist.
struct Boundaries {
  std::optional<double> report_displacement;  ///< |alpha| + |Omega|^2 [1/s^2]
  std::optional<double> report_linear;
  std::optional<double> report_force;
  std::optional<double> bound_displacement;  ///< Omega at alpha = 0 [rad/s]
  std::optional<double> bound_linear;
  std::optional<double> bound_force;
  std::optional<double> margin;  ///< of the bound at the peaks [-]
};

Boundaries find_boundaries(const runs::BodyLevel& level) {
  Boundaries result;
  if (level.reduced->clamped) return result;
  const flexbody::InertialLevers& levers = level.reduced->levers;
  const dynamics::LevelLimits& limits = level.limits;
  if (levers.displacement > 0.0 && level.bound) {
    result.report_displacement = limits.displacement / levers.displacement;
    result.report_linear = limits.linear_limit / levers.displacement;
    result.bound_displacement =
        level.bound->find_omega(0.0, limits.displacement);
    result.bound_linear = level.bound->find_omega(0.0, limits.linear_limit);
    // Both at their peaks: in the mean-axis frame alpha causes no deformation.
    result.margin = level.bound->calc_margin(
        level.peaks.alpha.value, level.peaks.Omega.value, limits.displacement);
  }
  if (limits.force && levers.lumped > 0.0) {
    result.report_force = *limits.force / levers.lumped;
  }
  if (limits.force && levers.consistent > 0.0) {
    result.bound_force = std::sqrt(*limits.force / levers.consistent);
  }
  return result;
}

Json describe_peak(const Peak& peak) {
  return Json{{"value", peak.value}, {"time", peak.time}};
}

Json describe_boundaries(const runs::BodyLevel& level) {
  const Boundaries b = find_boundaries(level);
  const auto over = [](double value, const std::optional<double>& limit) {
    return limit ? Json(value / *limit) : Json(nullptr);
  };
  return Json{
      {"report",
       {{"displacement", or_null(b.report_displacement)},
        {"linear_limit", or_null(b.report_linear)},
        {"force", or_null(b.report_force)},
        {"margin", over(level.peaks.report.value, b.report_displacement)}}},
      {"rigorous",
       {{"displacement", or_null(b.bound_displacement)},
        {"linear_limit", or_null(b.bound_linear)},
        {"force", or_null(b.bound_force)},
        {"margin", or_null(b.margin)},
        {"force_margin", over(level.peaks.force.value, level.limits.force)}}}};
}

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string("-");
}

std::string describe_rotation(const runs::BodyLevel& level) {
  if (level.reduced->clamped) {
    return "  clamped to the world: no rotation, no boundary\n";
  }
  const dynamics::BodyPeaks& peaks = level.peaks;
  const Boundaries b = find_boundaries(level);
  std::string text = fmt::format(
      "  peaks        alpha {:.3g} rad/s^2 at {:.4g} s, Omega {:.3g} rad/s at "
      "{:.4g} s, rotated {:.3g} rad\n",
      peaks.alpha.value, peaks.alpha.time, peaks.Omega.value, peaks.Omega.time,
      peaks.angle);
  text += fmt::format(
      "  boundary     report: alpha + Omega^2 <= {} 1/s^2, linear to {}; peak "
      "{:.3g}\n"
      "               bound:  Omega <= {} rad/s at any alpha, linear to {}; "
      "margin {}\n",
      number(b.report_displacement), number(b.report_linear),
      peaks.report.value, number(b.bound_displacement), number(b.bound_linear),
      number(b.margin));
  if (level.limits.force) {
    text += fmt::format(
        "  force        report: alpha + Omega^2 <= {} 1/s^2; bound: Omega <= "
        "{} rad/s; peak {:.3g} of {:.3g} N\n",
        number(b.report_force), number(b.bound_force), peaks.force.value,
        *level.limits.force);
  }
  return text;
}

/// A TOML key, quoted only if necessary.
std::string to_key(const std::string& name) {
  const bool is_bare =
      !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
               c == '-';
      });
  return is_bare ? name : Json(name).dump();
}

}  // namespace

Json to_json(const runs::BodyLevel& level) {
  const dynamics::BodyPeaks& peaks = level.peaks;
  const dynamics::LevelAdvice& advice = level.advice;
  Json json = Json::object();
  json["body"] = level.name;
  json["used"] = to_string(level.used);
  json["recommended"] = to_string(advice.level);
  json["justified"] = level.is_justified();
  json["more_than_needed"] = level.is_more_than_needed();
  json["beyond_linear_range"] = advice.is_beyond_linear;
  json["reason"] = advice.reason;
  json["limits"] = {{"displacement", level.limits.displacement},
                    {"linear_limit", level.limits.linear_limit},
                    {"force", or_null(level.limits.force)}};
  json["peaks"] = {
      {"alpha", describe_peak(peaks.alpha)},
      {"omega", describe_peak(peaks.Omega)},
      {"alpha_plus_omega_squared", describe_peak(peaks.report)},
      {"nodal_inertial_force", describe_peak(peaks.force)},
      {"angle", peaks.angle},
      {"deformation", describe_peak(peaks.deformation)},
      {"displacement", describe_peak(peaks.total)},
      {"interface_rotation", describe_peak(peaks.rotation)},
      {"relative_interface_rotation", describe_peak(peaks.relative_rotation)},
      {"static_displacement_of_loads", describe_peak(peaks.loads)},
      {"static_displacement_of_inertia", describe_peak(peaks.inertial)}};
  if (level.bound) json["boundary"] = describe_boundaries(level);
  // Axial load over that at which the body buckles.
  json["load_factor"] = {{"tension", describe_peak(peaks.tension)},
                         {"compression", describe_peak(peaks.compression)}};
  json["left_out"] = {{"rigid", advice.errors.rigid},
                      {"uncoupled", advice.errors.uncoupled},
                      {"one-way", advice.errors.one_way},
                      {"coupled", advice.errors.coupled},
                      {"nonlinear", advice.errors.nonlinear}};
  json["mean_strain"] = describe_peak(peaks.strain);
  if (!level.doubt.empty()) json["doubt"] = level.doubt;
  if (!level.impacts.empty()) json["impacts"] = Json::array();
  for (const dynamics::ImpactSpectrum& impact : level.impacts) {
    json["impacts"].push_back(
        Json{{"contact", impact.pair},
             {"duration", impact.duration},
             {"highest_frequency_hz", impact.frequency},
             {"periods", impact.fraction()},
             {"enough", impact.is_enough()},
             {"modes", impact.modes},
             {"modes_needed",
              impact.needed ? Json(*impact.needed) : Json(nullptr)}});
  }
  return json;
}

Json to_json(const runs::SceneAdvice& advice) {
  Json json = Json::object();
  json["scenario"] = advice.scenario;
  json["bodies"] = Json::array();
  for (const runs::BodyLevel& level : advice.levels) {
    json["bodies"].push_back(to_json(level));
  }
  json["fidelity_table"] = to_fidelity_table(advice.levels);
  json["warnings"] = advice.warnings;
  return json;
}

std::string to_text(const runs::BodyLevel& level) {
  const dynamics::BodyPeaks& peaks = level.peaks;
  const dynamics::LevelAdvice& advice = level.advice;
  std::string text = fmt::format(
      "{}, requested {}\n  neglect      {:.3g} m, linear to {:.3g} m\n",
      level.name, to_string(level.used), level.limits.displacement,
      level.limits.linear_limit);
  text += describe_rotation(level);
  text += fmt::format(
      "  displacement loads {:.3g} m at {:.4g} s, inertia {:.3g} m at {:.4g} s "
      "(static); with\n               oscillation {:.3g} m at {:.4g} s, of its "
      "own nodes {:.3g} m at {:.4g} s\n  left out     rigid {:.3g} m, "
      "uncoupled {:.3g} m, one-way {:.3g} m, coupled {:.3g} m,\n               "
      "nonlinear {:.3g} m\n  buckling     tension {:.3g}, compression {:.3g} "
      "of the load; interfaces rotate by {:.3g} rad\n",
      peaks.loads.value, peaks.loads.time, peaks.inertial.value,
      peaks.inertial.time, peaks.total.value, peaks.total.time,
      peaks.deformation.value, peaks.deformation.time, advice.errors.rigid,
      advice.errors.uncoupled, advice.errors.one_way, advice.errors.coupled,
      advice.errors.nonlinear, peaks.tension.value, peaks.compression.value,
      peaks.rotation.value);
  text += fmt::format("  recommended  {}: {}\n", to_string(advice.level),
                      advice.reason);
  for (const dynamics::ImpactSpectrum& impact : level.impacts) {
    text += fmt::format("  impact       {}\n", describe(impact));
  }
  if (!level.doubt.empty()) {
    text += fmt::format("  doubt        {}\n", level.doubt);
  }
  return text;
}

std::string to_fidelity_table(const std::vector<runs::BodyLevel>& levels) {
  std::map<Fidelity, int> counts;
  for (const runs::BodyLevel& level : levels) ++counts[level.advice.level];
  Fidelity usual = Fidelity::coupled;
  for (const auto& [level, count] : counts) {
    if (!counts.contains(usual) || count >= counts[usual]) usual = level;
  }
  std::string others;
  for (const runs::BodyLevel& level : levels) {
    if (level.advice.level == usual) continue;
    others += fmt::format("{}{} = \"{}\"", others.empty() ? "" : ", ",
                          to_key(level.name), to_string(level.advice.level));
  }
  std::string table =
      fmt::format("[fidelity]\ndefault = \"{}\"\n", to_string(usual));
  if (!others.empty()) table += "links = { " + others + " }\n";
  return table;
}

}  // namespace limber::app
