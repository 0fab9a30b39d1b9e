// SPDX-License-Identifier: BSD-3-Clause
// Motion with every kind of modal elasticity, by every integrator.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/integrators/energy_conserving.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/integrators/make_integrator.hpp"
#include "limber/dynamics/integrators/stable_step.hpp"
#include "limber/dynamics/simulation/modal_loads.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/chain.hpp"
#include "support/elastic_kinds.hpp"
#include "support/free_chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::elastic_motion_test {
namespace {

using testing::Duffing;

constexpr int kIntegrators = static_cast<int>(kLastIntegrator) + 1;

std::string name_scheme(IntegratorKind kind) {
  std::string name = to_string(kind);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// --- Duffing's oscillator ---------------------------------------------------

constexpr Duffing kDuffing{100.0, 8e6};
constexpr double kAmplitude = 5e-3;  // b A^2 = 2 a

struct Oscillator {
  SystemModel model;
  SystemState state;
};

// At level `uncoupled`, where linear modes would have their closed form.
Oscillator make_oscillator(const Duffing& duffing, double amplitude) {
  testing::PointMassBody body =
      testing::make_point_mass_body(12, 2, 1.0, 1.0, 1.0, 3);
  body.reduced.clamped = true;
  SystemBuilder builder;
  builder.add_flexible_body("spring", share(body), Fidelity::uncoupled, {},
                            duffing.elasticity());
  Oscillator out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.eta[0] = amplitude;
  return out;
}

double find_error(IntegratorKind kind, int steps) {
  const Oscillator duffing = make_oscillator(kDuffing, kAmplitude);
  SystemState state = duffing.state;
  SimulationSettings settings;
  settings.integrator = kind;
  settings.end_time = 1.3 * kDuffing.period(kAmplitude);
  settings.step = settings.end_time / steps;
  simulate(duffing.model, state, settings, {});
  EXPECT_EQ(state.eta[1], 0.0);
  return std::abs(state.eta[0] -
                  kDuffing.position(kAmplitude, settings.end_time)) /
         kAmplitude;
}

class DuffingBy : public ::testing::TestWithParam<int> {};

TEST_P(DuffingBy, ConvergesToTheClosedFormWithItsOrder) {
  const auto kind = static_cast<IntegratorKind>(GetParam());
  const int order = traits_of(kind).order;
  const int steps = order == 1 ? 20000 : order == 2 ? 2000 : 300;
  const double coarse = find_error(kind, steps);
  const double fine = find_error(kind, 2 * steps);
  EXPECT_LT(fine, order == 1 ? 0.02 : 1e-4);
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.1) << coarse << ' ' << fine;
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, DuffingBy,
                         ::testing::Range(0, kIntegrators), [](const auto& i) {
                           return name_scheme(
                               static_cast<IntegratorKind>(i.param));
                         });

// A linear spring as stiff as at rest would be a quarter of a period off.
TEST(Duffing, HasThePeriodOfTheEllipticIntegral) {
  const Oscillator duffing = make_oscillator(kDuffing, kAmplitude);
  SystemState state = duffing.state;
  const double period = kDuffing.period(kAmplitude);
  SimulationSettings settings;
  settings.integrator = IntegratorKind::runge_kutta_4;
  settings.end_time = period;
  settings.step = period / 4000;
  simulate(duffing.model, state, settings, {});
  EXPECT_NEAR(state.eta[0], kAmplitude, 1e-9 * kAmplitude);
  EXPECT_NEAR(state.etadot[0], 0.0, 1e-7 * kAmplitude * 17.0);
  EXPECT_GT(std::abs(std::cos(10.0 * period) - 1.0), 0.5);
}

TEST(Duffing, HasNoClosedFormOfLinearModes) {
  EXPECT_FALSE(has_closed_modal_loads(
      make_oscillator(kDuffing, kAmplitude).model, BodyIndex{0}));
  EXPECT_TRUE(has_closed_modal_loads(
      make_oscillator({100.0, 0.0}, kAmplitude).model, BodyIndex{0}));
}

TEST(Duffing, BoundsExplicitStepsByTheTangentWhereItStands) {
  const double stiff = kDuffing.a + 3.0 * kDuffing.b * kAmplitude * kAmplitude;
  const Oscillator bent = make_oscillator(kDuffing, kAmplitude);
  const Oscillator rest = make_oscillator(kDuffing, 0.0);
  EXPECT_NEAR(find_stable_step(bent.model, bent.state), 2.0 / std::sqrt(stiff),
              2e-3 / std::sqrt(stiff));
  EXPECT_NEAR(find_stable_step(rest.model, rest.state),
              2.0 / std::sqrt(kDuffing.a), 2e-3 / std::sqrt(kDuffing.a));
}

// The bound is that of the start. What stiffens later beyond it is not taken
// for a result.
TEST(Duffing, ThatStiffensBeyondAnExplicitStepIsTold) {
  Oscillator duffing = make_oscillator(kDuffing, 0.0);
  duffing.state.etadot[0] = 20.0;
  SimulationSettings settings;
  settings.integrator = IntegratorKind::central_differences;
  settings.end_time = 10.0;
  settings.step = 0.18;
  EXPECT_THROW(simulate(duffing.model, duffing.state, settings, {}),
               NumericalError);
}

// --- The same body in two bases ---------------------------------------------

constexpr int kModes = 5;

// Three bodies on hinges, the first clamped if asked, under gravity and a load.
struct Arm {
  SystemModel model;
  SystemState state;
};

Arm make_arm(Fidelity fidelity, bool is_clamped, const MatrixX* basis) {
  const testing::PointMassBody body =
      testing::make_point_mass_body(24, kModes, 4.0, 1.0, 30.0, 42);
  flexbody::ReducedBody reduced = body.reduced;
  flexbody::InterfaceTable near = make_interface(body, 0, 6);
  flexbody::InterfaceTable far = make_interface(body, 6, 12);
  std::optional<flexbody::ModalElasticity> elasticity;
  if (basis != nullptr) {
    elasticity = testing::turn_stiffness(reduced.lambda, *basis);
    reduced = testing::turn_basis(reduced, *basis);
    near = testing::turn_basis(near, *basis);
    far = testing::turn_basis(far, *basis);
  }
  SystemBuilder builder;
  AttachmentIndex tip =
      builder.attach_world("wall", {Matrix3::Identity(), near.p_B});
  Arm arm;
  for (int i = 0; i < 3; ++i) {
    flexbody::ReducedBody own = reduced;
    own.clamped = is_clamped && i == 0;
    const BodyIndex b = builder.add_flexible_body(
        "link" + std::to_string(i),
        std::make_shared<const flexbody::ReducedBody>(own), fidelity,
        {.rayleigh_mass = 0.3, .ratios = {}}, elasticity);
    const AttachmentIndex root = builder.attach_interface(
        "root", b, near, {Matrix3::Identity(), near.p_B});
    if (!own.clamped) {
      builder.add_coupler("joint" + std::to_string(i),
                          joints::make_joint_bushing(
                              joints::JointKind::revolute, Vector3::UnitX(),
                              {.translational_stiffness = 2e4,
                               .rotational_stiffness = 1e3,
                               .translational_damping = 1.0,
                               .rotational_damping = 0.1}),
                          tip, root);
    }
    tip =
        builder.attach_interface("tip", b, far, {Matrix3::Identity(), far.p_B});
  }
  builder.set_gravity({0.5, 0.0, -9.81});
  builder.add_load("push", tip, {3.0, 20.0, 5.0}, {0.3, 0.2, 0.1},
                   LoadFrame::body, Sinusoid{.frequency = 3.0});
  arm.model = builder.build();
  arm.state = make_state(arm.model);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 3; ++i) {
    arm.state.bodies[static_cast<std::size_t>(i)].p_WB =
        i * (far.p_B - near.p_B);
    VectorX rate(kModes);
    for (double& x : rate) x = 0.2 * uniform(random);
    arm.state.etadot.segment(kModes * i, kModes) =
        basis != nullptr ? VectorX(basis->transpose() * rate) : rate;
  }
  return arm;
}

