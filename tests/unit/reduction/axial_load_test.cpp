// SPDX-License-Identifier: BSD-3-Clause
// Axial load of a meshed beam against Euler's closed forms.
#include "limber/dynamics/analysis/axial_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::dynamics::axial_load_test {
namespace {

using flexbody::testing::Bar;
using joints::JointKind;

constexpr double kLength = 2.0;                                   // [m]
constexpr double kEI = 200e9 * 0.02 * 0.01 * 0.01 * 0.01 / 12.0;  // [N m^2]
constexpr double kRhoA = 8000.0 * 0.02 * 0.01;                    // [kg/m]
constexpr double kPi = 3.14159265358979;

// Its root face in the origin.
std::shared_ptr<const flexbody::ReducedBody> make_beam(double thickness,
                                                       double width,
                                                       int eigenmodes) {
  flexbody::Recipe recipe =
      make_recipe(Bar{.corner = {0.0, -0.5 * thickness, -0.5 * width},
                      .size = {kLength, thickness, width},
                      .cells = 20,
                      .material = {200e9, 0.0, 8000.0}});
  recipe.basis.eigenmodes = eigenmodes;
  return std::make_shared<const flexbody::ReducedBody>(
      flexbody::reduce(recipe));
}

struct Beam {
  explicit Beam(std::shared_ptr<const flexbody::ReducedBody> of =
                    make_beam(0.01, 0.02, 4))
      : reduced(std::move(of)) {}
  std::shared_ptr<const flexbody::ReducedBody> reduced;
  SystemBuilder builder;
  BodyIndex body =
      builder.add_flexible_body("beam", reduced, Fidelity::uncoupled, {});

