// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/errors/error_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/text/setting.hpp"

namespace limber::app {
namespace {

using dynamics::Fidelity;

constexpr double kSecondOrder = 4.0 / 3.0;

/// The path of a key of a flexible link in its robot's file. Links of several
/// robots are called ROBOT.LINK.
std::string find_path(const scene::Scenario& scenario, const std::string& link,
                      const std::string& key) {
  if (scenario.robots.empty()) {
    return fmt::format("robot.flexible.{}.{}", scene::quote_part(link), key);
  }
  const std::size_t dot = link.find('.');
  return fmt::format("robot.{}.flexible.{}.{}",
                     scene::quote_part(link.substr(0, dot)),
                     scene::quote_part(link.substr(dot + 1)), key);
}

bool is_geometry(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::array<std::string_view, 6> kGeometries = {
      ".geo", ".step", ".stp", ".brep", ".iges", ".igs"};
  return std::count(kGeometries.begin(), kGeometries.end(), extension) > 0;
}

/// The longest step that a run of fixed steps takes: outputs divide the time,
/// and each part is divided evenly; explicit schemes stay stable.
double find_step_taken(const runs::Run& run) {
  const dynamics::SimulationSettings& settings = run.built.settings;
  double step = settings.step;
  for (const dynamics::StepChange& change : settings.step_changes) {
    step = std::min(step, change.step);
  }
  const double stable = run.statistics.stable_step;
  if (stable > 0.0) step = std::min(step, stable);
  double longest = 0.0;
  double begin = run.built.initial.t;
  const auto take = [&](double end) {
    const double span = end - begin;
    if (span > 0.0) {
      constexpr double kRounding = 1e-9;
      longest = std::max(longest, span / std::ceil(span / step - kRounding));
    }
    begin = std::max(begin, end);
  };
  for (const double t : settings.output_times) take(t);
  take(settings.end_time);
  return longest > 0.0 ? longest : step;
}

class Finder {
 public:
  explicit Finder(const runs::Run& run)
      : run_(run), scenario_(run.scene.scenario) {}

  ErrorCauses find() {
    add_step();
    add_modes();
    add_level();
    add_mesh();
    add_contact();
    return std::move(found_);
  }

 private:
  void add(std::string name, std::string finer, scene::Overrides overrides,
           double factor) {
    found_.causes.push_back(
        {std::move(name), std::move(finer), std::move(overrides), factor});
  }

  void set(std::string name, std::string finer, std::string path, double value,
           double factor) {
    add(std::move(name), std::move(finer),
        {.settings = {{std::move(path), fmt::format("{}", value)}}}, factor);
  }

  void add_step() {
    const dynamics::SimulationSettings& settings = run_.built.settings;
    if (settings.tolerance > 0.0) {
      constexpr double kFiner = 0.1;
      set("step", "a tenth of the tolerance", "time.tolerance",
          kFiner * settings.tolerance, 1.0 / (1.0 - kFiner));
      return;
    }
    add("step", "half of the step", {.step = 0.5 * find_step_taken(run_)},
        kSecondOrder);
  }

  [[nodiscard]] bool bends(const scene::Link& link) const {
    return link.flexible.has_value() &&
           scenario_.level_of(link.name) != Fidelity::rigid;
  }

  [[nodiscard]] bool has_modes(const scene::Link& link) const {
    return bends(link) && scenario_.level_of(link.name) != Fidelity::full;
  }

  void add_modes() {
    int most = 0;
    for (const dynamics::BodyModel& body : run_.built.model.bodies) {
      if (body.reduced) most = std::max(most, body.reduced->mode_count());
    }
    bool has_any = false;
    for (const scene::Link& link : run_.scene.robot.links) {
      if (!has_modes(link)) continue;
      if (link.flexible->reduced_file.empty()) {
        has_any = true;
      } else {
        found_.unknown.push_back(fmt::format(
            "modes and mesh of link '{}', a saved body", link.name));
      }
    }
    if (!has_any) return;
    constexpr int kLeastMore = 5;
    constexpr double kFurther = 1.5;
    const int more = most + std::max(kLeastMore, most / 2);
    scene::Overrides overrides;
    overrides.basis.eigenmodes = more;
    overrides.basis.terms = 2;
    add("modes",
        fmt::format("{} eigenmodes and two terms of static modes", more),
        std::move(overrides), kFurther);
  }

