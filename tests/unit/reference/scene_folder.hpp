// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scene.hpp"
#include "unit/results/temporary_folder.hpp"

namespace limber::reference::test {

/// A scene of rigid links from the text of its two files.
class RigidScene {
 public:
  /// The scenario names the robot "robot.urdf".
  RigidScene(const std::string& robot, const std::string& scenario,
             const std::vector<scene::Setting>& settings = {}) {
    std::ofstream(folder_.path() / "robot.urdf") << robot;
    std::ofstream(folder_.path() / "scene.toml")
        << "robot = \"robot.urdf\"\n" + scenario;
    scene = scene::load_scene(folder_.path() / "scene.toml",
                              {.settings = settings});
    built = scene::build_system(scene, {}, folder_.path());
  }

 private:
  results::test::TemporaryFolder folder_;

 public:
  scene::Scene scene;
  scene::BuiltScene built;
};

/// A link of `mass` kg, its centre of mass off its origin and its principal
/// axes turned.
inline std::string make_link(const std::string& name, double mass) {
  return "<link name=\"" + name +
         "\"><inertial><origin xyz=\"0.25 0.03 -0.02\" rpy=\"0.1 -0.3 0.2\"/>"
         "<mass value=\"" +
         std::to_string(mass) +
         "\"/><inertia ixx=\"0.02\" iyy=\"0.05\" izz=\"0.06\" ixy=\"0.004\" "
         "ixz=\"-0.002\" iyz=\"0.001\"/></inertial></link>";
}

/// A joint half a metre along the parent, turned.
inline std::string make_joint(const std::string& name, const std::string& type,
                              const std::string& parent,
                              const std::string& child,
                              const std::string& axis = "0 1 0") {
  // URDF wants limits of a slider; bounds of zero are none.
  const std::string limit =
      type == "prismatic" ? R"(<limit effort="1" velocity="1"/>)" : "";
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" +
         parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"0.5 0.05 0\" rpy=\"0.2 0.4 -0.3\"/><axis xyz=\"" +
         axis + "\"/>" + limit + "</joint>";
}

/// A coupler of equal numbers in translation and rotation.
inline std::string make_coupler(const std::string& joint, double stiffness,
                                double damping, double free_damping = 0.0) {
  const std::string k = std::to_string(stiffness);
  const std::string c = std::to_string(damping);
  return "<coupler joint=\"" + joint + "\" translational_stiffness=\"" + k +
         "\" rotational_stiffness=\"" + k + "\" translational_damping=\"" + c +
         "\" rotational_damping=\"" + c + "\" free_damping=\"" +
         std::to_string(free_damping) + "\"/>";
}

}  // namespace limber::reference::test
