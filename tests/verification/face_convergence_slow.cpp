// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "support/temporary_folder.hpp"

/// A beam on a default fixed joint, by every second-order element and from one
/// element across on, against Timoshenko's beam: interfaces on faces of any
/// kind neither open the joint nor load the face against itself.
namespace limber::face_convergence_slow {
namespace {

constexpr double kLength = 1.0;      // [m]
constexpr double kThickness = 0.05;  // [m]
constexpr double kModulus = 70e9;    // [Pa]
constexpr double kPoisson = 0.3;
constexpr double kDensity = 2700.0;  // [kg/m^3]
constexpr double kForce = 100.0;     // [N]

/// Gmsh's script of the beam along x. @param across elements of an edge
struct Element {
  std::string name;
  bool is_recombined = true;  ///< across, into quadrangles
  bool is_extruded = true;    ///< hexahedra or prisms; else tetrahedra
  bool is_serendipity = false;
};

std::string write_script(const Element& e, int along, int across) {
  const double h = kThickness / 2.0;
  std::string text = fmt::format(
      "Point(1) = {{0, {0}, {0}}};\n"
      "l[] = Extrude {{0, {1}, 0}} {{ Point{{1}}; Layers{{{2}}}; }};\n"
      "r[] = Extrude {{0, 0, {1}}} {{ Line{{l[1]}}; Layers{{{2}}}; {3} }};\n"
      "s[] = Extrude {{{4}, 0, 0}} {{ Surface{{r[1]}}; Layers{{{5}}}; {6} }};\n"
      "Physical Surface(\"root\") = {{r[1]}};\n"
      "Physical Surface(\"tip\") = {{s[0]}};\n"
      "Physical Volume(\"body\") = {{s[1]}};\n"
      "Mesh.ElementOrder = 2;\n",
      -h, kThickness, across, e.is_recombined ? "Recombine;" : "", kLength,
      along, e.is_extruded ? "Recombine;" : "");
  if (e.is_serendipity) text += "Mesh.SecondOrderIncomplete = 1;\n";
  return text;
}

struct Answer {
  double tip = 0.0;        ///< [m]
  double frequency = 0.0;  ///< of the first mode [Hz]
};

Answer solve(const Element& element, int along, int across) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "beam.geo";
  std::ofstream(file) << write_script(element, along, across);
  flexbody::Recipe recipe;
  recipe.name = "beam";
  recipe.mesh.file = file;
  recipe.materials = {{"", {kModulus, kPoisson, kDensity}}};
  recipe.basis.eigenmodes = 10;
  recipe.interfaces = {{"root", flexbody::GroupNodes{"root"}},
                       {"tip", flexbody::GroupNodes{"tip"}}};
  const auto body =
      std::make_shared<const flexbody::ReducedBody>(flexbody::reduce(recipe));
  dynamics::SystemBuilder builder;
  const dynamics::BodyIndex beam =
      builder.add_flexible_body("beam", body, dynamics::Fidelity::coupled, {});
  builder.add_joint(
      "root", joints::JointKind::fixed,
      {.body = dynamics::kWorld,
       .X_BF = Pose{Matrix3::Identity(), body->interfaces[0].p_B}},
      {.body = beam, .interface = std::string("root")}, Vector3::UnitZ());
  const auto& tip = body->interfaces[1];
  builder.add_load("tip",
                   builder.attach_interface("tip", beam, tip,
                                            {Matrix3::Identity(), tip.p_B}),
                   {0.0, 0.0, -kForce}, Vector3::Zero(),
                   dynamics::LoadFrame::world, dynamics::Constant{});
  const dynamics::SystemModel model = builder.build();
  const dynamics::SystemState start = dynamics::make_state(model);
  const dynamics::SystemState found =
      dynamics::find_equilibrium(model, start).state;
  const dynamics::BodyState& at = found.bodies[0];
  const Vector3 moved =
      at.p_WB + at.quat_WB * (tip.p_B + tip.Phi_B * found.eta) - tip.p_B;
  return {moved.z(), dynamics::find_natural_frequencies(model, start)[0]};
}

/// Of a cantilever of Timoshenko's theory, shear coefficient 5/6.
Answer find_exact() {
  const double I = std::pow(kThickness, 4) / 12.0;
  const double A = kThickness * kThickness;
  const double G = kModulus / (2.0 * (1.0 + kPoisson));
  const double bending = std::pow(kLength, 3) / (3.0 * kModulus * I);
  const double shear = kLength / (5.0 / 6.0 * G * A);
  // Euler's frequency, less rotary inertia and shear to first order:
  // omega^2 / (1 + (I / A)(4.65 + (6/5)(E / G) 4.65) / L^2), with the mean
  // square slope over the mean square deflection of the first mode, 4.65.
  const double euler = std::pow(1.8751041, 2) /
                       (2.0 * M_PI * kLength * kLength) *
                       std::sqrt(kModulus * I / (kDensity * A));
  const double slope = 4.6478 / (kLength * kLength);
  const double less = I / A * slope * (1.0 + 6.0 / 5.0 * kModulus / G);
  return {-kForce * (bending + shear), euler / std::sqrt(1.0 + less)};
}

class FaceConvergence : public ::testing::TestWithParam<Element> {};

TEST_P(FaceConvergence, StartsFromOneElementAcross) {
  const Answer exact = find_exact();
  ASSERT_NEAR(exact.frequency, 41.1, 0.1);  // a refined mesh's
  ASSERT_NEAR(exact.tip, -0.916e-3, 1e-6);
  struct Mesh {
    int along;
    int across;
    double allowed;  // 1 % is the joint's
  };
  std::string table = "along across tip frequency [relative errors]\n";
  for (const Mesh& mesh : {Mesh{10, 1, 0.02}, Mesh{20, 1, 0.015},
                           Mesh{20, 2, 0.012}, Mesh{40, 4, 0.012}}) {
    const Answer found = solve(GetParam(), mesh.along, mesh.across);
    const double tip = found.tip / exact.tip - 1.0;
    const double frequency = found.frequency / exact.frequency - 1.0;
    table += fmt::format("{} {} {:.2e} {:.2e}\n", mesh.along, mesh.across, tip,
                         frequency);
    EXPECT_NEAR(tip, 0.0, mesh.allowed) << table;
    EXPECT_NEAR(frequency, 0.0, mesh.allowed) << table;
  }
  RecordProperty("errors", table);
}

INSTANTIATE_TEST_SUITE_P(
    Elements, FaceConvergence,
    ::testing::Values(Element{"hexahedra20", true, true, true},
                      Element{"hexahedra27"},
                      Element{"prisms15", false, true, true},
                      Element{"prisms18", false, true},
                      Element{"tetrahedra10", false, false}),
    [](const auto& element) { return element.param.name; });

}  // namespace
}  // namespace limber::face_convergence_slow
