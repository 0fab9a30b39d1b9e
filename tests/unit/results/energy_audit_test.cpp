// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/energy_audit.hpp"

#include <gtest/gtest.h>

namespace limber::results::energy_audit_test {
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
TEST(EnergyAudit, DriftIsRelativeToTheLargestOfWhatPassed) {
  History history;
  history.energies = {balance(0, 0, 0, 0), balance(4.2, 0, 5, 1)};
  const EnergyAudit audit = audit_energy(history);
  EXPECT_EQ(audit.initial, 0.0);
  EXPECT_EQ(audit.final, 4.2);
  EXPECT_EQ(audit.work, 5.0);
  EXPECT_EQ(audit.dissipated, 1.0);
  EXPECT_NEAR(audit.drift, 0.2, 1e-15);
  EXPECT_EQ(audit.throughput, 5.0);
  EXPECT_NEAR(*audit.relative(), 0.2 / 5.0, 1e-15);
}

// At rest at both ends, 3 J of motion between them: those passed.
TEST(EnergyAudit, MotionThatCameAndWentCountsAsThroughput) {
  History history;
  history.energies = {balance(0, 0, 0, 0), balance(3, 0, 2.7, 0),
                      balance(0, 0, 0, 0)};
  const EnergyAudit audit = audit_energy(history);
  EXPECT_EQ(audit.drift, 0.0);
  EXPECT_NEAR(audit.largest, 0.3, 1e-15);
  EXPECT_EQ(audit.throughput, 3.0);
  EXPECT_NEAR(*audit.relative_largest(), 0.1, 1e-15);
}

TEST(EnergyAudit, CountsFromTheFirstOutput) {
  History history;
  history.energies = {balance(1, 2, 7, 4), balance(0, 2, 8, 6)};
  const EnergyAudit audit = audit_energy(history);
  EXPECT_EQ(audit.initial, 3.0);
  EXPECT_EQ(audit.work, 1.0);
  EXPECT_EQ(audit.dissipated, 2.0);
  EXPECT_EQ(audit.drift, 0.0);
}

TEST(EnergyAudit, WhereNothingPassedNothingIsRelative) {
  History history;
  EXPECT_EQ(audit_energy(history).relative(), std::nullopt);
  history.energies = {balance(0, 0, 0, 0), balance(0, 0, 0, 0)};
  EXPECT_EQ(audit_energy(history).relative(), std::nullopt);
  EXPECT_EQ(audit_energy(history).relative_largest(), std::nullopt);
}

}  // namespace
}  // namespace limber::results::energy_audit_test
