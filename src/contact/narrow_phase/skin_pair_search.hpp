// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>

#include "limber/common/pose.hpp"
#include "limber/contact/narrow_phase/face_pair.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {

/// A skin with the modal coordinates of its body.
struct DeformedSkin {
  const Skin& skin;
  ModalView eta;
};

/// Finds where two skins are nearest or overlap, in the frame of A.
///
/// Equation   both trees are descended together; for every two faces within
///            reach that face each other find_opposite, which counts where
///            neither surface rises beyond the edges that bound it. For
///            parallel flat faces the corners of their common area: corners of
///            either above the other, and crossing sharp edges; for an edge
///            along a flat part both ends of that line
/// Limits     overlaps up to half of the sum of both thicknesses there
class SkinPairSearch {
 public:
  struct Feature {
    /// How a feature was found; of several at one place the later kind counts.
    enum class Kind { kOpposite, kCrossing, kCornerOfB, kCornerOfA };
    Kind kind = Kind::kOpposite;
    int face_A = -1;
    int face_B = -1;
    FacePairPlace at;
    Vector3 middle = Vector3::Zero();  ///< between both points, in A [m]
    double curvature = 0.0;            ///< of both, >= 0 [1/m]
    double share = 1.0;                ///< [-]
    /// False for a node of a flat part that is no corner, or a place of a line
    /// that is no end. It counts only where it is much deeper than corners and
    /// ends.
    bool is_outer = true;
  };

  /// @param X_AB pose of B's body in A's
  SkinPairSearch(const DeformedSkin& A, const DeformedSkin& B,
                 const Pose& X_AB);

  /// @param reach >= 0: pairs with a larger distance do not count [m]
  void run(double reach);
  /// The same, but ends at the first overlap found, which need not be the
  /// deepest.
  void run_to_overlap(double reach);

  /// A lower bound of the distance from boxes alone, cheap [m].
  [[nodiscard]] double find_box_gap() const;

  /// Depth, or minus the distance, of the deepest pair; -infinity: none [m].
  [[nodiscard]] double deepest() const { return deepest_.at.depth; }
  /// A lower bound of the distance where there is no feature [m].
  [[nodiscard]] double least_gap() const { return least_gap_; }

  /// The deepest distinct features, the deepest first. A feature near to a
  /// deeper one is part of the same area of contact: its share falls to 0 from
  /// 1.5 to 1 times the radius within which both overlap.
  /// @returns their number
  std::size_t select(std::span<Feature> out) const;

 private:
  struct Entry;

  void descend(double reach);
  // The pair of both roots, and the children of a pair.
  [[nodiscard]] Entry make_root() const;
  [[nodiscard]] std::array<Entry, 2> split(const Entry& entry) const;
  void look_at_leaves(const Entry& entry);
  void look_at(int face_A, const FacePatch& A, int face_B, const FacePatch& B,
               bool do_boxes_meet);
  [[nodiscard]] bool are_apart_along(const Vector3& way, const FacePatch& A,
                                     const FacePatch& B) const;
  // Between flat faces.
  struct FacePair {
    int face_A;
    const FacePatch& A;
    int face_B;
    const FacePatch& B;
  };
  [[nodiscard]] std::optional<FacePairPlace> find_under_corner(
      const FacePair& faces, std::size_t corner, bool is_of_A,
      const Vector3& normal) const;
  [[nodiscard]] static std::optional<FacePairPlace> find_edges_crossing(
      const FacePair& faces, std::size_t edge_A, std::size_t edge_B,
      const Vector3& normal);
  void add_flat(const FacePair& faces, Feature::Kind kind,
                const FacePairPlace& pair, bool is_outer);
  void look_at_corners(const FacePair& faces, const Vector3& normal);
  void look_at_edges(const FacePair& faces, const Vector3& normal);
  void look_at_ridges(const FacePair& faces, const Vector3& normal);
  // Whether a place is within an edge that lies along a plane.
  [[nodiscard]] bool is_along_ridge(int face_A, int face_B,
                                    const FacePairPlace& at) const;
  [[nodiscard]] bool is_summit(int face_A, int face_B, const FacePairPlace& at,
                               double tolerance) const;
  void add(const Feature& feature);
  // Of two features at one place the one that counts.
  [[nodiscard]] Feature choose(const Feature& a, const Feature& b) const;
  // Whether no part of either surface is much nearer than the opposite place:
  // sides that pass each other beside the contact do not overlap.
  [[nodiscard]] bool is_genuine(const Feature& feature) const;
  [[nodiscard]] bool is_genuine_of_flat(const Feature& feature) const;
  [[nodiscard]] double find_height(const DeformedSkin& over,
                                   const Vector3& p) const;
  // Whether smooth faces adjoin all edges of both.
  [[nodiscard]] bool are_inner(int face_A, int face_B) const;
  [[nodiscard]] bool is_in_range(int face_A, int face_B, double depth) const;
  [[nodiscard]] Feature make_feature(int face_A, const FacePatch& A, int face_B,
                                     const FacePatch& B,
                                     const FacePairPlace& at) const;
  [[nodiscard]] SkinTree::Box find_box_B(int node) const;
  [[nodiscard]] double limit() const;
  [[nodiscard]] double find_radius(const Feature& feature) const;
  [[nodiscard]] bool is_answered() const;
  [[nodiscard]] bool must_look_deeper() const;
  [[nodiscard]] double find_share(const Feature& feature) const;

  static constexpr std::size_t kMostFeatures = 96;
  static constexpr double kSamePlace = 1e-6;  // of an edge [-]
  // Depth of the order of round-off, likewise.
  static constexpr double kNoDepth = 1e-7;
  // Slope beyond an edge or a corner of the order of round-off [-].
  static constexpr double kRises = 1e-7;
  // Number of face pairs after which it stops looking for deeper overlaps.
  static constexpr int kMostLooks = 60000;

  DeformedSkin A_;
  DeformedSkin B_;
  Pose X_AB_;
  Matrix3 spread_;  // |R_AB|
  double edge_;     // shorter mean edge
  double reach_ = 0.0;
  double slack_ = 0.0;  // up to which overlaps are looked for
  bool has_overlap_ = false;
  bool ends_at_overlap_ = false;
  int looked_ = 0;  // pairs of faces
  double least_gap_ = std::numeric_limits<double>::infinity();
  // An upper bound of the distance.
  double nearest_ = std::numeric_limits<double>::infinity();
  Feature deepest_;  // of all, summits or not
  std::array<Feature, kMostFeatures> features_;
  std::size_t count_ = 0;
};

}  // namespace limber::contact
