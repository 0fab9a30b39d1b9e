// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/unused_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <variant>

#include "limber/scene/build/recipes.hpp"
#include "limber/scene/probes/stress_points.hpp"

namespace limber::scene {
namespace {

using dynamics::Fidelity;
using dynamics::IntegratorKind;

class Finder {
 public:
  Finder(const toml::table& file, const Scene& scene,
         const Overrides& overrides)
      : file_(file),
        scenario_(scene.scenario),
        links_(scene.robot.links),
        joints_(scene.robot.joints),
        robot_file_(scene.robot.file.filename().string()),
        touching_(scene.touching),
        overrides_(overrides) {}

  std::vector<std::string> find() {
    look_at_integrator();
    look_at_levels();
    look_at_flexible_links();
    look_at_stress();
    look_at_pieces();
    for (std::size_t i = 0; i < scenario_.loads.size(); ++i) look_at_load(i);
    look_at_controllers();
    look_at_releases();
    look_at_contact_defaults();
    look_at_stribeck_speeds();
    look_at_obstacles();
    look_at_surfaces();
    look_at_packages();
    return std::move(texts_);
  }

 private:
  [[nodiscard]] bool has(const char* table, const char* key) const {
    const toml::table* found = file_[table].as_table();
    return found != nullptr && found->contains(key);
  }

  void warn(const std::string& what, const std::string& why) {
    texts_.push_back(fmt::format("{} changes nothing: {}", what, why));
  }

  void warn(const char* table, const char* key, const std::string& why) {
    if (has(table, key)) warn(fmt::format("[{}] {}", table, key), why);
  }

  [[nodiscard]] bool has_stop() const {
    return std::any_of(joints_.begin(), joints_.end(), [](const Joint& joint) {
      return std::any_of(
          joint.actions.begin(), joint.actions.end(),
          [](const JointAction& action) {
            return std::holds_alternative<StopOptions>(action.law);
          });
    });
  }

  [[nodiscard]] bool is_any_flexible() const {
    return std::any_of(links_.begin(), links_.end(), [](const Link& link) {
      return link.flexible.has_value();
    });
  }

  [[nodiscard]] bool is_any_at(Fidelity level) const {
    return std::any_of(links_.begin(), links_.end(), [&](const Link& link) {
      return link.flexible && scenario_.level_of(link.name) == level;
    });
  }

  void look_at_integrator() {
    const dynamics::SimulationSettings& time = scenario_.settings;
    const IntegratorKind kind = time.integrator;
    const std::string it_is =
        fmt::format("the integrator is {}", dynamics::to_string(kind));
    const dynamics::IntegratorTraits& traits = dynamics::traits_of(kind);
    if (!traits.has_spectral_radius) {
      warn("time", "rho_inf", it_is + "; only generalized-alpha has it");
    }
    if (!traits.is_implicit) {
      const std::string why = it_is + ", which does not use Newton's method";
      warn("time", "newton_tolerance", why);
      warn("time", "newton_iterations", why);
    }
    if (scenario_.contacts.empty() && !has_stop()) {
      warn("time", "impact_steps", "there is no contact and no end stop");
    }
    if (time.tolerance == 0.0) {
      warn("time", "most_steps", "it applies only to steps by a tolerance");
    }
    if (!traits.takes_exact_modes && time.exact_modes) {
      warn("time", "exact_modes", it_is + ", which has no closed form");
    }
  }

  // Checks the levels in the file, unless they are overridden.
  void look_at_levels() {
    if (overrides_.fidelity) return;
    const std::string none = "no link is at level ";
    if (!is_any_at(Fidelity::full)) {
      if (!is_any_at(Fidelity::nonlinear)) {
        warn("full", "law", none + "full or nonlinear");
      }
      warn("full", "mass", none + "full");
    }
    look_at_law();
    if (!is_any_at(Fidelity::uncoupled) &&
        dynamics::traits_of(scenario_.settings.integrator).takes_exact_modes) {
      warn("time", "exact_modes", none + "uncoupled");
    }
    const bool are_all_listed =
        std::all_of(links_.begin(), links_.end(), [&](const Link& link) {
          return !link.flexible ||
                 scenario_.fidelity_of_link.contains(link.name);
        });
    if (is_any_flexible() && are_all_listed) {
      warn("fidelity", "default", "'links' names every flexible link");
    }
  }

