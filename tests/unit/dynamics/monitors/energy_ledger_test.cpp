// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/bushing.hpp"
#include "support/point_mass_body.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::energy_ledger_test {
namespace {

using testing::add_mass;
using testing::Mass;

constexpr double kRoundoff = 1e-12;

StepResult make_totals(double load_work, double dissipated) {
  StepResult totals;
  totals.load_work = load_work;
  totals.dissipated = dissipated;
  return totals;
}

/// A cloud of point masses whose tip is pulled and whose modes are damped.
class CloudLedger : public ::testing::Test {
 protected:
  CloudLedger()
      : cloud_(testing::make_point_mass_body(24, 3, 4.0, 1.0, 60.0, 42)),
        tip_(testing::make_interface(cloud_, 6, 12)),
        model_(build()) {}

  SystemModel build() const {
    SystemBuilder builder;
    const auto body = builder.add_flexible_body(
        "cloud", testing::share(cloud_), Fidelity::coupled,
        {.rayleigh_mass = 3.0, .ratios = {}});
    const auto tip = builder.attach_interface("tip", body, tip_,
                                              {Matrix3::Identity(), tip_.p_B});
    builder.add_load("pull", tip, kForce_W, Vector3::Zero(), LoadFrame::world,
                     Constant{});
    return builder.build();
  }

  /// The same shape and place at two instants, with other velocities.
  [[nodiscard]] SystemState make_moving(double t, double scale) const {
    SystemState state = make_state(model_);
    state.t = t;
    state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0.4, -0.2, 0.7)));
    state.bodies[0].v_WB_W = scale * Vector3(0.3, -0.5, 0.2);
    state.bodies[0].w_WB_B = scale * Vector3(-1.0, 0.6, 0.8);
    state.eta << 0.02, -0.01, 0.03;
    state.etadot << 0.5 * scale, 0.3 * scale, -0.4 * scale;
    return state;
  }

  [[nodiscard]] Vector3 find_velocity(const SystemState& state,
                                      const Vector3& x,
                                      const MatrixX& Phi) const {
    const BodyState& body = state.bodies[0];
    const Vector3 r = x + Phi * state.eta;
    return body.v_WB_W +
           body.quat_WB * (body.w_WB_B.cross(r) + Phi * state.etadot);
  }
  [[nodiscard]] double sum_kinetic(const SystemState& state) const {
    double sum = 0.0;
    for (Eigen::Index n = 0; n < cloud_.masses.size(); ++n) {
      sum += 0.5 * cloud_.masses[n] *
             find_velocity(state, cloud_.reduced.rows.x_B.col(n),
                           cloud_.reduced.rows.Phi_B.middleRows<3>(3 * n))
                 .squaredNorm();
    }
    return sum;
  }
  [[nodiscard]] double find_elastic(const SystemState& state) const {
    return 0.5 * cloud_.reduced.lambda.dot(state.eta.cwiseAbs2());
  }
  [[nodiscard]] double find_power(const SystemState& state) const {
    return kForce_W.dot(find_velocity(state, tip_.p_B, tip_.Phi_B)) -
           3.0 * state.etadot.squaredNorm();
  }
  [[nodiscard]] SystemTerms find_terms(const SystemState& state) const {
    SystemTerms terms = make_terms(model_);
    calc_terms(model_, state, Side::right, terms);
    return terms;
  }

  inline static const Vector3 kForce_W{5.0, -2.0, 3.0};
  testing::PointMassBody cloud_;
  flexbody::InterfaceTable tip_;
  SystemModel model_;
};

TEST_F(CloudLedger, HasTheEnergyOfThePointMasses) {
  const SystemState state = make_moving(0.0, 1.0);
  EnergyLedger ledger(model_);
  ledger.start(state, find_terms(state), {});
  const EnergyRecord record = ledger.find_record();
  const double kinetic = sum_kinetic(state);
  const double elastic = find_elastic(state);
  EXPECT_NEAR(record.kinetic.value, kinetic, kRoundoff * kinetic);
  EXPECT_NEAR(record.elastic.value, elastic, kRoundoff * elastic);
  EXPECT_NEAR(record.stored.value, kinetic + elastic, kRoundoff * kinetic);
  EXPECT_NEAR(record.throughput, kinetic + elastic, kRoundoff * kinetic);
  EXPECT_EQ(record.coupler.value, 0.0);
  EXPECT_EQ(record.drift.value, 0.0);
}

