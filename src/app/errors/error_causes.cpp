// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/errors/error_causes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "limber/common/index.hpp"

namespace limber::app {
namespace {

using dynamics::Fidelity;

constexpr double kSecondOrder = 4.0 / 3.0;

std::string quote(const std::string& part) {
  return part.find('.') == std::string::npos ? part : '"' + part + '"';
}

/// The path of a key of a flexible link in its robot's file. Links of several
/// robots are called ROBOT.LINK.
std::string find_path(const scene::Scenario& scenario, const std::string& link,
                      const std::string& key) {
  if (scenario.robots.empty()) {
    return fmt::format("robot.flexible.{}.{}", quote(link), key);
  }
  const std::size_t dot = link.find('.');
  return fmt::format("robot.{}.flexible.{}.{}", quote(link.substr(0, dot)),
                     quote(link.substr(dot + 1)), key);
}

bool is_geometry(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  constexpr std::array<std::string_view, 6> kGeometries = {
      ".geo", ".step", ".stp", ".brep", ".iges", ".igs"};
  return std::count(kGeometries.begin(), kGeometries.end(), extension) > 0;
}

class Finder {
 public:
  Finder(const scene::Scene& scene, const scene::BuiltScene& built,
         const dynamics::RunRecord& record)
      : scene_(scene),
        scenario_(scene.scenario),
        built_(built),
        record_(record) {}

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
    const dynamics::SimulationSettings& settings = built_.settings;
    if (settings.tolerance > 0.0) {
      constexpr double kFiner = 0.1;
      set("step", "a tenth of the tolerance", "time.tolerance",
          kFiner * settings.tolerance, 1.0 / (1.0 - kFiner));
      return;
    }
    double step = settings.step;
    for (const dynamics::StepChange& change : settings.step_changes) {
      step = std::min(step, change.step);
    }
    add("step", "half of the step", {.step = 0.5 * step}, kSecondOrder);
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
    for (const dynamics::BodyModel& body : built_.model.bodies) {
      if (body.reduced) most = std::max(most, body.reduced->mode_count());
    }
    bool has_any = false;
    for (const scene::Link& link : scene_.robot.links) {
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

  void add_level() {
    std::optional<Fidelity> highest;
    for (const scene::Link& link : scene_.robot.links) {
      if (!link.flexible) continue;
      const Fidelity level = scenario_.level_of(link.name);
      highest = std::max(highest.value_or(level), level);
    }
    if (!highest || *highest == Fidelity::full) return;
    if (*highest == Fidelity::nonlinear) {
      found_.unknown.emplace_back(
          "level: above nonlinear there is full alone, which takes whole "
          "meshes");
      return;
    }
    const Fidelity next = *highest == Fidelity::rigid       ? Fidelity::coupled
                          : *highest == Fidelity::uncoupled ? Fidelity::one_way
                          : *highest == Fidelity::one_way   ? Fidelity::coupled
                                                          : Fidelity::nonlinear;
    add("level", fmt::format("level {}", to_string(next)), {.fidelity = next},
        1.0);
  }

  /// Elements of 2/3 of their size, or else of a higher order.
  void add_mesh() {
    constexpr double kFiner = 1.5;
    constexpr double kMeshFactor = 1.0 / (1.0 - 1.0 / (kFiner * kFiner));
    scene::Overrides overrides;
    for (const scene::Link& link : scene_.robot.links) {
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
      } else {
        found_.unknown.push_back(fmt::format(
            "mesh of link '{}', which no size is given for", link.name));
      }
    }
    if (overrides.settings.empty()) return;
    add("mesh", "elements of 2/3 of the size, or of a higher order",
        std::move(overrides), kMeshFactor);
  }

  void add_contact() {
    if (record_.contacts.empty()) return;
    set("contact", "twice the steps of impacts", "time.impact_steps",
        2.0 * built_.settings.impact_steps, kSecondOrder);
  }

  const scene::Scene& scene_;
  const scene::Scenario& scenario_;
  const scene::BuiltScene& built_;
  const dynamics::RunRecord& record_;
  ErrorCauses found_;
};

}  // namespace

ErrorCauses find_error_causes(const scene::Scene& scene,
                              const scene::BuiltScene& built,
                              const dynamics::RunRecord& record) {
  return Finder(scene, built, record).find();
}

scene::Overrides join_overrides(const std::vector<ErrorCause>& causes) {
  scene::Overrides joined;
  for (const ErrorCause& cause : causes) {
    const scene::Overrides& one = cause.overrides;
    joined.settings.insert(joined.settings.end(), one.settings.begin(),
                           one.settings.end());
    if (one.fidelity) joined.fidelity = one.fidelity;
    if (one.step) joined.step = one.step;
    if (one.basis != scene::BasisChoice{}) joined.basis = one.basis;
  }
  return joined;
}

}  // namespace limber::app
