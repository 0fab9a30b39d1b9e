// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/law/point_memory.hpp"
#include "limber/contact/law/torsional_friction.hpp"
#include "limber/contact/narrow_phase/meeting.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// Friction of one contact point against rotation about its normal, as a couple
/// of two forces normal to it.
///
/// Equation   TorsionalFriction with k_r = 16 a_0^3 G_r / 3, a_0 = k_t / (8 G*)
///            at the reference load of k_t, a tenth of the critical damping of
///            a ball of the reduced mass and R_e, and a of the limit
///            = cbrt(3 f R_e / (4 E*)); the rotation since the last commit is
///            n . log of the bodies' relative rotation since then
/// Source     [@johnson1985, ch. 7]
/// Limits     less than half a turn between commits; the rotation of the
///            surfaces by modes is neglected; sliding and rotation do not
///            weaken each other
class PointTwist {
 public:
  /// @param mass reduced mass > 0 [kg]; @param size largest R_e [m]
  PointTwist(const ContactParameters& parameters, const PairModuli& moduli,
             double mass, double size);

  struct Point {
    const Meeting& meeting;
    const PointMemory& memory;  ///< begun; its turn is of the last commit
    double normal_force = 0.0;  ///< >= 0 [N]
  };
  [[nodiscard]] TwistResponse evaluate(const joints::PairBodies& bodies,
                                       const Point& point) const;

  /// Half of the distance between both forces, > 0 [m].
  [[nodiscard]] double find_arm(const PointMemory& memory) const;

 private:
  FrictionLimit friction_;
  PairModuli moduli_;
  std::optional<double> radius_;
  double mass_;
  double size_;
};

/// Rotation of body B in A, as stored in PointMemory.
[[nodiscard]] TurnMemory find_turn(const joints::PairBodies& bodies);

/// Adds energy and power, and forces and stiffness to two points at a distance
/// `arm` on both sides of the meeting's place.
/// @param h time since the last commit [s]
void add_couple(const TwistResponse& twist, const Vector3& normal_W, double arm,
                double h, std::size_t first, joints::PairResponse& out);

}  // namespace limber::contact
