// SPDX-License-Identifier: BSD-3-Clause
// A weight in free fall, by Simbody behind Limber's face.
#include <cmath>
#include <cstdio>
#include <limber/reference/verification.hpp>

int main() {
  using namespace limber::reference;
  Mechanism mechanism;
  MechanismBody weight;
  weight.mass = 1.0;
  weight.inertia.setIdentity();
  weight.mobilizer = Mobilizer::free;
  mechanism.bodies = {weight};
  mechanism.gravity_W = {0.0, 0.0, -9.81};
  mechanism.observed = {{0, {}}};
  const SimbodyRun run =
      simulate(mechanism, {JointModel::ideal, 1e-10}, {{1.0, false, true}});
  const double z = run.snapshots.back().frames[0].p_WB.z();
  std::printf("%s: z = %g m\n", simbody_name().c_str(), z);
  return std::abs(z + 4.905) < 1e-9 ? 0 : 1;
}
