// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"
#include "limber/joints/pairs/pair_mobility.hpp"

/// The effective mass of two bodies against their normal contact forces.
namespace limber::contact {

/// Sum of the normal forces on one side.
struct NormalLoad {
  Vector3 force_W = Vector3::Zero();   ///< along the normals, from A to B [N]
  Vector3 moment_A = Vector3::Zero();  ///< about Ao, world frame [N m]
  Vector3 moment_B = Vector3::Zero();  ///< about Bo, world frame [N m]

  /// @param added_W along its normal; acts at p_W
  void add(const joints::PairBodies& bodies, const Vector3& p_W,
           const Vector3& added_W);
};

/// A free rigid body.
class FreeBody {
 public:
  /// @param mass > 0; infinity of the world [kg]
  /// @param inertia_B about Bo, the centre of mass; zero of a body that its
  /// contacts do not rotate [kg m^2]
  FreeBody(double mass, const Matrix3& inertia_B);

  /// g . M^-1 g of a force and a moment about Bo [N^2/kg]
  [[nodiscard]] double find_yield(const Matrix3& R_WB, const Vector3& force_W,
                                  const Vector3& moment_W) const;

 private:
  double inverse_mass_;        // [1/kg]
  Matrix3 inverse_inertia_B_;  // [1/(kg m^2)]
};

/// Equation   1/m = (g_A . M_A^-1 g_A + g_B . M_B^-1 g_B) / F^2, g the load of
///            all normal forces on a body, F their sum: of one point
///            1/m + (r x n) . J^-1 (r x n) of each body, of parallel forces
///            that at their centre
/// Limits     flexible bodies count as rigid
/// @param F sum of the forces' sizes > 0 [N]
/// @return 1/m [1/kg]
[[nodiscard]] double find_inverse_mass(const FreeBody& A, const FreeBody& B,
                                       const joints::PairBodies& bodies,
                                       const NormalLoad& load, double F);

/// The same for bodies in joints.
///
/// Equation   1/m = g . Y g / F^2
[[nodiscard]] double find_inverse_mass(const joints::PairMobility& Y,
                                       const joints::PairBodies& bodies,
                                       const NormalLoad& load, double F);

}  // namespace limber::contact
