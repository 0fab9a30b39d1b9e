// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/sampled_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/control/pid_controller.hpp"

namespace limber::dynamics::sampled_loop_test {
namespace {

using Pole = std::complex<double>;

/// A mass with a damper and a spring; inputs are forces, outputs its place and
/// its velocity.
LinearModel make_mass(double mass, double damping, double stiffness,
                      int inputs = 1) {
  LinearModel model;
  model.A = MatrixX::Zero(2, 2);
  model.A << 0.0, 1.0, -stiffness / mass, -damping / mass;
  model.B = MatrixX::Zero(2, inputs);
  model.B.row(1).setConstant(1.0 / mass);
  model.C = MatrixX::Identity(2, 2);
  model.D = MatrixX::Zero(2, inputs);
  model.states = {{"q", "m"}, {"v", "m/s"}};
  model.outputs = {{"q", "m"}, {"v", "m/s"}};
  for (int i = 0; i < inputs; ++i) model.inputs.push_back({"f", "N"});
  return model;
}

LoopController make_pid(PidParameters parameters, Eigen::Index input = 0,
                        double offset = 0.0, InputHold hold = InputHold::held) {
  LoopController controller{"pid",  parameters.period,
                            offset, PidController(parameters).linearise(),
                            {0},    {{input, -1, hold}}};
  if (parameters.has_rate) controller.measures.push_back(1);
  return controller;
}

/// The poles that are not zero, the largest first. Zeros of a delay are a
/// multiple eigenvalue: round-off to the power of one over its number.
std::vector<Pole> find_poles(const LinearModel& plant,
                             const std::vector<LoopController>& controllers) {
  SampledLoop loop(plant, controllers);
  const Eigen::VectorXcd all =
      dense::find_general_eigenpairs(loop.find_model().A, false).values;
  std::vector<Pole> poles;
  for (const Pole& pole : all) {
    if (std::abs(pole) > 0.01) poles.push_back(pole);
  }
  std::sort(poles.begin(), poles.end(), [](const Pole& a, const Pole& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-9 ? difference > 0.0 : a.imag() > b.imag();
  });
  return poles;
}

void expect_poles(const std::vector<Pole>& found,
                  const std::vector<Pole>& expected) {
  ASSERT_EQ(found.size(), expected.size()) << ::testing::PrintToString(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(std::abs(found[i] - expected[i]), 0.0, 1e-9) << i;
  }
}

// The expected poles of the next three tests are those of scipy 1.10.1: the
// laws as difference equations, the mass by scipy.linalg.expm of its matrix
// joined with that of the hold, numpy.linalg.eigvals of one period.

TEST(SampledLoop, WithDelayAndFilterHasThePolesOfScipy) {
  expect_poles(
      find_poles(make_mass(2.0, 0.5, 30.0), {make_pid({.proportional = 80.0,
                                                       .integral = 40.0,
                                                       .derivative = 12.0,
                                                       .filter_time = 0.01,
                                                       .delay = 3,
                                                       .period = 0.02})}),
      {{0.992416189719905, 0.0},
       {0.95898967022133, 0.179149711481676},
       {0.95898967022133, -0.179149711481676},
       {0.705030028495537, 0.0},
       {-0.0619397578802018, 0.455550230668002},
       {-0.0619397578802018, -0.455550230668002},
       {-0.367180313524387, 0.0}});
}

TEST(SampledLoop, WithALinearHoldHasThePolesOfScipy) {
  expect_poles(find_poles(make_mass(1.0, 0.1, 50.0),
                          {make_pid({.proportional = 30.0,
                                     .integral = 10.0,
                                     .derivative = 3.0,
                                     .filter_time = 0.02,
                                     .delay = 1,
                                     .has_rate = true,
                                     .period = 0.02},
                                    0, 0.0, InputHold::linear)}),
               {{0.997484312153294, 0.0},
                {0.969949930631826, 0.184571363599623},
                {0.969949930631826, -0.184571363599623},
                {0.448968198994676, 0.0},
                {0.367879441171443, 0.0},
                {-0.0404176680716155, 0.0}});
}

// Of 40 ms, and of 60 ms from 20 ms on with a delay.
TEST(SampledLoop, OfTwoPeriodsHasThePolesOfScipy) {
  const LinearModel plant = make_mass(2.0, 0.3, 20.0, 2);
  const LoopController a = make_pid({.proportional = 30.0,
                                     .derivative = 4.0,
                                     .has_rate = true,
                                     .period = 0.04});
  const LoopController b = make_pid(
      {.proportional = 5.0, .integral = 60.0, .delay = 1, .period = 0.06}, 1,
      0.02);
  EXPECT_NEAR(SampledLoop(plant, {a, b}).period(), 0.12, 1e-12);
  // The first law has an integral without gain, which stays.
  expect_poles(find_poles(plant, {a, b}),
               {{1.0, 0.0},
                {0.794999962108368, 0.553634237557536},
                {0.794999962108368, -0.553634237557536},
                {0.866294915413253, 0.0}});
}

// Of a free mass with a measured rate, by Jury's criterion: stable if and only
// if T < 2 m / kd and T < 2 kd / kp.
TEST(SampledLoop, IsUnstableBeyondTheClosedFormsPeriod) {
  for (const double mass : {1.0, 1e3, 1e-3}) {
    const LinearModel plant = make_mass(mass, 0.0, 0.0);
    for (const double kp : {50.0, 200.0}) {
      const double kd = 10.0;
      const double limit = std::min(2.0 / kd, 2.0 * kd / kp);
      for (const double fraction : {0.5, 0.999, 1.001, 1.5}) {
        SampledLoop loop(plant, {make_pid({.proportional = mass * kp,
                                           .derivative = mass * kd,
                                           .has_rate = true,
                                           .period = fraction * limit})});
        EXPECT_EQ(loop.find_instability().has_value(), fraction > 1.0)
            << mass << ' ' << kp << ' ' << fraction;
      }
    }
  }
}

// numpy: -3.10097050800552 at T = 0.25 s.
TEST(SampledLoop, NamesFrequencyAndGrowthOfTheWorstPole) {
  const LinearModel plant = make_mass(1.0, 0.0, 0.0, 2);
  const LoopController calm =
      make_pid({.proportional = 1e-3, .period = 0.25}, 1);
  const LoopController wild = make_pid({.proportional = 100.0,
                                        .derivative = 10.0,
                                        .has_rate = true,
                                        .period = 0.25});
  SampledLoop alone(plant, {wild});
  const auto found = alone.find_instability();
  ASSERT_TRUE(found);
  EXPECT_NEAR(std::abs(found->pole - Pole(-3.10097050800552, 0.0)), 0.0, 1e-9);
  EXPECT_NEAR(found->frequency, 2.0, 1e-9);
  EXPECT_NEAR(found->growth, std::log(3.10097050800552) / 0.25, 1e-8);
  // Whatever the order.
  const auto second = SampledLoop(plant, {calm, wild}).find_instability();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->loops, std::vector<std::size_t>{1});
  const auto first = SampledLoop(plant, {wild, calm}).find_instability();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->loops, std::vector<std::size_t>{0});
}

