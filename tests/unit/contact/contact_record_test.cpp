// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limber/contact/make_contact.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "unit/contact/ball_on_floor.hpp"

/// What a run records of an impact, against Hertz's theory (Johnson 1985,
/// sec. 11.4).
namespace limber::contact::contact_record_test {
namespace {

class ContactRecordFrom : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Time, ContactRecordFrom,
                         ::testing::Values(0.0, 1000.0));

TEST_P(ContactRecordFrom, ABallOnAFloorIsHertzs) {
  constexpr double kSpeed = 1.0;
  const double start = GetParam();
  test::BallOnFloor scene({}, {0.0, 0.0, -kSpeed});
  scene.state.t = start;
  dynamics::SimulationSettings settings;
  settings.end_time = start + 2e-4;
  settings.step = 1e-7;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics, {},
                     {}, record);
  ASSERT_FALSE(statistics.events.empty());
  EXPECT_NEAR(statistics.events[0].time - start, 1e-6 / kSpeed, 1e-9);
  const double k = test::hertz_stiffness();
  const double depth =
      std::pow(1.25 * test::kBallMass * kSpeed * kSpeed / k, 0.4);
  const double force = k * std::pow(depth, 1.5);
  const double duration = 2.9432 * depth / kSpeed;
  ASSERT_EQ(record.contacts.size(), 1U);
  const dynamics::ContactRecord& contact = record.contacts[0];
  constexpr double kSame = 2e-3;
  EXPECT_EQ(contact.pair, "floor/ball");
  EXPECT_TRUE(contact.has_parted);
  EXPECT_NEAR(contact.time - start, 1e-6 / kSpeed, 2e-7);
  EXPECT_NEAR(contact.duration / duration, 1.0, 0.01);
  EXPECT_NEAR(contact.peak_force / force, 1.0, kSame);
  EXPECT_NEAR(contact.peak_time - start, 1e-6 / kSpeed + 0.5 * duration,
              0.01 * duration);
  EXPECT_NEAR(contact.peak_depth / depth, 1.0, kSame);
  EXPECT_NEAR(contact.peak_depth_over_radius / (depth / test::kBallRadius), 1.0,
              kSame);
  EXPECT_NEAR(contact.impulse / (2.0 * test::kBallMass * kSpeed), 1.0, kSame);
  EXPECT_NEAR(contact.parting_speed / kSpeed, 1.0, kSame);
  const double energy = 0.5 * test::kBallMass * kSpeed * kSpeed;
  EXPECT_NEAR(contact.energy.in / energy, 1.0, kSame);
  EXPECT_NEAR(contact.energy.returned / energy, 1.0, kSame);
  EXPECT_LT(std::abs(contact.energy.stored), 1e-12 * energy);
  EXPECT_EQ(contact.energy.damped, 0.0);
  EXPECT_LT(std::abs(contact.energy.error), kSame * energy);
}

// A ball that strikes another, beside others and at speed.
struct Company {
  double flying = 0.0;     // with the frame of both bodies [m/s]
  bool has_other = false;  // a body that falls, 50 m away
  double impact_steps = 20.0;
  double modulus = 1e7;  // [Pa]
  contact::ContactParameters parameters = {};
  Vector3 velocity = -Vector3::UnitZ();
};