// The arm's state after 0.1 s, modes in the first basis.
SystemState run(Arm arm, IntegratorKind kind, double h, const MatrixX* basis) {
  SimulationSettings settings;
  settings.integrator = kind;
  settings.step = h;
  settings.newton_tolerance = 1e-13;
  settings.newton_iterations = 40;
  const auto scheme = make_integrator(arm.model, settings);
  scheme->start(arm.state, h);
  const int steps = static_cast<int>(std::lround(0.1 / h));
  for (int i = 1; i <= steps; ++i) scheme->step(arm.state, h, i * h);
  for (int i = 0; basis != nullptr && i < 3; ++i) {
    for (VectorX* x : {&arm.state.eta, &arm.state.etadot}) {
      x->segment(kModes * i, kModes) =
          (*basis * x->segment(kModes * i, kModes)).eval();
    }
  }
  return arm.state;
}

struct Difference {
  double value = 0.0;   // of everything, each against its size
  double motion = 0.0;  // of the modes
};

Difference find_difference(const SystemState& a, const SystemState& b) {
  Difference d;
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    d.value =
        std::max({d.value, (a.bodies[i].p_WB - b.bodies[i].p_WB).norm(),
                  (a.bodies[i].v_WB_W - b.bodies[i].v_WB_W).norm() / 10.0,
                  (a.bodies[i].w_WB_B - b.bodies[i].w_WB_B).norm() / 10.0,
                  a.bodies[i].quat_WB.angularDistance(b.bodies[i].quat_WB)});
  }
  d.motion = a.eta.norm();
  d.value = std::max({d.value, (a.eta - b.eta).norm() / a.eta.norm(),
                      (a.etadot - b.etadot).norm() / a.etadot.norm()});
  return d;
}