// E_1 - E_0 - h (P_0 + P_1) / 2, P of the pull at its point and of the damping.
TEST_F(CloudLedger, GivesABodyWhatNoPowerExplains) {
  const SystemState first = make_moving(2.0, 1.0);
  const SystemState last = make_moving(2.1, 1.5);
  EnergyLedger ledger(model_);
  ledger.start(first, find_terms(first), {});
  ledger.add(last, find_terms(last), {});
  const EnergyRecord record = ledger.find_record();
  const double rise = sum_kinetic(last) - sum_kinetic(first);
  const double given = 0.05 * (find_power(first) + find_power(last));
  ASSERT_GT(std::abs(given), 0.01 * rise);
  EXPECT_NEAR(record.drift.value, rise, kRoundoff * rise);
  EXPECT_EQ(record.drift.time, 2.1);
  EXPECT_EQ(record.place, "body 'cloud'");
  EXPECT_NEAR(record.share, rise - given, kRoundoff * rise);
}

TEST_F(CloudLedger, BeginsAStepWithTheForcesAfterAJump) {
  const SystemState first = make_moving(2.0, 1.0);
  const SystemState jumped = make_moving(2.05, 2.0);
  const SystemState last = make_moving(2.1, 1.5);
  EnergyLedger ledger(model_);
  ledger.start(first, find_terms(first), {});
  ledger.restart(jumped, find_terms(jumped));
  ledger.add(last, find_terms(last), make_totals(-100.0, 0.0));
  const double rise = sum_kinetic(last) - sum_kinetic(jumped);
  const double given = 0.025 * (find_power(jumped) + find_power(last));
  ASSERT_LT(rise, 0.0);
  // The drift has the other sign, so that this is no share of it.
  EXPECT_EQ(ledger.find_record().share, 0.0);
  ledger.add(last, find_terms(last), make_totals(200.0, 0.0));
  EXPECT_NEAR(ledger.find_record().share, rise - given,
              kRoundoff * std::abs(rise));
}

// Work less losses, of an impulse before the start and since.
TEST_F(CloudLedger, ExplainsEnergyByWorkAndLosses) {
  const SystemState first = make_moving(0.0, 1.0);
  const SystemState last = make_moving(0.1, 1.5);
  EnergyLedger ledger(model_);
  ledger.start(first, find_terms(first), make_totals(7.0, 2.0));
  const double rise = sum_kinetic(last) - sum_kinetic(first);
  ledger.add(last, find_terms(last), make_totals(7.0 + rise + 4.0, 2.0 + 4.0));
  EXPECT_NEAR(ledger.find_record().drift.value, 0.0, kRoundoff * rise);
  ledger.add(last, find_terms(last), make_totals(7.0 + rise + 4.0, 1002.0));
  EXPECT_NEAR(ledger.find_record().drift.value, 996.0, 1e-9);
  EXPECT_EQ(ledger.find_record().throughput, 1002.0);
}

// Approximate terms may not tell an extreme.
TEST_F(CloudLedger, AsksForExactTermsWhereAnExtremeGrows) {
  const SystemState first = make_moving(0.0, 1.0);
  EnergyLedger ledger(model_);
  ledger.start(first, find_terms(first), {});
  const SystemState more = make_moving(0.1, 1.1);
  EXPECT_FALSE(ledger.try_add(more, find_terms(more), {}));
  EXPECT_EQ(ledger.find_record().drift.value, 0.0);
  const double fall = sum_kinetic(first) - sum_kinetic(make_moving(0.1, 0.9));
  const SystemState less = make_moving(0.1, 0.9);
  EXPECT_FALSE(ledger.try_add(less, find_terms(less), {}));  // a new drift
  EXPECT_TRUE(ledger.try_add(less, find_terms(less), make_totals(0.0, fall)));
}

