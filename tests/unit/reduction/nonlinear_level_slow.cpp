// SPDX-License-Identifier: BSD-3-Clause
// Level `nonlinear` of a meshed beam against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/analysis/natural_frequencies.hpp"
#include "limber/dynamics/analysis/steady_spin.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/terms/kinematics.hpp"
#include "limber/reduction/reduce.hpp"
#include "unit/reduction/bar.hpp"

namespace limber::dynamics::nonlinear_level_slow {
namespace {

using flexbody::testing::Bar;
using joints::JointKind;

constexpr double kLength = 1.0;
constexpr double kEI = 200e9 * 1e-8 / 12.0;  // [N m^2]
constexpr double kRhoA = 8000.0 * 1e-4;      // [kg/m]

// Of 1 m, 100 times as long as thick, its root face in the origin.
std::shared_ptr<const flexbody::ReducedBody> make_blade(int cells) {
  flexbody::Recipe recipe = make_recipe(Bar{.corner = {0.0, -0.005, -0.005},
                                            .size = {kLength, 0.01, 0.01},
                                            .cells = cells,
                                            .material = {200e9, 0.0, 8000.0}});
  recipe.basis.eigenmodes = 4;
  recipe.manifold = true;
  return std::make_shared<const flexbody::ReducedBody>(
      flexbody::reduce(recipe));
}

// So stiff that the root's compliance adds 0.001 % to the blade's.
JointOptions hold() {
  return {.held = {.translational_stiffness = 1e4 * 200e9 * 1e-4,
                   .rotational_stiffness = 1e5 * kEI}};
}

// --- A dead load across the tip ---------------------------------------------

// The tip of an inextensible cantilever, theta'' = -k cos theta, theta(0) =
// theta'(1) = 0, k = P L^2 / (E I). Source: Bisshopp and Drucker, Q. Appl.
// Math. 3, 1945.
struct Elastica {
  double x = 0.0, y = 0.0, curvature = 0.0;
};
Elastica shoot(double k, double curvature) {
  constexpr int kSteps = 2000;
  constexpr double h = 1.0 / kSteps;
  Elastica tip{0.0, 0.0, curvature};
  double theta = 0.0;
  for (int i = 0; i < kSteps; ++i) {  // Stoermer-Verlet
    const double half = tip.curvature - 0.5 * h * k * std::cos(theta);
    const double middle = theta + 0.5 * h * half;
    tip.x += h * std::cos(middle);
    tip.y += h * std::sin(middle);
    theta += h * half;
    tip.curvature = half - 0.5 * h * k * std::cos(theta);
  }
  return tip;
}
template <typename F>
double bisect(double low, double high, const F& is_above) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (is_above(middle) ? high : low) = middle;
  }
  return low;
}
Elastica find_elastica(double k) {
  return shoot(k, bisect(0.0, 2.0 * k, [&](double curvature) {
                 return shoot(k, curvature).curvature > 0.0;
               }));
}

Vector3 bend_blade(const std::shared_ptr<const flexbody::ReducedBody>& blade,
                   Fidelity level, double k) {
  SystemBuilder builder;
  const BodyIndex body = builder.add_flexible_body("blade", blade, level, {});
  builder.add_joint("root", JointKind::fixed, {kWorld, Pose{}, {}},
                    {body, {}, std::string("root")}, Vector3::UnitZ(), hold());
  const AttachmentIndex tip =
      builder.attach_interface("tip", body, blade->interfaces[1],
                               {Matrix3::Identity(), blade->interfaces[1].p_B});
  builder.add_load("force", tip, {0.0, k * kEI, 0.0}, Vector3::Zero(),
                   LoadFrame::world, Constant{});
  const SystemModel model = builder.build();
  SystemState start = make_state(model);
  start.bodies[0].p_WB.x() = 0.5 * kLength;
  const Equilibrium found = find_equilibrium(model, start);
  return find_frame_motion(model, found.state, tip).X_WF.p;
}