class TurnedBasis
    : public ::testing::TestWithParam<std::tuple<int, Fidelity, bool>> {};

// A dense stiffness takes paths of its own through forces, Newton's matrix and
// energies. Explicit Euler and splitting, which take what swings alone from the
// matrix's diagonal, agree to their error, which their order shrinks.
TEST_P(TurnedBasis, OfTheSameBodyGivesTheSameMotion) {
  const auto [number, fidelity, is_clamped] = GetParam();
  const auto kind = static_cast<IntegratorKind>(number);
  const MatrixX basis = testing::make_basis(kModes, 9);
  const Arm plain = make_arm(fidelity, is_clamped, nullptr);
  const Arm turned = make_arm(fidelity, is_clamped, &basis);
  const auto compare = [&](double h) {
    return find_difference(run(plain, kind, h, nullptr),
                           run(turned, kind, h, &basis));
  };
  const bool swings_alone = kind == IntegratorKind::splitting ||
                            kind == IntegratorKind::explicit_euler;
  const double h = traits_of(kind).is_implicit ? 1e-3 : 1e-4;
  const Difference found = compare(h);
  EXPECT_GT(found.motion, 1e-3);
  if (!swings_alone) {
    EXPECT_LT(found.value, 1e-9);
    return;
  }
  const double order = std::log2(found.value / compare(0.5 * h).value);
  EXPECT_LT(found.value, 0.05);
  EXPECT_NEAR(order, traits_of(kind).order, 0.2);
}

