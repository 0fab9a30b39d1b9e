// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/law/materials.hpp"
#include "limber/contact/patches/contact_side.hpp"

namespace limber::contact {

/// Radius R_e of a pair for Hertz's k and for bodies without a material: of
/// round sides by the sum of their mean curvatures (a ball 1 / r, the side of a
/// cylinder or capsule, and a cone's disc, 1 / (2 r), an ellipsoid that of its
/// mean radius); where none is round, the larger one of half
/// the shortest edges, of a rigid mesh of half its least width normal to a face
/// [m].
[[nodiscard]] double find_touch_radius(const ContactSide& A,
                                       const ContactSide& B);

/// Moduli by which the potential of two bodies is scaled.
///
/// Equation   of materials find_pair_moduli, and of a ball with a radius of its
///            own sqrt(radius / R_e) times as stiff, so that k on a flat is
///            that of the radius;
///            with a stiffness k E* = 3 k / (4 sqrt(R)), R the radius of the
///            parameters unless one is a ball, or else R_e;
///            with neither E* = 15 C^2 m / (16 sqrt(0.1) T^2 R_e), C = 2.9433,
///            m the reduced mass: a ball that is pressed in by a tenth of its
///            radius bounces off a flat in T = kImpactDuration;
///            without a material nu = 0.3 gives the other moduli
/// Source     Hertz's impact: [@johnson1985, ch. 11]
/// @throws InputError for a value outside its range, and a radius without
/// stiffness where no side is a ball.
[[nodiscard]] PairModuli find_patch_moduli(const ContactSide& A,
                                           const ContactSide& B,
                                           const ContactParameters& parameters);

}  // namespace limber::contact
