// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/dynamics/integrators/stable_step.hpp"

namespace limber::app {
namespace {

using dynamics::IntegratorKind;

constexpr std::size_t kMostLines = 12;  // of bodies
constexpr std::size_t kMostNamed = 4;   // joints, contacts, choices

double steps_a_period(const SceneCheck& check, double frequency) {
  return 1.0 / (frequency * check.settings.step);
}

bool has_tolerance(const SceneCheck& check) {
  return check.settings.tolerance > 0.0;
}

std::string to_size(std::size_t bytes) {
  return fmt::format("{:.2g} MB", static_cast<double>(bytes) * 1e-6);
}

/// The first few, and how many more.
std::string list_lines(const char* title, const std::vector<std::string>& lines,
                       std::size_t most = kMostNamed) {
  std::string text;
  for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) {
    text += fmt::format("{:<9} {}\n", title, lines[i]);
  }
  if (lines.size() > most) {
    text +=
        fmt::format("{:<9} and {} more (--json)\n", "", lines.size() - most);
  }
  return text;
}

std::string describe_bodies(const SceneCheck& check) {
  std::string text;
  for (std::size_t i = 0; i < std::min(check.bodies.size(), kMostLines); ++i) {
    const BodyCheck& body = check.bodies[i];
    text += fmt::format("  {:<24} {:<10} {:>10.4g} kg", body.name,
                        to_string(body.level), body.mass);
    if (body.frequencies) {
      text += fmt::format("  {:>3} modes, {:.4g} to {:.4g} Hz", body.modes,
                          body.frequencies->first, body.frequencies->second);
      if (!has_tolerance(check)) {
        text += fmt::format(", {:.2g} to {:.2g} steps a period",
                            steps_a_period(check, body.frequencies->first),
                            steps_a_period(check, body.frequencies->second));
      }
    }
    text += "\n";
  }
  if (check.bodies.size() > kMostLines) {
    text += fmt::format("  and {} more (--json)\n",
                        check.bodies.size() - kMostLines);
  }
  return text;
}

std::string describe_joints(const SceneCheck& check) {
  std::vector<JointCheck> joints = check.joints;
  std::erase_if(joints, [](const JointCheck& joint) {
    return !(joint.fastest_hz > 0.0);
  });
  std::stable_sort(joints.begin(), joints.end(),
                   [](const JointCheck& a, const JointCheck& b) {
                     return a.fastest_hz > b.fastest_hz;
                   });
  std::string text;
  for (std::size_t i = 0; i < std::min(joints.size(), kMostNamed); ++i) {
    text += fmt::format("{}'{}' {:.4g} Hz", i == 0 ? "" : ", ", joints[i].name,
                        joints[i].fastest_hz);
  }
  if (joints.size() > kMostNamed) {
    text += fmt::format(", and {} down to {:.4g} Hz",
                        joints.size() - kMostNamed, joints.back().fastest_hz);
  }
  return text.empty() ? "" : "joints    " + text + "\n";
}

/// What a scheme does with motion that its step does not resolve.
std::string describe_scheme(const dynamics::SimulationSettings& settings) {
  switch (settings.integrator) {
    case IntegratorKind::generalized_alpha:
      return fmt::format(
          "faster motion stays stable: its slow part is followed, its "
          "vibration damped by up to {:.0f} % a step (rho_inf)",
          100.0 * (1.0 - settings.rho_inf));
    case IntegratorKind::implicit_euler:
      return "faster motion stays stable: its slow part is followed, its "
             "vibration damped out";
    case IntegratorKind::energy_conserving:
      return "faster motion stays stable: its slow part is followed, its "
             "vibration neither resolved nor damped";
    case IntegratorKind::explicit_euler:
      return "faster motion grows, as does all vibration without dampers";
    case IntegratorKind::runge_kutta_4:
    case IntegratorKind::central_differences:
    case IntegratorKind::splitting:
      break;
  }
  return "";
}

std::string describe_stability(const SceneCheck& check) {
  const double step = check.settings.step;
  const double stable = *check.stable_step;
  if (step <= dynamics::kStableFraction * stable) {
    return fmt::format("stable up to steps of {:.3g} s", stable);
  }
  if (check.settings.integrator == IntegratorKind::central_differences) {
    return fmt::format(
        "stable up to steps of {:.3g} s: each is divided into {:.0f} parts",
        stable, std::ceil(step / (dynamics::kStableFraction * stable)));
  }
  return fmt::format(
      "guaranteed stable only up to steps of {:.3g} s: longer ones are divided "
      "where the motion grows",
      stable);
}

/// Whether the system vibrates faster than the step resolves; if that is not
/// known, too.
bool has_unresolved(const SceneCheck& check) {
  return check.frequencies.size() == 0 ||
         check.frequencies.maxCoeff() > check.resolved_hz();
}

std::string describe_system(const SceneCheck& check) {
  const VectorX& all = check.frequencies;
  const auto free = std::count_if(all.begin(), all.end(),
                                  [](double f) { return !(f > 0.0); });
  const auto vibrations = all.size() - free;
  if (vibrations == 0) return "";
  std::string text =
      fmt::format("system    {} frequencies at the start, {:.4g} to {:.4g} Hz",
                  vibrations, all[free], all[all.size() - 1]);
  if (!has_tolerance(check)) {
    const auto resolved = std::count_if(all.begin(), all.end(), [&](double f) {
      return f > 0.0 && f <= check.resolved_hz();
    });
    text += fmt::format(", {} of them resolved", resolved);
  }
  return text + "\n";
}

/// Steps end at samples of controllers.
std::string describe_samples(const SceneCheck& check) {
  if (check.controllers.empty()) return "";
  const ControllerCheck& fastest = *std::min_element(
      check.controllers.begin(), check.controllers.end(),
      [](const auto& a, const auto& b) { return a.period < b.period; });
  const bool cuts =
      has_tolerance(check) || fastest.period < check.settings.step;
  return fmt::format("          steps end at samples of {}, every {:.4g} s{}\n",
                     check.controllers.size() == 1
                         ? fmt::format("controller '{}'", fastest.name)
                         : fmt::format("{} controllers, most often of '{}'",
                                       check.controllers.size(), fastest.name),
                     fastest.period, cuts ? ": none is longer" : "");
}

std::string describe_step(const SceneCheck& check) {
  const dynamics::SimulationSettings& settings = check.settings;
  const std::string outputs = fmt::format("{:.4g} s in all, {} outputs",
                                          settings.end_time - check.start,
                                          settings.output_times.size());
  const std::string& scheme = to_string(settings.integrator);
  if (has_tolerance(check)) {
    return fmt::format("step      by the tolerance of {:.3g} m ({}), {}\n",
                       settings.tolerance, scheme, outputs) +
           describe_samples(check);
  }
  std::string text = fmt::format(
      "step      {:.3g} s ({}), {}\n          resolves motion up to {:.4g} Hz "
      "({:g} steps a period)",
      settings.step, scheme, outputs, check.resolved_hz(),
      SceneCheck::kStepsAPeriod);
  const std::string rest = check.stable_step       ? describe_stability(check)
                           : has_unresolved(check) ? describe_scheme(settings)
                                                   : "";
  return text + (rest.empty() ? "" : "; " + rest) + "\n" +
         describe_samples(check);
}

std::string describe_contacts(const SceneCheck& check) {
  std::vector<ContactCheck> contacts = check.contacts;
  if (contacts.empty()) return "";
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const ContactCheck& a, const ContactCheck& b) {
                     return a.gap < b.gap;
                   });
  const auto overlapping = std::count_if(
      contacts.begin(), contacts.end(),
      [](const ContactCheck& contact) { return contact.gap < 0.0; });
  std::string text = fmt::format("contacts  {} pairs, {} of them overlap",
                                 contacts.size(), overlapping);
  for (std::size_t i = 0; i < std::min(contacts.size(), kMostNamed); ++i) {
    const ContactCheck& contact = contacts[i];
    text += fmt::format("{} '{}' {} by {:.3g} m", i == 0 ? ":" : ",",
                        contact.pair, contact.gap < 0.0 ? "overlap" : "apart",
                        std::abs(contact.gap));
  }
  return text + "\n";
}