INSTANTIATE_TEST_SUITE_P(
    Of, TurnedBasis,
    ::testing::Combine(::testing::Range(0, kIntegrators),
                       ::testing::Values(Fidelity::uncoupled, Fidelity::one_way,
                                         Fidelity::coupled),
                       ::testing::Bool()),
    [](const auto& i) {
      std::string name =
          name_scheme(static_cast<IntegratorKind>(std::get<0>(i.param))) + "_" +
          std::string(to_string(std::get<1>(i.param))) +
          (std::get<2>(i.param) ? "_clamped" : "");
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

// --- Energy -----------------------------------------------------------------

// Three bodies on hinges, far from linear.
testing::FreeChain make_stiffening_chain() {
  testing::FreeChain chain = testing::make_free_chain(1e6, 1.0, 1.0);
  testing::stiffen(chain.model, 0.02);
  return chain;
}

TEST(ElasticMotion, KeepsItsEnergyAndMomentaToRoundOffOver10000Steps) {
  const testing::FreeChain chain = make_stiffening_chain();
  const testing::KeptDrift drift =
      testing::find_energy_conserving_drift(chain, chain.shortest, 10000);
  EXPECT_LT(drift.energy, 1e-11);
  EXPECT_LT(drift.linear, 1e-13);
  EXPECT_LT(drift.angular, 1e-11);
}

// Without the discrete gradient: the trapezoidal rule, undamped.
TEST(ElasticMotion, LosesItsEnergyWithoutADiscreteGradient) {
  const testing::FreeChain chain = make_stiffening_chain();
  GeneralizedAlpha scheme(chain.model, {.rho_inf = 1.0});
  SystemState state = chain.state;
  const double start = calc_energy(chain.model, state).total();
  double drift = 0.0;
  for (int i = 1; i <= 200; ++i) {
    if (i == 1) scheme.start(state, chain.shortest);
    scheme.step(state, chain.shortest, i * chain.shortest);
    drift = std::max(
        drift, std::abs(calc_energy(chain.model, state).total() / start - 1.0));
  }
  EXPECT_GT(drift, 1e-5);
}

TEST(ElasticMotion, IsFarFromLinear) {
  const testing::FreeChain chain = make_stiffening_chain();
  SystemModel linear = chain.model;
  for (BodyModel& body : linear.bodies) {
    body.elasticity = flexbody::DiagonalStiffness({body.reduced->lambda});
  }
  SystemState state = chain.state;
  SystemState other = chain.state;
  EnergyConserving scheme(chain.model, {});
  EnergyConserving of_linear(linear, {});
  double most = 0.0;
  for (int i = 1; i <= 100; ++i) {
    const double h = 0.1 * chain.shortest;
    scheme.step(state, h, i * h);
    of_linear.step(other, h, i * h);
    most = std::max(most, (state.eta - other.eta).norm() / state.eta.norm());
  }
  EXPECT_GT(most, 0.3);
}

// Its tangent over a step stands in Newton's matrix: without it, as many more
// iterations as the modes' motion is nonlinear.
TEST(ElasticMotion, TakesHardlyMoreIterationsThanLinearModes) {
  const testing::FreeChain chain = make_stiffening_chain();
  const testing::FreeChain linear = testing::make_free_chain(1e6, 1.0, 1.0);
  const auto count = [&](const SystemModel& model) {
    EnergyConserving scheme(model, {});
    SystemState state = chain.state;
    int iterations = 0;
    for (int i = 1; i <= 100; ++i) {
      const double h = 0.5 * chain.shortest;
      iterations += scheme.step(state, h, i * h).iterations;
    }
    return iterations;
  };
  EXPECT_LE(count(chain.model), 1.3 * count(linear.model));
}

// --- Level nonlinear --------------------------------------------------------

TEST(NonlinearMotion, KeepsItsEnergyAndMomentaToRoundOffOver10000Steps) {
  testing::FreeChain chain = testing::make_free_chain(1e6, 1.0, 1.0);
  testing::bend(chain.model, 0.05);
  const testing::KeptDrift drift =
      testing::find_energy_conserving_drift(chain, 0.5 * chain.shortest, 10000);
  EXPECT_LT(drift.energy, 1e-11);
  EXPECT_LT(drift.linear, 1e-13);
  EXPECT_LT(drift.angular, 1e-11);
}

class NonlinearBy : public ::testing::TestWithParam<int> {};

TEST_P(NonlinearBy, ConvergesWithItsOrder) {
  const auto kind = static_cast<IntegratorKind>(GetParam());
  const auto run = [](IntegratorKind scheme, int steps) {
    Arm arm = make_arm(Fidelity::coupled, false, nullptr);
    testing::bend(arm.model, 0.1);
    SimulationSettings settings;
    settings.integrator = scheme;
    settings.end_time = 0.04;
    settings.step = settings.end_time / steps;
    simulate(arm.model, arm.state, settings, {});
    return arm.state.eta;
  };
  const VectorX exact = run(IntegratorKind::runge_kutta_4, 1600);
  const int order = traits_of(kind).order;
  const int steps = order == 1 ? 1600 : order == 2 ? 200 : 100;
  const double coarse = (run(kind, steps) - exact).norm();
  const double fine = (run(kind, 2 * steps) - exact).norm();
  EXPECT_LT(fine, 0.02 * exact.norm());
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.2) << coarse << ' ' << fine;
}

INSTANTIATE_TEST_SUITE_P(EveryScheme, NonlinearBy,
                         ::testing::Range(0, kIntegrators), [](const auto& i) {
                           return name_scheme(
                               static_cast<IntegratorKind>(i.param));
                         });

// The audit knows what is stored.
TEST(ElasticMotion, OfADampedArmUnderLoadsClosesItsAudit) {
  Arm arm = make_arm(Fidelity::coupled, false, nullptr);
  testing::stiffen(arm.model, 0.02);
  std::vector<EnergyBalance> energies;
  simulate(arm.model, arm.state,
           {.integrator = IntegratorKind::energy_conserving,
            .end_time = 0.2,
            .step = 1e-3,
            .output_times = {0.0, 0.1, 0.2}},
           [&](const SystemState&, const EnergyBalance& energy) {
             energies.push_back(energy);
           });
  ASSERT_EQ(energies.size(), 3U);
  for (const EnergyBalance& e : energies) {
    EXPECT_NEAR(e.total() - energies[0].total() - e.work + e.dissipated, 0.0,
                1e-12 * (energies[0].total() + std::abs(e.work)));
  }
  EXPECT_GT(energies.back().dissipated, 1e-3);
  EXPECT_GT(energies.back().elastic, 1e-3);
}

}  // namespace
}  // namespace limber::dynamics::elastic_motion_test
