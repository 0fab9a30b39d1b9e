// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <string>

#include "limber/reduction/reduce.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"
#include "unit/flexbody/files.hpp"
#include "verification/body_reference.hpp"

/// The reference beam as a scene of one link, "beam".
namespace limber::test {

/// With six eigenmodes, RK4 and an output at every step of 10 ms.
inline scene::Scene beam_scene(bool is_clamped = false) {
  scene::FlexibleLink flexible;
  flexible.mesh.file = beam_file("beam579_v41.msh");
  flexible.materials = {{"", {200e9, 0.0, 8000.0}}};
  flexible.basis.eigenmodes = 6;
  if (is_clamped) flexible.clamped_groups = {"root"};
  scene::Scene scene;
  scene.robot.name = "beam";
  scene.robot.links = {{"beam", {}, flexible}};
  scene.scenario.settings.end_time = 0.01;
  scene.scenario.settings.step = 1e-5;
  scene.scenario.settings.integrator = dynamics::IntegratorKind::runge_kutta_4;
  return scene;
}

/// Builds scenes with reductions of their own, and holds their files.
class SceneBench {
 public:
  [[nodiscard]] scene::BuiltScene build(const scene::Scene& scene) const {
    return scene::build_system(scene, flexbody::make_reducer(),
                               folder_.path() / "cache");
  }

  /// A field as text with all digits; its path.
  [[nodiscard]] std::filesystem::path write(const std::string& name,
                                            const VectorX& field) const {
    std::string text;
    for (const double value : field)
      fmt::format_to(std::back_inserter(text), "{:.17g}\n", value);
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }

  [[nodiscard]] const std::filesystem::path& path() const {
    return folder_.path();
  }

 private:
  flexbody::test::TemporaryFolder folder_;
};

}  // namespace limber::test