TEST(NonlinearLevel, BendsAsTheElastica) {
  const auto blade = make_blade(20);
  const std::array deflections = {0.2, 0.4, 0.6};
  const std::array within = {0.003, 0.01, 0.02};
  const std::array linear_off = {0.013, 0.05, 0.11};
  for (std::size_t i = 0; i < deflections.size(); ++i) {
    const double k = bisect(0.0, 20.0, [&](double load) {
      return find_elastica(load).y > deflections[i];
    });
    const Elastica exact = find_elastica(k);
    const Vector3 tip = bend_blade(blade, Fidelity::nonlinear, k);
    EXPECT_NEAR(tip.y(), exact.y, within[i] * exact.y);
    EXPECT_NEAR(tip.x(), exact.x, within[i] * exact.y);
    const Vector3 linear = bend_blade(blade, Fidelity::coupled, k);
    EXPECT_GT(linear.y(), (1.0 + linear_off[i]) * exact.y);
  }
}

// --- Clamped in its mesh ----------------------------------------------------

// Of 1 m, fixed at its root.
std::shared_ptr<const flexbody::ReducedBody> make_clamped(
    double thickness = 0.05) {
  const double half = 0.5 * thickness;
  flexbody::Recipe recipe =
      make_recipe(Bar{.corner = {0.0, -half, -half},
                      .size = {kLength, thickness, thickness},
                      .cells = 20,
                      .material = {200e9, 0.0, 8000.0},
                      .is_clamped = true});
  recipe.interfaces.erase(recipe.interfaces.begin());
  recipe.basis.eigenmodes = 4;
  recipe.manifold = true;
  return std::make_shared<const flexbody::ReducedBody>(
      flexbody::reduce(recipe));
}

constexpr double kClampedEI = 200e9 * 0.05 * 0.05 * 0.05 * 0.05 / 12.0;
constexpr double kClampedRhoA = 8000.0 * 0.05 * 0.05;

// Displacement of the tip under a force on it and gravity.
Vector3 push_clamped(const std::shared_ptr<const flexbody::ReducedBody>& bar,
                     Fidelity level, const Vector3& force,
                     const Vector3& gravity) {
  SystemBuilder builder;
  const BodyIndex body = builder.add_flexible_body("bar", bar, level, {});
  const Vector3& rest = bar->interfaces[0].p_B;
  const AttachmentIndex tip = builder.attach_interface(
      "tip", body, bar->interfaces[0], {Matrix3::Identity(), rest});
  builder.add_load("force", tip, force, Vector3::Zero(), LoadFrame::world,
                   Constant{});
  builder.set_gravity(gravity);
  const SystemModel model = builder.build();
  const Equilibrium found = find_equilibrium(model, make_state(model));
  return find_frame_motion(model, found.state, tip).X_WF.p - rest;
}

// A beam that keeps its length comes nearer by int w'^2 / 2: under a force at
// the tip by 3/5 of its w^2 / L, under its weight by 4/7.
TEST(NonlinearLevel, ComesNearerAsItBendsIfClamped) {
  const auto bar = make_clamped();
  const double force = 0.06 * kClampedEI;  // 2 % of the length
  const double gravity = 0.16 * kClampedEI / kClampedRhoA;
  const Vector3 pushed = push_clamped(bar, Fidelity::nonlinear,
                                      {0.0, force, 0.0}, Vector3::Zero());
  const Vector3 heavy = push_clamped(bar, Fidelity::nonlinear, Vector3::Zero(),
                                     {0.0, gravity, 0.0});
  const auto find_fraction = [](const Vector3& tip) {
    return -tip.x() * kLength / (tip.y() * tip.y());
  };
  EXPECT_NEAR(pushed.y(), 0.02, 2e-4);  // of shear half
  EXPECT_NEAR(heavy.y(), 0.02, 2e-4);
  EXPECT_NEAR(find_fraction(pushed), 3.0 / 5.0, 0.01 * 0.6);
  EXPECT_NEAR(find_fraction(heavy), 4.0 / 7.0, 0.01 * 0.57);
  const Vector3 linear =
      push_clamped(bar, Fidelity::coupled, {0.0, force, 0.0}, Vector3::Zero());
  EXPECT_LT(std::abs(linear.x()), 1e-9);
}

// Along its axis it is 40 000 times as stiff as across.
TEST(NonlinearLevel, ComesNearerIfClampedAndAHundredTimesAsLongAsThick) {
  constexpr double kThickness = 0.01;
  const auto bar = make_clamped(kThickness);
  const double force = 0.06 * 200e9 * std::pow(kThickness, 4) / 12.0;
  const Vector3 tip = push_clamped(bar, Fidelity::nonlinear, {0.0, force, 0.0},
                                   Vector3::Zero());
  EXPECT_NEAR(tip.y(), 0.02, 1e-4);
  EXPECT_NEAR(-tip.x() * kLength / (tip.y() * tip.y()), 0.6, 0.006);
}

