// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/frequency_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "limber/app/options/reducer.hpp"
#include "limber/runs/analyses/linearised_at.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/build/build_system.hpp"

namespace limber::app {
namespace {

Vector3 find_spin(const FrequencyReport& f) { return f.modes.axes.w_W; }

void warn(FrequencyReport& f) {
  const dynamics::NaturalModes& m = f.modes;
  if (m.imbalance.matters) {
    f.warnings.push_back(runs::describe_imbalance(m.imbalance, m.is_moving));
  }
  if (m.change > runs::kReportedChange)
    f.warnings.push_back(runs::describe_change(m.change));
}

std::string name_whirl(const dynamics::NaturalMode& mode) {
  constexpr double kLine = 0.05;  // below this it is a line, not an orbit
  if (mode.orbit > kLine) return "forward";
  return mode.orbit < -kLine ? "backward" : "";
}

/// Frequency in the world frame of a circular motion in a rotating frame, with
/// sign.
std::optional<double> find_world_frequency(const dynamics::NaturalMode& mode) {
  constexpr double kCircle = 0.99;
  const double spin = mode.axes_w_W.norm();
  if (spin == 0.0 || std::abs(mode.orbit) < kCircle) return {};
  constexpr double kStill = 1e-6;  // of the spin: displaced axis
  const double w = std::copysign(mode.value.imag(), mode.orbit) + spin;
  return std::abs(w) < kStill * spin ? 0.0 : w / (2.0 * std::numbers::pi);
}

std::string describe_mode(const FrequencyReport& f,
                          const dynamics::NaturalMode& m) {
  if (m.is_free()) return "moves freely";
  std::string text;
  const auto add = [&](const std::string& more) {
    if (!more.empty()) text += (text.empty() ? "" : ", ") + more;
  };
  if (m.value.imag() == 0.0) {
    add(fmt::format("{} as exp({:.4g} t)",
                    m.value.real() > 0.0 ? "unstable, grows" : "decays",
                    m.value.real()));
  } else if (m.damping_ratio() < -1e-9) {
    add(fmt::format("unstable, grows as exp({:.4g} t)", m.value.real()));
  }
  const std::optional<double> world = find_world_frequency(m);
  if (world && *world == 0.0) {
    add("stationary, seen from the world");
  } else if (world) {
    add(fmt::format("{} at {:.6g} Hz, seen from the world",
                    *world > 0.0 ? "forward" : "backward", std::abs(*world)));
  } else if (m.value.imag() > 0.0) {
    add(name_whirl(m));
  }
  if (m.axes_w_W != find_spin(f)) {
    add(fmt::format("in axes that rotate at {:.6g} rad/s", m.axes_w_W.norm()));
  }
  return text;
}

Json list_mode(const FrequencyReport& f, const dynamics::NaturalMode& m) {
  Json json{{"frequency", m.frequency()},
            {"damping_ratio", m.damping_ratio()},
            {"damped_frequency", m.value.imag() / (2.0 * std::numbers::pi)},
            {"growth_rate", m.value.real()},
            {"moves_freely", m.is_free()}};
  if (!f.modes.is_moving) return json;
  json["axes_angular_velocity"] =
      std::vector<double>(m.axes_w_W.begin(), m.axes_w_W.end());
  json["orbit"] = m.orbit;
  json["whirl"] = name_whirl(m);
  if (const auto world = find_world_frequency(m)) {
    json["world_frequency"] = *world;
    json["whirl"] = *world > 0.0 ? "forward" : *world < 0.0 ? "backward" : "";
  }
  return json;
}

}  // namespace

FrequencyReport find_frequencies(const scene::Scene& scene,
                                 const std::filesystem::path& cache,
                                 const Progress& progress) {
  scene::BuiltScene built = scene::build_system(
      scene, make_reducer(progress), cache, make_full_maker(progress));
  runs::warn_of_unused_cache(cache, built);
  FrequencyReport report{
      scene.scenario.file.string(),
      scene.scenario.name,
      dynamics::find_natural_modes(built.model, built.initial),
      dynamics::find_natural_frequencies(built.model, built.initial),
      built.warnings,
      built.notes};
  warn(report);
  return report;
}

Json to_json(const FrequencyReport& f, int count) {
  Json json = Json::object();
  json["scenario"] = f.scenario;
  if (!f.modes.is_moving) {
    const VectorX first =
        f.undamped.head(std::min<Eigen::Index>(count, f.undamped.size()));
    json["frequencies"] = std::vector<double>(first.begin(), first.end());
  }
  json["is_moving"] = f.modes.is_moving;
  const Vector3 w = find_spin(f);
  json["axes_angular_velocity"] = std::vector<double>(w.begin(), w.end());
  json["residual_force"] = f.modes.imbalance.force;
  json["residual_moment"] = f.modes.imbalance.moment;
  json["change_per_radian"] = f.modes.change;
  json["modes"] = Json::array();
  for (const dynamics::NaturalMode& mode : f.modes.modes) {
    if (std::ssize(json["modes"]) == count) break;
    json["modes"].push_back(list_mode(f, mode));
  }
  json["notes"] = f.notes;
  json["warnings"] = f.warnings;
  return json;
}

std::string to_text(const FrequencyReport& f, int count) {
  std::string text =
      fmt::format("Small motion about the {} of {}\n",
                  f.modes.is_moving ? "motion at the start" : "start", f.name);
  const Vector3 w = find_spin(f);
  if (!w.isZero(0.0)) {
    text += fmt::format(
        "in axes that rotate with it, at ({:.6g}, {:.6g}, {:.6g}) rad/s\n",
        w.x(), w.y(), w.z());
  }
  text += fmt::format("{:>5}  {:>14}  {:>13}\n", "", "frequency [Hz]",
                      "damping ratio");
  constexpr double kNone = 1e-9;  // a damping ratio of round-off
  const auto free =
      std::count_if(f.modes.modes.begin(), f.modes.modes.end(),
                    [](const auto& mode) { return mode.is_free(); });
  std::ptrdiff_t number = 0;
  for (const dynamics::NaturalMode& mode : f.modes.modes) {
    if (++number > count) break;
    const bool is_one_of_many = mode.is_free() && free > 1;
    if (is_one_of_many && number > 1) continue;
    const double ratio = mode.damping_ratio();
    const std::string words = is_one_of_many
                                  ? fmt::format("{} free motions", free)
                                  : describe_mode(f, mode);
    text += fmt::format(
        "{:>5}  {:>14.6g}  {:>13.4g}{}{}\n",
        is_one_of_many ? fmt::format("1-{}", free) : std::to_string(number),
        mode.frequency(), std::abs(ratio) < kNone ? 0.0 : ratio,
        words.empty() ? "" : "  ", words);
  }
  return text;
}

}  // namespace limber::app
