// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scene.hpp"
#include "support/temporary_folder.hpp"

/// Scenes of rigid links from text to motion.
namespace limber::scene::test {

/// A folder for one test.
class SceneFolder {
 public:
  [[nodiscard]] const std::filesystem::path& path() const {
    return folder_.path();
  }

  [[nodiscard]] Scene load(const std::string& robot,
                           const std::string& scenario) const {
    std::ofstream(path() / "robot.urdf") << "<robot name='r'>\n"
                                         << robot << "</robot>\n";
    std::ofstream(path() / "scenario.toml") << "robot = 'robot.urdf'\n"
                                            << scenario;
    return load_scene(path() / "scenario.toml");
  }

  [[nodiscard]] BuiltScene build(const Scene& scene) const {
    return build_system(
        scene,
        {"",
         [](const flexbody::MeshSource& mesh) -> flexbody::MeshAtHand {
           ADD_FAILURE() << mesh.file << " should not be reduced";
           return {};
         }},
        path() / "cache");
  }

  [[nodiscard]] BuiltScene build(const std::string& robot,
                                 const std::string& scenario) const {
    return build(load(robot, scenario));
  }

 private:
  limber::test::TemporaryFolder folder_;
};

inline const std::string kWorld = "<link name='world'/>\n";

inline std::string time_table(double duration, double step) {
  return fmt::format("[time]\nduration = {}\nstep = {}\n", duration, step);
}

/// Rigid link: mass [kg], inertia about its centre's axes [kg m^2].
inline std::string rigid_link(const std::string& name, double mass,
                              double inertia,
                              const std::string& center = "0 0 0") {
  return fmt::format(
      "<link name='{0}'><inertial><origin xyz='{3}'/><mass value='{1}'/>"
      "<inertia ixx='{2}' iyy='{2}' izz='{2}' ixy='0' ixz='0' iyz='0'/>"
      "</inertial></link>\n",
      name, mass, inertia, center);
}

/// Probe columns at the end of the scenario.
inline std::vector<double> simulate_probes(const BuiltScene& built) {
  dynamics::SystemState state = built.initial;
  dynamics::simulate(built.model, state, built.settings, {});
  return evaluate_all(built.probes, built.model, state);
}

}  // namespace limber::scene::test
