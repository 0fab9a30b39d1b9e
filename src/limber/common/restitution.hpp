// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Impacts of two bodies on an elastic law f(d) with the damping f b d'.
namespace limber {

/// Duration of a free body's contact with end stops, and with contacts without
/// a material, which determines their default stiffness [s].
inline constexpr double kImpactDuration = 0.01;

/// The b with which a free body that arrives at `speed` leaves at
/// `restitution` of it.
///
/// Equation   (1 + e) beta = ln((1 + beta) / (1 - e beta)), beta = b v:
///            the first integral of m d'' = -f(d) (1 + b d'), whatever m and
///            the law f(d) > 0, as the energy stored on the way in is that
///            released on the way out. As beta < 1/e, nothing pulls.
/// Source     [@hunt1975] for the law
/// @param restitution e in (0, 1] [-]
/// @param speed v > 0 [m/s or rad/s]
/// @return b [s/m or s/rad]; 0 at e = 1, and 1 / (e v) to round-off at
///         e < 0.02: there is none at e = 0.
/// @throws ContractError for values outside their range.
[[nodiscard]] double find_restitution_damping(double restitution, double speed);

/// Smaller restitutions use the factor of this one: the bodies then retain 0.25
/// % of their energy. The factor grows without bound towards 0 [-].
inline constexpr double kLeastRestitution = 0.05;

/// The beta with which two free bodies under f max(0, 1 + beta v / sqrt(v^2 + 2
/// W / m)) separate with `restitution` times their approach speed.
///
/// Equation   ln e = -beta int u^2 / (1 + beta (u - u^3)) du from -1 to 1,
///            beta <= 1; beyond it from -1/beta, where the force ends, and
///            times 1/beta: with E = m v^2 / 2 + W and v = u sqrt(2 E / m),
///            dE/du depends neither on f = dW/dd nor on m and the speed
/// @param restitution e in [0, 1] [-]
/// @return beta [-]: 0 at e = 1, about 3/2 (1 - e) near it, 7.17 at the least
/// @throws ContractError for a value outside its range.
[[nodiscard]] double find_restitution_factor(double restitution);

}  // namespace limber
