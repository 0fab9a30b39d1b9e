// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.hpp"
#include "cli/shell.hpp"

/// A plastic bar with internal damping, held at its root and struck at its tip.
namespace limber::test {

inline constexpr double kLinkMass = 0.2 * 0.02 * 0.008 * 1500.0;  // [kg]

struct Arm {
  std::string holds = "fixed";  ///< "clamp", "fixed", or "pieces"
  double tip_mass = 0.0;        ///< by the link's [-]
  std::string damping = "ratio='0.02'";
  std::string turned = "";  ///< attributes of the root's <origin>
  double duration = 0.6;    ///< [s]
};

inline const char* const kBar =
    "swept[] = {};\n"
    "Point(1) = {0, -0.01, -0.004}; Point(2) = {0, 0.01, -0.004};\n"
    "Point(3) = {0, 0.01, 0.004}; Point(4) = {0, -0.01, 0.004};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
    "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
    "Transfinite Curve {1, 3} = 3; Transfinite Curve {2, 4} = 2;\n"
    "Transfinite Surface {1}; Recombine Surface {1};\n"
    "swept[] = Extrude {0.2, 0, 0} { Surface{1}; Layers{4}; Recombine; };\n"
    "Physical Surface(\"root\") = {1}; Physical Surface(\"tip\") = "
    "{swept[0]};\n"
    "Physical Volume(\"body\") = {swept[1]};\n"
    "Mesh.ElementOrder = 2;\n";

/// A plastic bar of 200 x 20 x 8 mm, struck across at its tip.
inline void write_arm(const Workspace& place, const Arm& arm) {
  const bool is_clamped = arm.holds == "clamp";
  std::string tip;
  if (arm.tip_mass > 0.0) {
    const double mass = arm.tip_mass * kLinkMass;
    const double inertia = 1e-6 * mass;
    tip = fmt::format(
        "<link name='load'><inertial><mass value='{0}'/><inertia ixx='{1}' "
        "iyy='{1}' izz='{1}' ixy='0' ixz='0' iyz='0'/></inertial></link>"
        "<joint name='tip' type='fixed'><parent link='bar'/><child "
        "link='load'/><origin xyz='0.2 0 0'/></joint>"
        "<coupler joint='tip' translational_stiffness='1e10' "
        "rotational_stiffness='1e8' translational_damping='0' "
        "rotational_damping='0'/>",
        mass, inertia);
  }
  place.write("bar.geo", kBar);
  place.write(
      "r.urdf",
      fmt::format(
          "<robot name='r'><link name='world'/><link name='bar'/>{}"
          "<joint name='root' type='fixed'><parent link='world'/><child "
          "link='bar'/><origin xyz='0 0 0' {}/></joint>"
          "<flexible link='bar' pieces='{}'><mesh file='bar.geo'/><material "
          "youngs_modulus='3e9' poisson_ratio='0.3' density='1500'/>"
          "<damping {}/><basis eigenmodes='6'/>{}"
          "<interface name='tip' group='tip'/></flexible>{}</robot>\n",
          tip, arm.turned, arm.holds == "pieces" ? 2 : 1, arm.damping,
          is_clamped ? "<clamp group='root'/>"
                     : "<interface name='root' group='root'/>",
          is_clamped ? ""
                     : "<coupler joint='root' translational_stiffness='1e10' "
                       "rotational_stiffness='1e8' translational_damping='0' "
                       "rotational_damping='0'/>"));
  place.write(
      "s.toml",
      fmt::format(
          "robot = 'r.urdf'\n[time]\nduration = {}\nstep = 5e-4\nrho_inf = "
          "1.0\noutput_interval = 5e-4\n[[load]]\nname = 'l'\nlink = 'bar'\n"
          "interface = 'tip'\nforce = [0.0, 0.0, 0.1]\nframe = 'body'\n"
          "time = {{ kind = 'pulse', shape = 'half-sine', start = 0.0, "
          "duration = 0.02 }}\n[[probe]]\nname = 't'\nlink = 'bar'\n"
          "interface = 'tip'\n[output]\npictures = false\n",
          arm.duration));
}

inline nlohmann::json find_modes(const Workspace& place,
                                 const std::string& more = "") {
  const CommandResult r =
      place.limber("frequencies s.toml --count 8 --json " + more);
  EXPECT_EQ(r.status, 0) << r.errors;
  return nlohmann::json::parse(r.out).at("modes");
}

inline double ratio_of(const nlohmann::json& mode) {
  return mode.at("damping_ratio").get<double>();
}
inline double frequency_of(const nlohmann::json& mode) {
  return mode.at("frequency").get<double>();
}

}  // namespace limber::test