/// Factor within which a predicted time of steps to a tolerance was, of the
/// examples; none of fixed steps, and of a run that was measured as a whole.
std::optional<double> find_doubt(const Pace& pace) {
  constexpr double kScouted = 2.0;
  constexpr double kExtrapolated = 4.0;  // or passes whose number is not known
  if (pace.is_verified) return kExtrapolated;
  if (!pace.scouted) return std::nullopt;
  return *pace.scouted >= 1.0 ? kScouted : kExtrapolated;
}

std::string describe_pace(const SceneCheck& check) {
  const Pace& pace = check.cost.pace;
  if (!pace.run_seconds) {
    return fmt::format("not known: {} steps in {:.2g} s", pace.steps,
                       pace.seconds);
  }
  std::string text = fmt::format("about {:.2g} s", *pace.run_seconds);
  if (pace.is_verified) text += " for three passes";
  const std::optional<double> doubt = find_doubt(pace);
  if (doubt) text += fmt::format(", within a factor of {:g}", *doubt);
  text +=
      fmt::format(", at the pace of the first {} steps ({:.3g} s of motion)",
                  pace.steps, pace.time);
  if (pace.scouted) {
    text += fmt::format(" and of a coarse pass over {:.0f} % of the motion",
                        100.0 * *pace.scouted);
  }
  const bool changes = !doubt && !check.contacts.empty();
  return text + (changes ? "; contact takes longer" : "");
}

