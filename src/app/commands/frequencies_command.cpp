// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/json.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  SettingOptions settings_given;
  std::string fidelity;
  std::string cache;
  int count = 20;
  bool json = false;
};

/// The reference motion of the linearisation, and remarks for the user.
struct Findings {
  std::string name;
  dynamics::NaturalModes modes;
  std::vector<std::string> warnings;
};

Vector3 find_spin(const Findings& f) { return f.modes.axes.w_W; }

std::string describe_imbalance(const dynamics::NaturalModes& modes) {
  const dynamics::Imbalance& left = modes.imbalance;
  std::string text =
      fmt::format("the start is {}: ",
                  modes.is_moving ? "no steady motion" : "not an equilibrium");
  if (left.force > 0.0) {
    text += fmt::format("{:.4g} N are left on body '{}', ", left.force,
                        left.force_body);
  }
  if (left.moment > 0.0) {
    text +=
        fmt::format("{:.4g} N m on body '{}', ", left.moment, left.moment_body);
  }
  text += fmt::format(
      "where {:.4g} N act in all; frequencies are of the forces as they are "
      "there",
      left.acting);
  if (!modes.is_moving) {
    text += "; [initial] equilibrium = true starts from the equilibrium";
  }
  return text;
}

void warn(Findings& f) {
  constexpr double kExact = 1e-6;
  const dynamics::NaturalModes& m = f.modes;
  if (m.imbalance.matters) f.warnings.push_back(describe_imbalance(m));
  if (m.change > kExact) {
    f.warnings.push_back(fmt::format(
        "the linearised system changes by a fraction of {:.2g} while it "
        "rotates by 1 rad, in fixed and in rotating axes: frequencies are "
        "instantaneous, and exact only for an axisymmetric rotor, or for any "
        "rotor in isotropic bearings",
        m.change));
  }
}

std::string name_whirl(const dynamics::NaturalMode& mode) {
  constexpr double kLine = 0.05;  // below this it is a line, not an orbit
  if (mode.orbit > kLine) return "forward";
  return mode.orbit < -kLine ? "backward" : "";
}

/// Frequency in the world frame of a circular motion in a rotating frame, with
/// sign.
std::optional<double> find_world_frequency(const Findings& f,
                                           const dynamics::NaturalMode& mode) {
  constexpr double kCircle = 0.99;
  const double spin = find_spin(f).norm();
  if (spin == 0.0 || std::abs(mode.orbit) < kCircle) return {};
  constexpr double kStill = 1e-6;  // of the spin: displaced axis
  const double w = std::copysign(mode.value.imag(), mode.orbit) + spin;
  return std::abs(w) < kStill * spin ? 0.0 : w / (2.0 * std::numbers::pi);
}

std::string describe_mode(const Findings& f, const dynamics::NaturalMode& m) {
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
  const std::optional<double> world = find_world_frequency(f, m);
  if (world && *world == 0.0) {
    add("stationary, seen from the world");
  } else if (world) {
    add(fmt::format("{} at {:.6g} Hz, seen from the world",
                    *world > 0.0 ? "forward" : "backward", std::abs(*world)));
  } else if (m.value.imag() > 0.0) {
    add(name_whirl(m));
  }
  return text;
}

Json to_json(const Findings& f, const dynamics::NaturalMode& m) {
  Json json{{"frequency", m.frequency()},
            {"damping_ratio", m.damping_ratio()},
            {"damped_frequency", m.value.imag() / (2.0 * std::numbers::pi)},
            {"growth_rate", m.value.real()},
            {"moves_freely", m.is_free()}};
  if (!f.modes.is_moving) return json;
  json["orbit"] = m.orbit;
  json["whirl"] = name_whirl(m);
  if (const auto world = find_world_frequency(f, m)) {
    json["world_frequency"] = *world;
    json["whirl"] = *world > 0.0 ? "forward" : *world < 0.0 ? "backward" : "";
  }
  return json;
}

void print_json(const Options& options, const Findings& f, const VectorX& all) {
  Json json = Json::object();
  json["scenario"] = options.scenario;
  if (!f.modes.is_moving) {
    const VectorX first =
        all.head(std::min<Eigen::Index>(options.count, all.size()));
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
    if (std::ssize(json["modes"]) == options.count) break;
    json["modes"].push_back(to_json(f, mode));
  }
  json["warnings"] = f.warnings;
  fmt::print("{}\n", to_text(json));
}

void print_table(const Options& options, const Findings& f) {
  fmt::print("Small motion about the {} of {}\n",
             f.modes.is_moving ? "motion at the start" : "start", f.name);
  const Vector3 w = find_spin(f);
  if (!w.isZero(0.0)) {
    fmt::print(
        "seen from axes that turn with it, at ({:.6g}, {:.6g}, {:.6g}) rad/s\n",
        w.x(), w.y(), w.z());
  }
  fmt::print("{:>5}  {:>14}  {:>13}\n", "", "frequency [Hz]", "damping ratio");
  constexpr double kNone = 1e-9;  // a damping ratio of round-off
  int i = 0;
  for (const dynamics::NaturalMode& mode : f.modes.modes) {
    if (++i > options.count) break;
    const double ratio = mode.damping_ratio();
    const std::string text = describe_mode(f, mode);
    fmt::print("{:>5}  {:>14.6g}  {:>13.4g}{}{}\n", i, mode.frequency(),
               std::abs(ratio) < kNone ? 0.0 : ratio, text.empty() ? "" : "  ",
               text);
  }
}

void find_frequencies(const Options& options) {
  scene::Overrides overrides;
  overrides.settings = to_settings(options.settings_given);
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  const scene::Scene scene = scene::load_scene(options.scenario, overrides);
  const Progress progress = make_progress_bar();
  const scene::BuiltScene built = scene::build_system(
      scene, make_reducer(progress), options.cache, make_full_maker(progress));
  clear_progress_bar();
  Findings f{scene.scenario.name,
             dynamics::find_natural_modes(built.model, built.initial),
             built.warnings};
  warn(f);
  print_warnings(f.warnings);
  if (options.json) {
    print_json(options, f,
               dynamics::find_natural_frequencies(built.model, built.initial));
  } else {
    print_table(options, f);
  }
}

}  // namespace

void add_frequencies(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "frequencies",
      "Natural frequencies of a scenario's whole system about its start, held "
      "by its couplers and drives");
  command->add_option("scenario", options->scenario, "Scenario file (.toml)")
      ->required();
  add_settings(*command, options->settings_given);
  command->add_option("--fidelity", options->fidelity,
                      "Level of every flexible link, in place of the file's");
  command->add_option("--count", options->count, "How many, from the lowest")
      ->check(make_positive());
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback([&action, options] {
    action = [options] { find_frequencies(*options); };
  });
}

}  // namespace limber::app