// A ball against a heavy one, both free; far from the ground.
dynamics::RunRecord strike(const Company& company,
                           dynamics::IntegratorKind integrator,
                           std::vector<std::string>* warnings = nullptr) {
  constexpr double kRadius = 0.02;
  constexpr double kMass = 0.05;
  dynamics::SystemBuilder builder;
  const auto add = [&](const char* name, double mass) {
    return builder.add_rigid_body(
        name, {mass, 0.4 * mass * kRadius * kRadius * Matrix3::Identity()});
  };
  const auto side = [&](double mass) {
    return ContactSide{Shape{Sphere{kRadius}, {}},
                       SurfaceMaterial{company.modulus, 0.3}, mass,
                       0.4 * mass * kRadius * kRadius * Matrix3::Identity()};
  };
  const auto ball = add("ball", kMass);
  const auto target = add("target", kMass);
  builder.add_pair("target/ball", target, ball,
                   make_contact(side(kMass), side(kMass), company.parameters));
  if (company.has_other) add("other", 1e4);
  const dynamics::SystemModel model = builder.build();
  dynamics::SystemState state = dynamics::make_state(model);
  const Vector3 v = company.flying * Vector3(0.6, 0.8, 0.0);
  state.bodies[0].p_WB = {-1e-3 * company.velocity.x(), 0.0,
                          2.0 * kRadius + 1e-3};
  state.bodies[0].v_WB_W = v + company.velocity;
  state.bodies[1].v_WB_W = v;
  if (company.has_other) {
    state.bodies[2].p_WB = {50.0, 0.0, 0.0};
    state.bodies[2].v_WB_W = v + Vector3(0.0, 30.0, 0.0);
    state.bodies[2].w_WB_B = Vector3(1.0, 2.0, 3.0);
  }
  dynamics::SimulationSettings settings;
  settings.end_time = 0.01;
  settings.step = 5e-4;
  settings.integrator = integrator;
  settings.impact_steps = company.impact_steps;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  dynamics::simulate(model, state, settings, {}, {}, statistics, {}, {},
                     record);
  if (warnings != nullptr) *warnings = statistics.warnings;
  return record;
}

class EnergyOfAnImpact
    : public ::testing::TestWithParam<dynamics::IntegratorKind> {};
INSTANTIATE_TEST_SUITE_P(
    By, EnergyOfAnImpact,
    ::testing::Values(dynamics::IntegratorKind::generalized_alpha,
                      dynamics::IntegratorKind::energy_conserving));

// e^2 of the energy about the common centre of mass is returned.
TEST_P(EnergyOfAnImpact, IsReturnedByTheSquareOfRestitution) {
  constexpr double kEnergy = 0.25 * 0.05;  // m v^2 / 4 of two equal balls
  for (const double e : {1.0, 0.8, 0.3}) {
    Company company;
    company.parameters.restitution = e;
    const auto record = strike(company, GetParam());
    ASSERT_EQ(record.contacts.size(), 1U);
    const dynamics::ImpactEnergy& energy = record.contacts[0].energy;
    constexpr double kSame = 1e-2;
    EXPECT_NEAR(energy.in / kEnergy, 1.0, kSame);
    EXPECT_NEAR(energy.returned / kEnergy, e * e, kSame);
    EXPECT_NEAR(energy.damped / kEnergy, 1.0 - e * e, kSame);
    EXPECT_EQ(energy.rubbed, 0.0);
    EXPECT_NEAR(energy.in,
                energy.returned + energy.stored + energy.damped - energy.error,
                1e-14);
  }
}

// A ball that slides in all of an impact on an equal one loses by friction
// mu J (u - mu J c / 2), c the rate at which both contact points' slip falls
// with impulse: 2 (1 + 5/2) / m.
TEST_P(EnergyOfAnImpact, OfSlidingIsLostByCoulombFriction) {
  Company company;
  constexpr double mu = 0.05;
  constexpr double kSlip = 1.0;  // at the touch [m/s]
  company.parameters.friction.sliding = mu;
  company.velocity = {kSlip, 0.0, -1.0};
  company.modulus = 1e11;  // so that the normal hardly turns
  const auto record = strike(company, GetParam());
  ASSERT_EQ(record.contacts.size(), 1U);
  const dynamics::ContactRecord& contact = record.contacts[0];
  const double J = contact.impulse;
  const double c = 7.0 / 0.05;
  const double lost = mu * J * (kSlip - 0.5 * mu * J * c);
  EXPECT_NEAR(contact.energy.rubbed / lost, 1.0, 0.01);
  EXPECT_LT(std::abs(contact.energy.damped), 1e-12);
}

