// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/energy_observer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/bushing.hpp"
#include "support/point_mass_body.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::energy_observer_test {
namespace {

using testing::add_mass;
using testing::Mass;

constexpr double kRoundoff = 1e-12;

EnergyFlows make_totals(const SystemModel& model, double supplied,
                        double dissipated) {
  EnergyFlows totals = make_flows(model);
  totals.supplied[0] = supplied;
  totals.dissipated[0] = dissipated;
  return totals;
}

EnergyRecord find_record(const SystemModel& model,
                         const EnergyObserver& energy_observer) {
  return energy_observer.find_record(VectorX::Zero(EnergyRows(model).count));
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

  /// The same shape and place at two instants, with other velocities, those of
  /// the centre of mass times `drift`.
  [[nodiscard]] SystemState make_moving(double t, double scale,
                                        double drift = 1.0) const {
    SystemState state = make_state(model_);
    state.t = t;
    state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0.4, -0.2, 0.7)));
    state.bodies[0].v_WB_W = drift * scale * Vector3(0.3, -0.5, 0.2);
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
  [[nodiscard]] Vector3 find_point_velocity(const SystemState& state,
                                            Eigen::Index n) const {
    return find_velocity(state, cloud_.reduced.rows.x_B.col(n),
                         cloud_.reduced.rows.Phi_B.middleRows<3>(3 * n));
  }
  /// Beside a frame that moves with `v`.
  [[nodiscard]] double sum_kinetic(const SystemState& state,
                                   const Vector3& v = Vector3::Zero()) const {
    double sum = 0.0;
    for (Eigen::Index n = 0; n < cloud_.masses.size(); ++n) {
      sum += 0.5 * cloud_.masses[n] *
             (find_point_velocity(state, n) - v).squaredNorm();
    }
    return sum;
  }
  [[nodiscard]] Vector3 find_mean_velocity(const SystemState& state) const {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index n = 0; n < cloud_.masses.size(); ++n) {
      sum += cloud_.masses[n] * find_point_velocity(state, n);
    }
    return sum / cloud_.masses.sum();
  }
  [[nodiscard]] double find_elastic(const SystemState& state) const {
    return 0.5 * cloud_.reduced.lambda.dot(state.eta.cwiseAbs2());
  }
  /// Of the pull, beside a frame that moves with `v`.
  [[nodiscard]] double find_power(const SystemState& state,
                                  const Vector3& v = Vector3::Zero()) const {
    return kForce_W.dot(find_velocity(state, tip_.p_B, tip_.Phi_B) - v);
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
  EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
  energy_observer.start(state, find_terms(state));
  const EnergyRecord record = find_record(model_, energy_observer);
  const double kinetic = sum_kinetic(state);
  const double elastic = find_elastic(state);
  EXPECT_NEAR(record.kinetic.value, kinetic, kRoundoff * kinetic);
  EXPECT_NEAR(record.elastic.value, elastic, kRoundoff * elastic);
  EXPECT_NEAR(record.stored.value, kinetic + elastic, kRoundoff * kinetic);
  EXPECT_EQ(record.coupler.value, 0.0);
  EXPECT_EQ(record.drift.value, 0.0);
}

// A free body is judged beside what moves about its centre of mass.
TEST_F(CloudLedger, HasAThroughputInTheFrameOfItsStart) {
  const SystemState state = make_moving(0.0, 1.0);
  EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
  energy_observer.start(state, find_terms(state));
  const double own = sum_kinetic(state, find_mean_velocity(state));
  ASSERT_LT(own, 0.9 * sum_kinetic(state));
  EXPECT_NEAR(find_record(model_, energy_observer).throughput,
              own + find_elastic(state), kRoundoff);
}

// E_1 - E_0 - work, in the frame of the start, where the pull's work is
// F . (v - V).
TEST_F(CloudLedger, GivesABodyWhatNoWorkExplains) {
  const SystemState first = make_moving(2.0, 1.0);
  const SystemState last = make_moving(2.1, 1.5);
  const Vector3 V = find_mean_velocity(first);
  EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
  energy_observer.start(first, find_terms(first));
  const double work = 0.05 * (find_power(first) + find_power(last));
  energy_observer.add(last, find_terms(last), make_totals(model_, work, 0.25));
  const EnergyDrift drift = find_record(model_, energy_observer).worst;
  const double own_work = 0.05 * (find_power(first, V) + find_power(last, V));
  ASSERT_GT(std::abs(own_work - work), 0.1);
  const double expected =
      sum_kinetic(last, V) - sum_kinetic(first, V) - own_work + 0.25;
  EXPECT_NEAR(drift.drift.value, expected, kRoundoff);
  EXPECT_EQ(drift.drift.time, 2.1);
  EXPECT_EQ(drift.place, "body 'cloud'");
  EXPECT_NEAR(drift.place_error, expected, kRoundoff);
}