TEST(SampledLoop, OfAFreeMassAndAWeakLoopIsNotUnstableByRoundOff) {
  LinearModel plant = make_mass(1e4, 0.0, 0.0);
  EXPECT_FALSE(
      SampledLoop(
          plant,
          {make_pid({.derivative = 1e-6, .has_rate = true, .period = 1e-3})})
          .find_instability());
}

// A constant force moves the mass by f / (k + kp), and a reference by r kp /
// (k + kp).
// Of a free mass, r' = -kp q the outer law's output, which the inner law, u =
// kv (r - v), sees at its next sample.
TEST(SampledLoop, OfACascadeHasThePolesOfItsDifferenceEquation) {
  const double mass = 2.0;
  const double kp = 3.0;
  const double kv = 12.0;
  const double T = 0.05;
  const LinearModel plant = make_mass(mass, 0.0, 0.0, 2);
  LinearModel with_reference = plant;
  with_reference.B.col(1).setZero();  // a number that the inner law follows
  const LoopController outer = make_pid({.proportional = kp, .period = T}, 1);
  LoopController inner = make_pid({.proportional = kv, .period = T});
  inner.measures = {1};
  inner.reference = {1, 0.5};
  Matrix3 A;
  A << 1.0, T - T * T * kv / (2.0 * mass), 0.5 * T * T * kv / (2.0 * mass),  //
      0.0, 1.0 - T * kv / mass, 0.5 * T * kv / mass,                         //
      -kp, 0.0, 0.0;
  int found = 0;
  for (const Pole& pole : find_poles(with_reference, {outer, inner})) {
    if (std::abs(pole - 1.0) < 1e-9) continue;  // integrals without gain
    ++found;
    const Eigen::Matrix3cd shifted =
        A.cast<Pole>() - pole * Eigen::Matrix3cd::Identity();
    EXPECT_NEAR(std::abs(shifted.determinant()), 0.0, 1e-9) << pole;
  }
  EXPECT_EQ(found, 3);
}