  void look_at_flexible_links() {
    if (is_any_flexible()) return;
    const std::string why =
        fmt::format("no link of '{}' is flexible", robot_file_);
    if (scenario_.fidelity != Fidelity::rigid && !overrides_.fidelity) {
      warn("fidelity", "default", why);
    }
    if (scenario_.output.stress) warn("output", "stress", why);
    for (const char* table : {"basis", "advice"}) {
      if (file_.contains(table)) warn(fmt::format("[{}]", table), why);
    }
  }

  // Saved bodies have the second order of the default law.
  void look_at_law() {
    if (scenario_.full.law == flexbody::FullOptions{}.law) return;
    for (const Link& link : links_) {
      if (!link.flexible || link.flexible->reduced_file.empty() ||
          scenario_.level_of(link.name) != Fidelity::nonlinear) {
        continue;
      }
      warn("[full] law of link '" + link.name + "'",
           fmt::format("its saved body has the second order of {}",
                       to_string(flexbody::FullOptions{}.law)));
    }
  }

  void look_at_stress() {
    if (!scenario_.output.stress) return;
    for (const Link& link : links_) {
      const Fidelity level = scenario_.level_of(link.name);
      if (!link.flexible || has_stress(level)) continue;
      warn("[output] stress of link '" + link.name + "'", explain_no_stress());
    }
  }

  // Levels of the command line are those of a comparison.
  void look_at_pieces() {
    if (overrides_.fidelity) return;
    for (const Link& link : links_) {
      if (!link.flexible || link.flexible->pieces == 1) continue;
      const Fidelity level = scenario_.level_of(link.name);
      if (takes_pieces(level)) continue;
      warn("'pieces' of link '" + link.name + "'",
           fmt::format("level {} takes the whole mesh; only coupled and "
                       "nonlinear use pieces",
                       to_string(level)));
    }
  }

  // The time from or until which a load acts, if given in the file.
  [[nodiscard]] std::optional<double> find_time(std::size_t load,
                                                const char* key) const {
    return file_["load"][load]["time"][key].value<double>();
  }

  void look_at_load(std::size_t i) {
    const LoadSpec& load = scenario_.loads[i];
    const std::string who = "load '" + load.name + "'";
    if (load.nodal_forces.empty() && load.force.isZero(0.0) &&
        load.moment.isZero(0.0)) {
      warn(who, "its force and moment are zero");
      return;
    }
    const double end = scenario_.settings.end_time;
    for (const char* key : {"from", "start"}) {
      const std::optional<double> from = find_time(i, key);
      if (from && *from >= end) {
        warn(who, fmt::format("it acts from {:g} s on, and the run ends at {:g}"
                              " s",
                              *from, end));
      }
    }
    const std::optional<double> until = find_time(i, "until");
    if (until && *until <= 0.0) {
      warn(who, fmt::format("it acts until {:g} s, and the run begins at 0 s",
                            *until));
    }
  }

  /// Whether a load, a drive, another controller or a probe has its input.
  [[nodiscard]] bool is_followed(int input) const {
    const auto follows = [&](const joints::Signal& signal) {
      const std::vector<int> inputs = joints::find_inputs(signal);
      return std::find(inputs.begin(), inputs.end(), input) != inputs.end();
    };
    const std::string& name =
        scenario_.controllers[static_cast<std::size_t>(input)].name;
    return std::any_of(scenario_.loads.begin(), scenario_.loads.end(),
                       [&](const LoadSpec& load) {
                         const auto* function =
                             std::get_if<dynamics::InputFunction>(&load.time);
                         return function != nullptr && function->input == input;
                       }) ||
           std::any_of(
               scenario_.drives.begin(), scenario_.drives.end(),
               [&](const DriveSpec& d) { return follows(d.drive.signal); }) ||
           std::any_of(scenario_.controllers.begin(),
                       scenario_.controllers.end(),
                       [&](const ControllerSpec& c) {
                         return follows(c.pid.reference);
                       }) ||
           std::any_of(scenario_.probes.begin(), scenario_.probes.end(),
                       [&](const ProbeSpec& probe) {
                         const auto* of =
                             std::get_if<ControllerProbeSpec>(&probe.of);
                         return of != nullptr && of->controller == name;
                       });
  }