// 7500 m/s more at all times: of 4 kg 1.1e8 J, whose digits end at 1e-8 J.
TEST_F(CloudLedger, FindsTheSameInABoostedScene) {
  const auto find = [&](double boost) {
    const auto move = [&](double t, double scale) {
      SystemState state = make_moving(t, scale);
      state.bodies[0].v_WB_W += boost * Vector3(0.6, 0.0, 0.8);
      return state;
    };
    const SystemState first = move(2.0, 1.0);
    const SystemState last = move(2.1, 1.5);
    EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
    energy_observer.start(first, find_terms(first));
    const double work = 0.05 * (find_power(first) + find_power(last));
    energy_observer.add(last, find_terms(last), make_totals(model_, work, 0.0));
    return find_record(model_, energy_observer).worst;
  };
  const EnergyDrift at_rest = find(0.0);
  const EnergyDrift boosted = find(7500.0);
  ASSERT_GT(std::abs(at_rest.drift.value), 0.1);
  EXPECT_NEAR(boosted.drift.value, at_rest.drift.value, 1e-6);
  EXPECT_NEAR(boosted.throughput, at_rest.throughput, 1e-6);
}

// Work less losses.
TEST_F(CloudLedger, ExplainsEnergyByWorkAndLosses) {
  const SystemState first = make_moving(0.0, 1.0, 0.0);
  const SystemState last = make_moving(0.1, 1.5, 0.0);
  EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
  energy_observer.start(first, find_terms(first));
  const double rise = sum_kinetic(last) - sum_kinetic(first);
  energy_observer.add(last, find_terms(last),
                      make_totals(model_, rise + 4.0, 4.0));
  EXPECT_NEAR(find_record(model_, energy_observer).drift.value, 0.0,
              kRoundoff * rise);
  energy_observer.add(last, find_terms(last),
                      make_totals(model_, rise + 4.0, 1000.0));
  const EnergyRecord record = find_record(model_, energy_observer);
  EXPECT_NEAR(record.drift.value, 996.0, 1e-9);
  EXPECT_EQ(record.throughput, 1000.0);
  ASSERT_EQ(record.rows.size(), 1U);
  EXPECT_EQ(record.rows[0].dissipated, 1000.0);
  EXPECT_NEAR(record.rows[0].in - record.rows[0].out, rise + 4.0, 1e-12);
}

// Approximate terms may not tell an extreme of a drift.
TEST_F(CloudLedger, AsksForExactTermsWhereADriftGrows) {
  const SystemState first = make_moving(0.0, 1.0, 0.0);
  for (const double scale : {1.1, 0.9}) {
    EnergyObserver energy_observer(model_, IntegratorKind::generalized_alpha);
    energy_observer.start(first, find_terms(first));
    const SystemState last = make_moving(0.1, scale, 0.0);
    const double rise = sum_kinetic(last) - sum_kinetic(first);
    EXPECT_FALSE(
        energy_observer.try_add(last, find_terms(last), make_flows(model_)));
    EXPECT_EQ(find_record(model_, energy_observer).drift.value, 0.0);
    EXPECT_TRUE(energy_observer.try_add(last, find_terms(last),
                                        make_totals(model_, rise, 0.0)));
  }
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

SystemState stretch(const SystemModel& model, double t, double by,
                    double speed) {
  SystemState state = make_state(model);
  state.t = t;
  state.bodies[1].p_WB.x() = by;
  state.bodies[1].v_WB_W.x() = speed;
  return state;
}

// A step of 0.1 s from one stretch to another, whose losses count.
EnergyRecord record_stretch(const SystemModel& model, double from, double to,
                            double speed) {
  EnergyObserver energy_observer(model, IntegratorKind::generalized_alpha);
  SystemTerms terms = make_terms(model);
  EnergyFlows flows = make_flows(model);
  const SystemState first = stretch(model, 0.0, from, speed);
  calc_terms(model, first, Side::right, terms);
  add_powers(terms, 0.05, flows);
  energy_observer.start(first, terms);
  const SystemState last = stretch(model, 0.1, to, speed);
  calc_terms(model, last, Side::right, terms);
  add_powers(terms, 0.05, flows);
  energy_observer.add(last, terms, flows);
  return find_record(model, energy_observer);
}

EnergyRow find_spring(const EnergyRecord& record) {
  for (const EnergyRow& row : record.rows) {
    if (row.name == "coupler 'spring'") return row;
  }
  ADD_FAILURE() << "no row of the spring";
  return {};
}

TEST(EnergyObserver, NamesACouplerThatGainsWhatNoPowerExplains) {
  SprungMasses masses;
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.0, 0.2, 0.0);
  EXPECT_EQ(record.worst.place, "coupler 'spring'");
  EXPECT_NEAR(record.worst.place_error, 0.5 * 100.0 * 0.04, kRoundoff);
  EXPECT_NEAR(record.coupler.value, 2.0, kRoundoff);
}