/// Two masses on a spring and a second one by a path between them.
struct SprungMasses {
  SprungMasses() {
    left = add_mass(builder, "left", 1.0);
    right = add_mass(builder, "right", 2.0);
    builder.add_coupler(
        "spring",
        joints::Bushing({.translational_stiffness = 100.0 * Matrix3::Identity(),
                         .translational_damping = 4.0 * Matrix3::Identity()}),
        left.frame, right.frame);
  }
  void add_path(double stiffness, double rest) {
    builder.add_path(
        "line", {left.frame, right.frame},
        {joints::ScalarSpring({.curve = joints::SpringCurve(
                                   {.stiffness = stiffness, .extensions = {}}),
                               .damping = 0.0,
                               .rest = rest})});
  }
  SystemBuilder builder;
  Mass left, right;
};

EnergyRecord record_stretch(const SystemModel& model, double from, double to,
                            double speed) {
  EnergyLedger ledger(model);
  SystemTerms terms = make_terms(model);
  SystemState state = make_state(model);
  state.bodies[1].v_WB_W.x() = speed;
  state.bodies[1].p_WB.x() = from;
  calc_terms(model, state, Side::right, terms);
  ledger.start(state, terms, {});
  state.t = 0.1;
  state.bodies[1].p_WB.x() = to;
  calc_terms(model, state, Side::right, terms);
  ledger.add(state, terms, {});
  return ledger.find_record();
}

TEST(EnergyLedger, NamesACouplerThatGainsWhatNoPowerExplains) {
  SprungMasses masses;
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.0, 0.2, 0.0);
  EXPECT_EQ(record.place, "coupler 'spring'");
  EXPECT_NEAR(record.share, 0.5 * 100.0 * 0.04, kRoundoff);
  EXPECT_NEAR(record.coupler.value, 2.0, kRoundoff);
}

// A force k x - c v on what moves at v gives the spring k x v, in the mean of
// both ends, whatever its damper takes.
TEST(EnergyLedger, GivesACouplerThePowerOfItsSpring) {
  SprungMasses masses;
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.1, 0.5, 1.0);
  const double rise = 0.5 * 100.0 * (0.25 - 0.01);
  const double given = 0.05 * (100.0 * 0.1 + 100.0 * 0.5) * 1.0;
  EXPECT_EQ(record.place, "coupler 'spring'");
  EXPECT_NEAR(record.share, rise - given, 1e-11);
}

TEST(EnergyLedger, NamesATransmissionLikewise) {
  SprungMasses masses;
  masses.add_path(1000.0, 0.1);
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.1, 0.3, 0.5);
  const double rise = 0.5 * 1000.0 * 0.04;
  const double given = 0.05 * (1000.0 * 0.2) * 0.5;
  EXPECT_EQ(record.place, "coupler 'line'");
  EXPECT_NEAR(record.share, rise - given, 1e-10);
}

// A force f at a place L from the origin, whose digits end at eps L.
TEST(EnergyLedger, ExpectsTheRoundOffOfPlacesThatAStiffCouplerSees) {
  SprungMasses masses;
  const SystemModel model = masses.builder.build();
  const auto find_roundoff = [&](double place, double stretch) {
    EnergyLedger ledger(model);
    SystemTerms terms = make_terms(model);
    SystemState state = make_state(model);
    state.bodies[0].p_WB.x() = place - stretch;
    state.bodies[1].p_WB.x() = place;
    calc_terms(model, state, Side::right, terms);
    ledger.start(state, terms, {});
    return ledger.find_record().roundoff;
  };
  constexpr double kEpsilon = 2.2e-16;
  const double one = find_roundoff(3.0, 0.1);
  EXPECT_GE(one, 10.0 * kEpsilon * 3.0);
  EXPECT_LE(one, 1000.0 * kEpsilon * 3.0);
  EXPECT_NEAR(find_roundoff(3.0, 0.2), 2.0 * one, 1e-6 * one);
  EXPECT_NEAR(find_roundoff(6.0, 0.1), 2.0 * one, 1e-6 * one);
}

}  // namespace
}  // namespace limber::dynamics::energy_ledger_test
