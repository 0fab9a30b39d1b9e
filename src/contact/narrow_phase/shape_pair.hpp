// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "limber/contact/narrow_phase/meeting.hpp"
#include "limber/contact/narrow_phase/placed_shape.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/contact/shapes/shape_properties.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// Where two shapes are closest. Immutable.
///
/// The number of features is fixed, for most pairs also their order, so that a
/// feature keeps its identity from step to step:
///
///     sphere with sphere, half
///       space, capsule, skin       1
///     skin with skin, box,
///       cylinder, capsule          8, the deepest that are apart: these have
///                                  no order that lasts (ordered_count())
///     flat skin with flat skin,
///       box, cylinder              n, the pads of the smaller one, then 8 of
///                                  what these miss, as of any skin
///     half space with flat skin    n, its pads
///                     skin         its nodes, or the 64 deepest of them in
///                                  no fixed order
///
/// All others have a potential (PatchPair).
class ShapePair {
 public:
  /// @param with_pads whether flat skins use their pads also with other shapes
  /// than half spaces
  /// @throws InputError as check_shape, or for a pair of kinds without a rule.
  ShapePair(const Shape& A, const Shape& B, bool with_pads = true);

  [[nodiscard]] const Shape& A() const { return A_; }
  [[nodiscard]] const Shape& B() const { return B_; }

  /// Number of features.
  [[nodiscard]] std::size_t most_points() const { return most_points_; }
  /// Whether a feature's index may change from one time to another; its
  /// SurfacePlace identifies it.
  [[nodiscard]] bool has_loose_features() const { return is_loose_; }

  /// Number of the pads' features, which come first.
  [[nodiscard]] std::size_t pad_count() const { return pad_count_; }
  /// Whether the pads, if there are any, are those of A.
  [[nodiscard]] bool has_pads_on_A() const { return has_pads_on_A_; }
  /// Number of features with a fixed index in `out`, which come first.
  [[nodiscard]] std::size_t ordered_count() const {
    return most_points_ - unordered_count_;
  }

  /// Fills `out`, one Meeting a feature. Allocates nothing.
  /// @param reach >= 0: features with a larger distance may get the depth
  /// -infinity, which is cheap to find [m]
  /// @param out of most_points()
  void find(const joints::PairBodies& bodies, double reach,
            std::span<Meeting> out) const;

  /// Depth and p_W, and nothing else, of an overlap deeper than `find` can see,
  /// for the start of a run. The depth is -infinity for pairs whose features
  /// are found at any depth.
  [[nodiscard]] Meeting find_enclosed(const joints::PairBodies& bodies) const;

  /// A lower bound of the distance, accurate where they are close; 0 if they
  /// touch [m].
  [[nodiscard]] double find_clearance(const joints::PairBodies& bodies) const;

 private:
  enum class Rule { kSphere, kHalfSpace, kFlat, kSkins };

  void meet_flat(const PlacedShape& padded, const PlacedShape& face,
                 const joints::PairBodies& bodies, double reach,
                 std::span<Meeting> out) const;
  [[nodiscard]] double find_flat_clearance(
      const PlacedShape& padded, const PlacedShape& face,
      const joints::PairBodies& bodies) const;

  Shape A_;
  Shape B_;
  Shape skin_A_;  // of skins with others: their surfaces
  Shape skin_B_;
  Rule rule_ = Rule::kSphere;
  bool is_swapped_ = false;  // B is the rule's first shape
  bool is_loose_ = false;
  bool has_pads_on_A_ = false;
  std::size_t most_points_ = 1;
  std::size_t pad_count_ = 0;
  std::size_t unordered_count_ = 0;
};

}  // namespace limber::contact