// A force k x - c v on what moves at v gives the spring k x v, in the mean of
// both ends, whatever its damper takes.
TEST(EnergyObserver, GivesACouplerThePowerOfItsSpring) {
  SprungMasses masses;
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.1, 0.5, 1.0);
  const double rise = 0.5 * 100.0 * (0.25 - 0.01);
  const double given = 0.05 * (100.0 * 0.1 + 100.0 * 0.5) * 1.0;
  EXPECT_EQ(record.worst.place, "coupler 'spring'");
  EXPECT_NEAR(record.worst.place_error, rise - given, 1e-11);
  const EnergyRow spring = find_spring(record);
  EXPECT_NEAR(spring.in, given + 0.1 * 4.0, 1e-12);
  EXPECT_NEAR(spring.dissipated, 0.1 * 4.0, 1e-12);
  EXPECT_NEAR(spring.stored, 0.5 * 100.0 * 0.25, 1e-12);
}

// By terms that give the spring a tenth too much.
TEST(EnergyObserver, KeepsTheMostStretchedStateUntilExactTermsTellItsEnergy) {
  SprungMasses masses;
  const SystemModel model = masses.builder.build();
  EnergyObserver energy_observer(model, IntegratorKind::generalized_alpha);
  SystemTerms terms = make_terms(model);
  const auto evaluate = [&](const SystemState& state) {
    calc_terms(model, state, Side::right, terms);
  };
  EnergyFlows flows = make_flows(model);
  const auto try_add = [&](const SystemState& state) {
    evaluate(state);
    terms.couplers[0].response.energy *= 1.1;
    flows.supplied[2] = terms.couplers[0].response.energy;
    return energy_observer.try_add(state, terms, flows);
  };
  evaluate(stretch(model, 0.0, 0.0, 0.0));
  energy_observer.start(stretch(model, 0.0, 0.0, 0.0), terms);
  EXPECT_EQ(energy_observer.peak(), nullptr);
  for (const double by : {0.1, 0.2, 0.3}) {
    ASSERT_TRUE(try_add(stretch(model, by, by, 0.0)));
    EXPECT_FALSE(energy_observer.has_passed_peak(terms));
    EXPECT_EQ(find_record(model, energy_observer).coupler.value, 0.0);
  }
  ASSERT_TRUE(try_add(stretch(model, 0.4, 0.25, 0.0)));
  EXPECT_TRUE(energy_observer.has_passed_peak(terms));
  const SystemState* peak = energy_observer.peak();
  ASSERT_NE(peak, nullptr);
  EXPECT_EQ(peak->t, 0.3);
  evaluate(*peak);
  energy_observer.include_peak(terms);
  EXPECT_EQ(energy_observer.peak(), nullptr);
  const Extreme most = find_record(model, energy_observer).coupler;
  EXPECT_NEAR(most.value, 0.5 * 100.0 * 0.09, kRoundoff);
  EXPECT_EQ(most.time, 0.3);
}

// What rows exchange cancels: drift = change of all stored energy + losses.
TEST(EnergyObserver, HasADriftThatIsTheSumOfTheRows) {
  SprungMasses masses;
  masses.add_path(1000.0, 0.1);
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.1, 0.5, 1.0);
  double sum = 0.0;
  for (const EnergyRow& row : record.rows) sum += row.error;
  const double rise = 0.5 * 100.0 * 0.24 + 0.5 * 1000.0 * 0.16;
  EXPECT_NEAR(record.drift.value, rise + 0.1 * 4.0, 1e-10);
  EXPECT_NEAR(sum, record.drift.value, 1e-10);
}