std::string describe_cost(const SceneCheck& check) {
  const CostCheck& cost = check.cost;
  return fmt::format(
      "cost      {}\n          at least {} of memory, and {} in results.h5\n",
      describe_pace(check), to_size(cost.memory_bytes),
      to_size(cost.file_bytes));
}

template <typename Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json describe_cost_values(const CostCheck& cost) {
  const Pace& pace = cost.pace;
  return Json{{"steps_measured", pace.steps},
              {"time_measured", pace.time},
              {"seconds_measured", pace.seconds},
              {"seconds", or_null(pace.run_seconds)},
              {"seconds_factor", or_null(find_doubt(pace))},
              {"fraction_scouted", or_null(pace.scouted)},
              {"memory_bytes", cost.memory_bytes},
              {"results_bytes", cost.file_bytes}};
}

}  // namespace

Json to_json(const SceneCheck& check) {
  const dynamics::SimulationSettings& settings = check.settings;
  Json json{
      {"scenario", check.scenario},
      {"mass", check.mass},
      {"integrator", to_string(settings.integrator)},
      {"step", has_tolerance(check) ? Json(nullptr) : Json(settings.step)},
      {"tolerance",
       has_tolerance(check) ? Json(settings.tolerance) : Json(nullptr)},
      {"stable_step", or_null(check.stable_step)},
      {"duration", settings.end_time - check.start},
      {"outputs", settings.output_times.size()},
      {"frequencies_hz", to_json(check.frequencies)},
      {"cost", describe_cost_values(check.cost)},
      {"bodies", Json::array()},
      {"joints", Json::array()},
      {"contacts", Json::array()},
      {"sample_periods", Json::object()},
      {"silent", check.silent},
      {"problems", check.problems},
      {"warnings", check.warnings},
      {"choices", check.choices}};
  for (const BodyCheck& body : check.bodies) {
    Json one{{"name", body.name},
             {"level", std::string(to_string(body.level))},
             {"mass", body.mass},
             {"modes", body.modes}};
    if (body.frequencies) {
      one["lowest_hz"] = body.frequencies->first;
      one["fastest_hz"] = body.frequencies->second;
    }
    json["bodies"].push_back(one);
  }
  for (const JointCheck& joint : check.joints) {
    json["joints"].push_back(
        {{"name", joint.name}, {"fastest_hz", joint.fastest_hz}});
  }
  for (const ControllerCheck& controller : check.controllers) {
    json["sample_periods"][controller.name] = controller.period;
  }
  for (const ContactCheck& contact : check.contacts) {
    json["contacts"].push_back({{"pair", contact.pair}, {"gap", contact.gap}});
  }
  return json;
}

std::string to_text(const SceneCheck& check) {
  return fmt::format("{}\n", check.scenario) +
         list_lines("problem", check.problems) +
         list_lines("warning", check.warnings) +
         list_lines("silent", check.silent) +
         fmt::format("mass      {:.6g} kg\n", check.mass) +
         describe_bodies(check) + describe_joints(check) +
         describe_system(check) + describe_step(check) +
         describe_contacts(check) + describe_cost(check) +
         list_lines("chosen", check.choices);
}

}  // namespace limber::app