  void look_at_controllers() {
    const double end = scenario_.settings.end_time;
    for (std::size_t i = 0; i < scenario_.controllers.size(); ++i) {
      const ControllerSpec& controller = scenario_.controllers[i];
      const std::string who = "controller '" + controller.name + "'";
      if (!is_followed(static_cast<int>(i))) {
        warn(who, "no load and no drive follows it, and no probe has it");
      } else if (controller.offset > end) {
        warn(who, fmt::format("its first sample is at {:g} s, and the run ends "
                              "at {:g} s",
                              controller.offset, end));
      }
    }
  }

  void look_at_releases() {
    const double end = scenario_.settings.end_time;
    for (const auto& [latch, time] : scenario_.releases) {
      if (time < end) continue;
      warn(fmt::format("[[release]] of latch '{}'", latch),
           fmt::format("it comes at {:g} s, and the run ends at {:g} s", time,
                       end));
    }
  }

  void look_at_contact_defaults() {
    const toml::table* defaults = file_["contact_default"].as_table();
    if (defaults == nullptr) return;
    const std::size_t count = scenario_.contacts.size();
    if (count == 0) {
      warn("[contact_default]", "there is no [[contact]]");
      return;
    }
    for (const auto& [key, node] : *defaults) {
      const std::string name(key.str());
      bool is_used = false;
      for (std::size_t i = 0; i < count; ++i) {
        const auto own = file_["contact"][i];
        const bool is_replaced = own[name].node() != nullptr ||
                                 (name == "damping" && own["restitution"]) ||
                                 (name == "restitution" && own["damping"]);
        is_used = is_used || !is_replaced;
      }
      if (!is_used) {
        warn("[contact_default] " + name, "every [[contact]] has its own");
      }
    }
  }

  void look_at_stribeck_speeds() {
    for (std::size_t i = 0; i < scenario_.contacts.size(); ++i) {
      const ContactOptions& options = scenario_.contacts[i].options;
      if (!options.stribeck_speed || options.static_friction) continue;
      warn(fmt::format("stribeck_speed of [[contact]] {}", i + 1),
           "there is no static_friction");
    }
  }

  [[nodiscard]] bool is_touching(const Toucher& body) const {
    return std::any_of(touching_.begin(), touching_.end(),
                       [&](const TouchingPair& pair) {
                         return pair.A == body || pair.B == body;
                       });
  }

  void look_at_obstacles() {
    for (std::size_t i = 0; i < scenario_.obstacles.size(); ++i) {
      if (is_touching({true, i})) continue;
      warn("obstacle '" + scenario_.obstacles[i].name + "'",
           "no [[contact]] names it");
    }
  }

  void look_at_surfaces() {
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const LinkContact& contact = links_[i].contact;
      const bool is_given = contact.material || !contact.surfaces.empty();
      if (!is_given || is_touching({false, i})) continue;
      warn("<contact> of link '" + links_[i].name + "'",
           "no [[contact]] names it");
    }
  }

  [[nodiscard]] bool has_mesh_in(const std::filesystem::path& folder) const {
    const std::string begin =
        (std::filesystem::absolute(folder) / "").lexically_normal().string();
    const auto is_in = [&](const Collision& shape) {
      const auto* mesh = std::get_if<MeshGeometry>(&shape.geometry);
      return mesh != nullptr && mesh->file.string().starts_with(begin);
    };
    return std::any_of(links_.begin(), links_.end(), [&](const Link& link) {
      return std::any_of(link.visuals.begin(), link.visuals.end(), is_in) ||
             std::any_of(link.collisions.begin(), link.collisions.end(), is_in);
    });
  }

  void look_at_packages() {
    for (const auto& [name, folder] : scenario_.urdf.packages) {
      if (has_mesh_in(folder)) continue;
      warn("[urdf] packages." + name, "no mesh of a robot is found in it");
    }
  }

  const toml::table& file_;
  const Scenario& scenario_;
  const std::vector<Link>& links_;
  const std::vector<Joint>& joints_;
  std::string robot_file_;
  const std::vector<TouchingPair>& touching_;
  const Overrides& overrides_;
  std::vector<std::string> texts_;
};

}  // namespace

std::vector<std::string> find_unused_keys(const toml::table& file,
                                          const Scene& scene,
                                          const Overrides& overrides) {
  return Finder(file, scene, overrides).find();
}

}  // namespace limber::scene
