// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "limber/joints/coupler_law.hpp"
#include "limber/joints/joint_kind.hpp"

/// The coupler laws tested for consistency, and random motions of them.
namespace limber::testing {

/// When a law is the same with the names of F and M exchanged.
enum class Ends { differ, same_at_rest, same };

/// Its properties: a law without a spring stores nothing, one without a damper
/// dissipates nothing.
enum class Parts { both, spring, damper };

struct CouplerCase {
  std::string name;
  /// The law with all its axes turned by Q.
  std::function<joints::CouplerLaw(const Matrix3& Q)> make;
  /// Directions in which its motions are large.
  joints::JointKind freedom = joints::JointKind::floating;
  Ends ends = Ends::differ;
  /// Where it exerts no force, after its drives have come to rest.
  joints::RelativeMotion rest = {};
  Parts parts = Parts::both;

  [[nodiscard]] joints::CouplerLaw law() const {
    return make(Matrix3::Identity());
  }
  friend void PrintTo(const CouplerCase& item, std::ostream* out) {
    *out << item.name;
  }
};

/// A new law joins by a line in here.
[[nodiscard]] std::vector<CouplerCase> coupler_cases();

/// The drives of the cases move until then [s], and then rest where they exert
/// no force at the joint's rest.
inline constexpr EvaluationTime kMidway{0.7};
inline constexpr EvaluationTime kAfterwards{10.0};

/// Rotations to 3 rad and 2 m in the free directions, to 0.2 rad and 0.1 m in
/// the others; speeds to 1.5.
[[nodiscard]] joints::RelativeMotion random_motion(joints::JointKind freedom,
                                                   std::mt19937& random);

/// Up to three whole turns; a latch closed not far from `motion`.
[[nodiscard]] joints::CouplerMemory random_memory(
    const joints::CouplerLaw& law, const joints::RelativeMotion& motion,
    std::mt19937& random);

/// `motion` after its velocities, or one increment, have acted for `by`.
[[nodiscard]] joints::RelativeMotion carried(
    const joints::RelativeMotion& motion, double by);
[[nodiscard]] joints::RelativeMotion moved(const joints::RelativeMotion& motion,
                                           int direction, double by);
/// Faster by `by` in one direction.
[[nodiscard]] joints::RelativeMotion hastened(
    const joints::RelativeMotion& motion, int direction, double by);
[[nodiscard]] joints::RelativeMotion stilled(joints::RelativeMotion motion);
/// In axes turned by Q.
[[nodiscard]] joints::RelativeMotion turned(
    const joints::RelativeMotion& motion, const Matrix3& Q);
/// That of F seen from M.
[[nodiscard]] joints::RelativeMotion exchanged(
    const joints::RelativeMotion& motion);

[[nodiscard]] Vector6 velocity_of(const joints::RelativeMotion& motion);
[[nodiscard]] Vector3 random_vector(std::mt19937& random);

}  // namespace limber::testing
