// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "limber/common/stack_array.hpp"
#include "limber/contact/patches/patch_part.hpp"
#include "limber/contact/patches/surface_parts.hpp"
#include "limber/contact/potential/mesh_parts.hpp"

/// Poses of the parts of both sides of a pair, and which may be in contact.
namespace limber::contact {

/// The frames of all parts of one side: of a rigid mesh all the same, of a
/// flexible surface one each, up to kMostSurfaceParts.
class SideFrames {
 public:
  SideFrames(const std::vector<PatchPart>& parts, const joints::PairBody& body);

  [[nodiscard]] std::size_t count() const { return parts_.size(); }
  [[nodiscard]] const joints::PairBody& operator[](std::size_t i) const {
    return frames_.all()[is_shared_ ? 0 : i];
  }
  /// Of a part's ball [m].
  [[nodiscard]] Vector3 find_centre(std::size_t i) const {
    const joints::PairBody& frame = (*this)[i];
    return frame.p_WB + frame.R_WB * parts_[i].ball().centre;
  }
  [[nodiscard]] double radius(std::size_t i) const {
    return parts_[i].ball().radius;
  }
  /// About the balls of all parts.
  [[nodiscard]] ConvexSolid::Ball find_ball() const;

 private:
  const std::vector<PatchPart>& parts_;
  bool is_shared_;
  StackArray<joints::PairBody, kMostSurfaceParts> frames_;
};

/// The frames of all parts of both sides.
struct PatchFrames {
  PatchFrames(const std::vector<PatchPart>& parts_A,
              const std::vector<PatchPart>& parts_B,
              const joints::PairBodies& bodies)
      : A(parts_A, bodies.A), B(parts_B, bodies.B) {}

  /// Calls use(i, j, distance) for pairs of parts of which the balls are up to
  /// `reach` apart, in the order of their indices; the distance of the balls is
  /// < 0 where they meet [m].
  template <typename Use>
  void visit_near(double reach, const Use& use) const {
    Chosen chosen_A;
    Chosen chosen_B;
    choose(A, B.find_ball(), reach, chosen_A);
    choose(B, A.find_ball(), reach, chosen_B);
    for (const std::size_t i : chosen_A.all()) {
      for (const std::size_t j : chosen_B.all()) {
        const double distance = find_distance(i, j);
        if (distance <= reach) use(i, j, distance);
      }
    }
  }

  SideFrames A;
  SideFrames B;

 private:
  using Chosen = StackArray<std::size_t, kMostSolids>;

  static void choose(const SideFrames& side, const ConvexSolid::Ball& other,
                     double reach, Chosen& out);
  [[nodiscard]] double find_distance(std::size_t i, std::size_t j) const;
};

}  // namespace limber::contact
