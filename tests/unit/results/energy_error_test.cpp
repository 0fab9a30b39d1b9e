// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/energy_error.hpp"

#include <gtest/gtest.h>

namespace limber::results::energy_error_test {
namespace {

dynamics::EnergyBalance balance(double kinetic, double elastic, double work,
                                double dissipated) {
  dynamics::EnergyBalance energy;
  energy.kinetic_rigid = kinetic;
  energy.elastic = elastic;
  energy.work = work;
  energy.dissipated = dissipated;
  return energy;
}

// 5 J of work, 1 J dissipated, 4.2 J left: 0.2 J too much.
TEST(EnergyError, DriftIsRelativeToTheLargestOfWhatPassed) {
  History history;
  history.energies = {balance(0, 0, 0, 0), balance(4.2, 0, 5, 1)};
  const EnergyError energy = find_energy_error(history);
  EXPECT_EQ(energy.initial, 0.0);
  EXPECT_EQ(energy.final, 4.2);
  EXPECT_EQ(energy.work, 5.0);
  EXPECT_EQ(energy.dissipated, 1.0);
  EXPECT_NEAR(energy.drift, 0.2, 1e-15);
  EXPECT_EQ(energy.throughput, 5.0);
  EXPECT_NEAR(*energy.relative(), 0.2 / 5.0, 1e-15);
}

// At rest at both ends, 3 J of motion between them: those passed.
TEST(EnergyError, MotionThatCameAndWentCountsAsThroughput) {
  History history;
  history.energies = {balance(0, 0, 0, 0), balance(3, 0, 2.7, 0),
                      balance(0, 0, 0, 0)};
  const EnergyError energy = find_energy_error(history);
  EXPECT_EQ(energy.drift, 0.0);
  EXPECT_NEAR(energy.largest, 0.3, 1e-15);
  EXPECT_EQ(energy.throughput, 3.0);
  EXPECT_NEAR(*energy.relative_largest(), 0.1, 1e-15);
}

TEST(EnergyError, CountsFromTheFirstOutput) {
  History history;
  history.energies = {balance(1, 2, 7, 4), balance(0, 2, 8, 6)};
  const EnergyError energy = find_energy_error(history);
  EXPECT_EQ(energy.initial, 3.0);
  EXPECT_EQ(energy.work, 1.0);
  EXPECT_EQ(energy.dissipated, 2.0);
  EXPECT_EQ(energy.drift, 0.0);
}

TEST(EnergyError, WhereNothingPassedNothingIsRelative) {
  History history;
  EXPECT_EQ(find_energy_error(history).relative(), std::nullopt);
  history.energies = {balance(0, 0, 0, 0), balance(0, 0, 0, 0)};
  EXPECT_EQ(find_energy_error(history).relative(), std::nullopt);
  EXPECT_EQ(find_energy_error(history).relative_largest(), std::nullopt);
}

}  // namespace
}  // namespace limber::results::energy_error_test