// A beam column: w = F L^3 / (E I) (tan u - u) / u^3, u^2 = P L^2 / (E I); less
// if pulled, by tanh.
TEST(NonlinearLevel, SoftensUnderCompressionIfClamped) {
  const auto bar = make_clamped();
  const double force = 1e-3 * kClampedEI;
  const auto find_ratio = [&](Fidelity level, double along) {
    const auto push = [&](double P) {
      return push_clamped(bar, level, {P, force, 0.0}, Vector3::Zero()).y();
    };
    return push(along) / push(0.0);
  };
  for (const double fraction : {0.5, 0.8}) {
    const double u = 0.5 * std::numbers::pi * std::sqrt(fraction);
    const double P = u * u * kClampedEI;
    const double pressed = 3.0 * (std::tan(u) - u) / (u * u * u);
    const double pulled = 3.0 * (u - std::tanh(u)) / (u * u * u);
    EXPECT_NEAR(find_ratio(Fidelity::nonlinear, -P), pressed, 0.01 * pressed);
    EXPECT_NEAR(find_ratio(Fidelity::nonlinear, P), pulled, 0.01 * pulled);
    EXPECT_NEAR(find_ratio(Fidelity::coupled, -P), 1.0, 1e-6);
  }
}

// --- A rotating blade -------------------------------------------------------

// Lag and flap, in sqrt(E I / (rho A L^4)), of a blade on a heavy hub that
// turns `eta` times as fast.
std::pair<double, double> find_frequencies(
    const std::shared_ptr<const flexbody::ReducedBody>& blade, Fidelity level,
    double eta) {
  const double unit = std::sqrt(kEI / kRhoA);
  SystemBuilder builder;
  const BodyIndex hub =
      builder.add_rigid_body("hub", {1e6, 1e6 * Matrix3::Identity()});
  const BodyIndex body = builder.add_flexible_body("blade", blade, level, {});
  builder.add_joint("axle", JointKind::revolute, {kWorld, Pose{}, {}},
                    {hub, Pose{}, {}}, Vector3::UnitZ());
  builder.add_joint("root", JointKind::fixed, {hub, Pose{}, {}},
                    {body, {}, std::string("root")}, Vector3::UnitZ(), hold());
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  const Vector3 spin(0.0, 0.0, eta * unit);
  state.bodies[0].w_WB_B = state.bodies[1].w_WB_B = spin;
  state.bodies[1].p_WB.x() = 0.5 * kLength;
  state.bodies[1].v_WB_W = spin.cross(state.bodies[1].p_WB);
  const NaturalModes found =
      find_natural_modes(model, find_steady_spin(model, state));
  std::array<double, 2> lowest = {0.0, 0.0};
  std::size_t count = 0;
  for (const NaturalMode& mode : found.modes) {
    const double frequency = std::abs(mode.value) / unit;
    if (frequency > 0.5 && count < 2) lowest[count++] = frequency;
  }
  return {std::min(lowest[0], lowest[1]), std::max(lowest[0], lowest[1])};
}

// Source: of the closed forms, Wright et al., J. Appl. Mech. 49, 1982; lag^2 =
// flap^2 - eta^2.
TEST(NonlinearLevel, StiffensInSpinAsARotatingCantilever) {
  const auto blade = make_blade(40);
  for (const auto& [eta, flap, lag] :
       {std::array{1.0, 3.6817, 3.5432}, std::array{2.0, 4.1373, 3.6218},
        std::array{3.0, 4.7973, 3.7435}, std::array{4.0, 5.5850, 3.8977},
        std::array{5.0, 6.4495, 4.0739}, std::array{6.0, 7.3604, 4.2632}}) {
    const auto found = find_frequencies(blade, Fidelity::nonlinear, eta);
    EXPECT_NEAR(found.first, lag, 0.0005 * lag) << eta;
    EXPECT_NEAR(found.second, flap, 0.0005 * flap) << eta;
    const auto linear = find_frequencies(blade, Fidelity::coupled, eta);
    EXPECT_LT(linear.first, (1.0 - 0.01 * eta) * lag) << eta;  // it softens
  }
}

}  // namespace
}  // namespace limber::dynamics::nonlinear_level_slow