TEST_P(EnergyOfAnImpact, KnowsNeitherCompanyNorACommonVelocity) {
  Company company;
  company.parameters.restitution = 0.7;
  company.parameters.friction.sliding = 0.2;
  company.velocity = {0.3, 0.0, -1.0};
  const auto alone = strike(company, GetParam());
  company.flying = 500.0;
  const auto boosted = strike(company, GetParam());
  company.flying = 0.0;
  company.has_other = true;
  const auto beside = strike(company, GetParam());
  const dynamics::ImpactEnergy& expected = alone.contacts.at(0).energy;
  for (const dynamics::RunRecord* record : {&boosted, &beside}) {
    ASSERT_EQ(record->contacts.size(), 1U);
    const dynamics::ContactRecord& contact = record->contacts[0];
    const dynamics::ImpactEnergy& energy = contact.energy;
    // Places after 5 m at 500 m/s end at 1e-15 m, depths are 1e-4 m.
    const double same = 1e-7 * expected.in;
    EXPECT_NEAR(energy.in, expected.in, same);
    EXPECT_NEAR(energy.returned, expected.returned, same);
    EXPECT_NEAR(energy.damped, expected.damped, same);
    EXPECT_NEAR(energy.rubbed, expected.rubbed, same);
    EXPECT_NEAR(energy.error, expected.error, same);
    EXPECT_NEAR(*contact.restitution(), *alone.contacts[0].restitution(), 1e-6);
  }
}

// Two steps an impact lose or gain what nobody else can hide.
TEST(ContactRecord, WarnsOfAnImpactThatItsStepsDoNotResolveWhateverElseMoves) {
  for (const bool has_other : {false, true}) {
    for (const double flying : {0.0, 500.0}) {
      Company company{.flying = flying, .has_other = has_other};
      company.impact_steps = 2.0;
      company.parameters.restitution = 0.5;
      std::vector<std::string> warnings;
      const auto record = strike(
          company, dynamics::IntegratorKind::central_differences, &warnings);
      ASSERT_EQ(record.contacts.size(), 1U);
      EXPECT_GT(record.contacts[0].energy.unbalanced_fraction(), 0.01);
      EXPECT_EQ(std::count_if(warnings.begin(), warnings.end(),
                              [](const std::string& text) {
                                return text.find("restitution is not met") !=
                                       std::string::npos;
                              }),
                1);
      company.impact_steps = 20.0;
      (void)strike(company, dynamics::IntegratorKind::energy_conserving,
                   &warnings);
      for (const std::string& text : warnings) {
        EXPECT_EQ(text.find("restitution is not met"), std::string::npos)
            << text;
      }
    }
  }
}

// A ball in the floor at the start, pushed out by it, did not strike it; nor
// did one that is put down at 1e-12 m/s.
TEST(ContactRecord, HasNoRestitutionOfARest) {
  for (const double speed : {-1e-12, 0.0, 1e-12}) {
    test::BallOnFloor scene({}, {0.0, 0.0, speed});
    scene.state.bodies[0].p_WB.z() = test::kBallRadius - 1e-8;
    dynamics::SimulationSettings settings;
    settings.end_time = 1e-3;
    settings.step = 1e-6;
    dynamics::SimulationStatistics statistics;
    dynamics::RunRecord record;
    dynamics::simulate(scene.model, scene.state, settings, {}, {}, statistics,
                       {}, {}, record);
    ASSERT_EQ(record.contacts.size(), 1U);
    EXPECT_TRUE(record.contacts[0].has_parted);
    EXPECT_FALSE(record.contacts[0].restitution().has_value());
    const double k = test::hertz_stiffness();
    const double stored = 0.4 * k * std::pow(1e-8, 2.5);
    EXPECT_NEAR(record.contacts[0].energy.returned / stored, 1.0, 1e-2);
    EXPECT_NEAR(record.contacts[0].energy.stored / stored, -1.0, 1e-9);
  }
}

TEST(ContactRecord, HasARestitutionWhereRigidMotionsDescribeTheImpact) {
  dynamics::ContactRecord record;
  record.has_parted = true;
  record.rest_speed = 1e-3;
  record.touch_speed = record.approach_speed = 0.1;
  const auto find_e = [&](double parting_speed) {
    record.parting_speed = parting_speed;
    return record.restitution();
  };
  EXPECT_EQ(find_e(0.0), 0.0);
  EXPECT_EQ(find_e(0.05), 0.5);
  EXPECT_EQ(find_e(0.1), 1.0);
  EXPECT_FALSE(find_e(2.8));    // a finger's vibration threw it off
  EXPECT_FALSE(find_e(-0.02));  // and held it back
  record.touch_speed = 5e-4;
  EXPECT_FALSE(find_e(5e-4));  // at rest
}

}  // namespace
}  // namespace limber::contact::contact_record_test