// An inverted pendulum, q'' = 9 q + u: a weak law does not hold it, and no law
// of another mass has to do with it.
TEST(SampledLoop, IsNotUnstableByWhatItsControllersDoNotMove) {
  LinearModel plant;
  plant.A = MatrixX::Zero(4, 4);
  plant.A(0, 1) = plant.A(2, 3) = 1.0;
  plant.A(1, 0) = 9.0;
  plant.B = MatrixX::Zero(4, 2);
  plant.B(1, 0) = plant.B(3, 1) = 1.0;
  plant.C = MatrixX::Identity(4, 4);
  plant.D = MatrixX::Zero(4, 2);
  plant.states.resize(4);
  plant.outputs.resize(4);
  plant.inputs.resize(2);
  LoopController other = make_pid({.proportional = 10.0,
                                   .derivative = 5.0,
                                   .has_rate = true,
                                   .period = 0.02},
                                  1);
  other.measures = {2, 3};
  EXPECT_FALSE(SampledLoop(plant, {other}).find_instability());
  const LoopController weak = make_pid({.proportional = 8.0, .period = 0.02});
  const auto found = SampledLoop(plant, {other, weak}).find_instability();
  ASSERT_TRUE(found);
  EXPECT_EQ(found->loops, std::vector<std::size_t>{1});
  EXPECT_EQ(found->frequency, 0.0);
}

TEST(SampledLoop, SettlesWhereForcesBalance) {
  const LinearModel plant = make_mass(1.0, 5.0, 20.0, 2);
  SampledLoop loop(plant, {make_pid({.proportional = 30.0, .period = 0.02})});
  const LinearModel model = loop.find_model();
  ASSERT_EQ(model.inputs.size(), 2U);
  EXPECT_EQ(model.inputs[1].name, "pid.reference");
  // The integral's state has no gain, and no part in it.
  VectorX x = VectorX::Zero(model.A.rows());
  for (int k = 0; k < 5000; ++k) x = model.A * x + model.B.col(0);
  EXPECT_NEAR((model.C * x)[0], 1.0 / 50.0, 1e-12);
  x.setZero();
  for (int k = 0; k < 5000; ++k) x = model.A * x + model.B.col(1);
  EXPECT_NEAR((model.C * x)[0], 30.0 / 50.0, 1e-12);
}

TEST(SampledLoop, RefusesPeriodsWithoutACommonMultiple) {
  const LinearModel plant = make_mass(1.0, 0.0, 0.0, 2);
  EXPECT_THROW(
      SampledLoop(
          plant,
          {make_pid({.proportional = 1.0, .period = 1.0}),
           make_pid({.proportional = 1.0, .period = std::numbers::sqrt2}, 1)}),
      InputError);
}

}  // namespace
}  // namespace limber::dynamics::sampled_loop_test