// Newton's last correction changes velocities after its terms: by the same
// amount every step, if an acceleration is constant.
TEST(EnergyObserver, HasTheSumOfTheRowsBeforeTheLastCorrectionToo) {
  SprungMasses masses;
  masses.add_path(1000.0, 0.1);
  const SystemModel model = masses.builder.build();
  EnergyObserver energy_observer(model, IntegratorKind::generalized_alpha);
  SystemTerms terms = make_terms(model);
  SystemState state = stretch(model, 0.0, 0.1, 1.0);
  calc_terms(model, state, Side::right, terms);
  energy_observer.start(state, terms);
  const double mean = 2.0 / 3.0;  // velocity at the start
  const double fall =
      0.5 * 2.0 * (std::pow(0.9 - mean, 2) - std::pow(1.0 - mean, 2));
  for (int i = 1; i <= 10; ++i) {
    state = stretch(model, 0.1 * i, 0.5, 1.0);
    calc_terms(model, state, Side::right, terms);
    state.bodies[1].v_WB_W.x() = 0.9;
    energy_observer.add(state, terms, make_flows(model));
    const double rise = 0.5 * 100.0 * 0.24 + 0.5 * 1000.0 * 0.16;
    EXPECT_NEAR(find_record(model, energy_observer).drift.value, rise + fall,
                1e-9);
  }
}

TEST(EnergyObserver, BeginsAStepWithTheForcesAfterAJump) {
  SprungMasses masses;
  const SystemModel model = masses.builder.build();
  EnergyObserver energy_observer(model, IntegratorKind::generalized_alpha);
  SystemTerms terms = make_terms(model);
  const SystemState first = stretch(model, 0.0, 0.1, 0.0);
  calc_terms(model, first, Side::right, terms);
  energy_observer.start(first, terms);
  const SystemState jumped = stretch(model, 0.0, 0.3, 2.0);
  calc_terms(model, jumped, Side::right, terms);
  energy_observer.restart(jumped, terms);
  const SystemState last = stretch(model, 0.1, 0.4, 1.0);
  calc_terms(model, last, Side::right, terms);
  energy_observer.add(last, terms, make_flows(model));
  // k x v + c v^2 at both ends
  const double given =
      0.05 * (100.0 * 0.3 * 2.0 + 4.0 * 4.0 + 100.0 * 0.4 + 4.0);
  const double rise = 0.5 * 100.0 * (0.16 - 0.01);
  const EnergyRow spring = find_spring(find_record(model, energy_observer));
  EXPECT_NEAR(spring.error, rise - given, 1e-11);
}

TEST(EnergyObserver, NamesATransmissionLikewise) {
  SprungMasses masses;
  masses.add_path(1000.0, 0.1);
  const EnergyRecord record =
      record_stretch(masses.builder.build(), 0.1, 0.3, 0.5);
  const double rise = 0.5 * 1000.0 * 0.04;
  const double given = 0.05 * (1000.0 * 0.2) * 0.5;
  EXPECT_EQ(record.worst.place, "coupler 'line'");
  EXPECT_NEAR(record.worst.place_error, rise - given, 1e-10);
}

TEST(EnergyObserver, ExpectsTheRoundOffOfPlacesThatAStiffCouplerSees) {
  SprungMasses masses;
  const SystemModel model = masses.builder.build();
  const auto find_roundoff = [&](double place, double stretch) {
    EnergyObserver energy_observer(model, IntegratorKind::generalized_alpha);
    SystemTerms terms = make_terms(model);
    SystemState state = make_state(model);
    state.bodies[0].p_WB.x() = place - stretch;
    state.bodies[1].p_WB.x() = place;
    calc_terms(model, state, Side::right, terms);
    energy_observer.start(state, terms);
    return find_record(model, energy_observer).roundoff;
  };
  constexpr double kEpsilon = 2.2e-16;
  const double one = find_roundoff(3.0, 0.1);
  EXPECT_GE(one, 10.0 * kEpsilon * 3.0);
  EXPECT_LE(one, 1000.0 * kEpsilon * 3.0);
  EXPECT_NEAR(find_roundoff(3.0, 0.2), 2.0 * one, 1e-6 * one);
  EXPECT_NEAR(find_roundoff(6.0, 0.1), 2.0 * one, 1e-6 * one);
}

}  // namespace
}  // namespace limber::dynamics::energy_observer_test