  void hold() {
    builder.add_joint("root", JointKind::fixed, {kWorld, Pose{}, {}},
                      {body, {}, std::string("root")}, Vector3::UnitZ());
  }
  // At the root and tip, in the beam's axes.
  void pull(const Vector3& at_root, const Vector3& at_tip) {
    for (std::size_t i = 0; i < 2; ++i) {
      const AttachmentIndex where = builder.attach_interface(
          i == 0 ? "a" : "b", body, reduced->interfaces[i],
          {Matrix3::Identity(), reduced->interfaces[i].p_B});
      builder.add_load(i == 0 ? "at root" : "at tip", where,
                       i == 0 ? at_root : at_tip, Vector3::Zero(),
                       LoadFrame::body, Constant{});
    }
  }
  [[nodiscard]] double fraction(const Vector3& w) const {
    return calc_state(w).fraction;
  }
  [[nodiscard]] double strain(const Vector3& w) const {
    return calc_state(w).strain;
  }
  [[nodiscard]] AxialState calc_state(const Vector3& w) const {
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    state.bodies[0].p_WB.x() = 0.5 * kLength;
    state.bodies[0].w_WB_B = w;
    SystemTerms terms = make_terms(model);
    calc_terms(model, state, Side::right, terms);
    return AxialLoad(model, body).calc_state(state, Side::right, terms);
  }
};

// 3.5160 sqrt(E I / (rho A L^4)); free 22.373.
TEST(AxialLoad, KnowsTheFrequencyOfTheBeamAlone) {
  const double unit = std::sqrt(kEI / kRhoA) / (kLength * kLength);
  Beam held;
  held.hold();
  const AxialLoad clamped(held.builder.build(), held.body);
  EXPECT_TRUE(clamped.is_held());
  EXPECT_NEAR(clamped.frequency(), 3.5160 * unit, 0.002 * 3.5160 * unit);
  const Beam lone;
  const AxialLoad free(lone.builder.build(), lone.body);
  EXPECT_FALSE(free.is_held());
  EXPECT_NEAR(free.frequency(), 22.373 * unit, 0.002 * 22.373 * unit);
}

// Of a cantilever pi^2 E I / (4 L^2).
TEST(AxialLoad, OfAHeldBeamIsAShareOfEulersLoad) {
  Beam beam;
  beam.hold();
  const double P = kPi * kPi * kEI / (4.0 * kLength * kLength);
  beam.pull(Vector3(0.3 * P, 7.0, 3.0), Vector3(-0.3 * P, -7.0, 5.0));
  EXPECT_NEAR(beam.fraction(Vector3::Zero()), -0.3, 0.003);
}

// Half of a force at one end is the mean along a beam that it accelerates.
TEST(AxialLoad, OfAPushedBeamIsTheMeanAlongIt) {
  const double P = kPi * kPi * kEI / (4.0 * kLength * kLength);
  Beam both;
  both.pull(Vector3(-P, 0.0, 0.0), Vector3(P, 0.0, 0.0));
  Beam one;
  one.pull(Vector3::Zero(), Vector3(P, 0.0, 0.0));
  const double fraction = both.fraction(Vector3::Zero());
  EXPECT_GT(fraction, 0.0);
  EXPECT_NEAR(one.fraction(Vector3::Zero()), 0.5 * fraction, 1e-9 * fraction);
}

// The mean tension is m Omega^2 L / 12 across the axis, and none along it.
TEST(AxialLoad, OfASpinningBeamIsItsMeanTension) {
  constexpr double kOmega = 5.0;
  const Beam beam;
  const double P = kPi * kPi * kEI / (4.0 * kLength * kLength);
  Beam pulled;
  pulled.pull(Vector3(-P, 0.0, 0.0), Vector3(P, 0.0, 0.0));
  const double tension = kRhoA * kLength * kLength * kOmega * kOmega / 12.0;
  const double expected = pulled.fraction(Vector3::Zero()) * tension / P;
  for (const Vector3& w : {Vector3(0, kOmega, 0), Vector3(0, 0, kOmega),
                           Vector3(0, 0.6 * kOmega, 0.8 * kOmega)}) {
    EXPECT_NEAR(beam.fraction(w), expected, 1e-3 * expected);
  }
  EXPECT_LT(std::abs(beam.fraction(Vector3(kOmega, 0, 0))), 1e-4 * expected);
}

// Short, so that its first mode of stretch is among its first twelve.
Beam make_thick_beam() { return Beam(make_beam(0.3, 0.4, 12)); }

// F / (E A), and rho Omega^2 L^2 / (12 E).
TEST(AxialLoad, StrainIsThatOfAPulledAndOfASpinningBar) {
  constexpr double kForce = 4e6;  // [N]
  Beam pulled = make_thick_beam();
  pulled.pull(Vector3(-kForce, 0.0, 0.0), Vector3(kForce, 0.0, 0.0));
  const double expected = kForce / (200e9 * 0.3 * 0.4);
  EXPECT_NEAR(pulled.strain(Vector3::Zero()), expected, 0.01 * expected);
  constexpr double kOmega = 50.0;  // [rad/s]
  const double spun =
      8000.0 * kOmega * kOmega * kLength * kLength / (12.0 * 200e9);
  EXPECT_NEAR(make_thick_beam().strain(Vector3(0, 0, kOmega)), spun,
              0.01 * spun);
}

// A free bar's first mode of stretch, sin(pi x / L) sqrt(2 / m), has sqrt(96) /
// pi^2 of x; its modes of bending have none.
TEST(AxialLoad, KnowsWhichModesStretch) {
  const Beam lone = make_thick_beam();
  const SystemModel model = lone.builder.build();
  const AxialLoad load(model, lone.body);
  const VectorX& stretch = load.stretch();
  const VectorX& lambda = flexbody::rest_stiffness(model.bodies[0].elasticity);
  ASSERT_EQ(stretch.size(), lambda.size());
  const double first = kPi / kLength * std::sqrt(200e9 / 8000.0);  // [rad/s]
  int found = 0;
  for (Eigen::Index k = 0; k < stretch.size(); ++k) {
    if (std::abs(std::sqrt(lambda[k]) - first) < 0.01 * first) {
      EXPECT_NEAR(stretch[k], std::sqrt(96.0) / (kPi * kPi), 0.01);
      ++found;
    } else if (std::sqrt(lambda[k]) < 0.9 * first) {
      EXPECT_LT(stretch[k], 1e-6);
    }
  }
  EXPECT_EQ(found, 1);
  EXPECT_LT(stretch.squaredNorm(), 1.0 + 1e-9);
}

TEST(AxialLoad, TurnOfInterfacesIsThatOfTheirTables) {
  Beam beam;
  beam.pull(Vector3::Zero(), Vector3::UnitX());
  const SystemModel model = beam.builder.build();
  const VectorX eta = VectorX::LinSpaced(model.bodies[0].modes, -0.02, 0.03);
  const Vector3 root = beam.reduced->interfaces[0].Psi_B * eta;
  const Vector3 tip = beam.reduced->interfaces[1].Psi_B * eta;
  const InterfaceRotation rotation =
      find_rotation(find_interfaces(model, beam.body), eta);
  EXPECT_NEAR(rotation.own, std::max(root.norm(), tip.norm()), 1e-12);
  EXPECT_NEAR(rotation.relative, (tip - root).norm(), 1e-12);
}

}  // namespace
}  // namespace limber::dynamics::axial_load_test