  static std::optional<Fidelity> find_next(Fidelity level) {
    using enum Fidelity;
    switch (level) {
      case rigid:
      case one_way:
        return coupled;
      case uncoupled:
        return one_way;
      case coupled:
        return nonlinear;
      case nonlinear:
      case full:
        break;
    }
    return {};
  }

  void add_level() {
    std::vector<Fidelity> levels;
    for (const scene::Link& link : run_.scene.robot.links) {
      if (link.flexible) levels.push_back(scenario_.level_of(link.name));
    }
    if (levels.empty()) return;
    const auto [lowest, highest] =
        std::minmax_element(levels.begin(), levels.end());
    if (*highest == Fidelity::full) {
      if (*lowest == Fidelity::full) return;
      found_.unknown.emplace_back("level of links other than those at full");
      return;
    }
    const std::optional<Fidelity> finer =
        *lowest < *highest ? std::optional(*highest) : find_next(*highest);
    if (!finer) {
      found_.unknown.emplace_back(
          "level: only full is above nonlinear, and it uses whole meshes");
      return;
    }
    add("level", fmt::format("all links at level {}", to_string(*finer)),
        {.fidelity = finer}, 1.0);
  }

  [[nodiscard]] bool is_of_first_order(const scene::Link& link) const {
    const auto& bodies = run_.built.model.bodies;
    return std::any_of(bodies.begin(), bodies.end(), [&](const auto& body) {
      return body.name == link.name && body.reduced && body.reduced->locking;
    });
  }

  /// Elements of 2/3 of their size, or else of a higher order.
  void add_mesh() {
    constexpr double kFiner = 1.5;
    constexpr double kMeshFactor = 1.0 / (1.0 - 1.0 / (kFiner * kFiner));
    scene::Overrides overrides;
    for (const scene::Link& link : run_.scene.robot.links) {
      if (!bends(link) || !link.flexible->reduced_file.empty()) continue;
      const flexbody::MeshSource& mesh = link.flexible->mesh;
      const auto change = [&](const std::string& key, double value) {
        overrides.settings.push_back(
            {find_path(scenario_, link.name, key), fmt::format("{}", value)});
      };
      if (is_geometry(mesh.file) && mesh.size > 0.0) {
        change("mesh.size", mesh.size / kFiner);
      } else if (is_geometry(mesh.file) && mesh.order < 3) {
        change("mesh.order", mesh.order == 1 ? 2 : 3);
      } else if (is_of_first_order(link)) {
        change("mesh.order", 2);
      } else {
        found_.unknown.push_back(fmt::format(
            "mesh of link '{}', which can only be made finer by hand",
            link.name));
      }
    }
    if (overrides.settings.empty()) return;
    add("mesh", "elements of 2/3 of the size, or of a higher order",
        std::move(overrides), kMeshFactor);
  }

  void add_contact() {
    if (run_.record.contacts.empty()) return;
    set("contact", "twice the steps of impacts", "time.impact_steps",
        2.0 * run_.built.settings.impact_steps, kSecondOrder);
  }

  const runs::Run& run_;
  const scene::Scenario& scenario_;
  ErrorCauses found_;
};

}  // namespace

ErrorCauses find_error_causes(const runs::Run& run) {
  return Finder(run).find();
}

std::optional<ErrorCause> join_causes(const std::vector<ErrorCause>& causes) {
  ErrorCause all{"all", "all but the level", {}, 1.0};
  int count = 0;
  for (const ErrorCause& cause : causes) {
    if (cause.name == "level") continue;
    all.overrides = scene::merge(all.overrides, cause.overrides);
    ++count;
  }
  return count > 1 ? std::optional(all) : std::nullopt;
}

}  // namespace limber::app
