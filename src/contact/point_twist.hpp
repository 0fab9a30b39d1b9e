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

/// Friction of one contact point against turning about its normal, as a couple
/// of two forces across the normal.
///
/// Equation   TorsionalFriction with k_r = 16 a_0^3 G_r / 3 and a_0 = k_t /
///            (8 G*) of the reference load that k_t is of, a tenth of critical
///            damping of a ball of the reduced mass and R_e, and the limit's
///            a = cbrt(3 f R_e / (4 E*)); the turn since the last commit is
///            n . log of the bodies' relative rotation since then
/// Source     [@johnson1985, ch. 7]
/// Limits     less than half a turn between commits; the surfaces' own turning
///            by modes is not counted; sliding and turning do not weaken each
///            other
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

/// Of body B in A, as PointMemory keeps it.
[[nodiscard]] TurnMemory find_turn(const joints::PairBodies& bodies);

/// Adds energy and power, and forces and stiffness to two points that are at
/// the meeting's place, `arm` to both sides of it.
/// @param h time since the last commit [s]
void add_couple(const TwistResponse& twist, const Vector3& normal_W, double arm,
                double h, std::size_t first, joints::PairResponse& out);

}  // namespace limber::contact
