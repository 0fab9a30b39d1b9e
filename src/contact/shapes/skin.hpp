// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/face_patch.hpp"
#include "limber/contact/shapes/nearest_point.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/contact/shapes/skin_tree.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A surface of straight or quadratic triangles that deforms with its body's
/// modes. Immutable; bodies with the same reduction share it. All in the body
/// frame; no function but the constructor allocates memory.
///
/// Equation   x(u,v) = sum_i N_i(u,v) (x_B + Phi_B eta)_i on every face at
///            level `full` eta holds the displacements of all N nodes of the
///            mesh, then the largest of their magnitudes, which only bounds the
///            others (joints::PairBody)
/// Limits     the surface follows x_B + Phi_B eta, also where Phi_B is the mean
///            motion of patches. A surface with a border, such as a group of
///            faces, has no inside: see find_nearest.
class Skin {
 public:
  /// @throws InputError, with the surface's name, for sizes that do not fit,
  /// rows out of range, nodes without a face, values that are not finite, or
  /// faces without area.
  explicit Skin(flexbody::ContactSurface surface);
  /// For a body at level `full`. @param mesh_nodes N
  /// @throws InputError as above, also for nodes beyond N
  Skin(flexbody::FullContactSurface surface, Eigen::Index mesh_nodes);

  [[nodiscard]] const flexbody::ContactSurface& surface() const {
    return surface_;
  }
  [[nodiscard]] int mode_count() const {
    return static_cast<int>(has_means() ? 3 * mesh_nodes_ + 1
                                        : surface_.Phi_B.cols());
  }
  /// For each modal coordinate the largest displacement of a point [kg^-1/2, at
  /// level `full` -].
  [[nodiscard]] VectorX find_mode_reach() const;
  [[nodiscard]] std::size_t node_count() const { return owners_.size(); }
  /// Whether no edge belongs to one face alone.
  [[nodiscard]] bool is_closed() const { return is_closed_; }

  struct Hit {
    NearestPoint nearest;  ///< of the deformed surface
    SurfacePlace place;
  };
  /// The point of the deformed faces nearest to a point p. The distance is
  /// that from the curved faces; its sign follows from the face's normal, on
  /// edges and corners from the normals of all faces there, weighted by their
  /// angles.
  ///
  /// Source     [@baerentzen2005]
  /// Limits     with a border, points beyond it are outside, and points behind
  ///            the surface by more than `thickness` have no nearest point. In
  ///            a face it finds the minimum next to that of its flat parts: p
  ///            not beyond the centre of a hollow face.
  /// @param reach points farther outside have none [m]
  /// @param thickness see limits [m]
  [[nodiscard]] std::optional<Hit> find_nearest(const Vector3& p,
                                                const ModalView& eta,
                                                double reach,
                                                double thickness) const;

  /// A lower bound of the distance between the surface and a sphere about p, as
  /// in find_nearest with the radius as thickness; the distance itself unless
  /// it is large; < 0 if they overlap [m].
  [[nodiscard]] double find_clearance(const Vector3& p, double radius,
                                      const ModalView& eta) const;

  struct Plane {
    Vector3 normal = Vector3::UnitZ();  ///< unit, out of the half space [-]
    double offset = 0.0;                ///< of the plane along it [m]
  };
  struct NodeHit {
    std::size_t node = 0;
    double height = 0.0;          ///< above the plane [m]
    Vector3 x = Vector3::Zero();  ///< deformed [m]
    SurfacePlace place;
    double curvature = 0.0;  ///< mean, of one of its faces [1/m]
  };
  /// Calls use(const NodeHit&) for every node up to `reach` above a plane, in a
  /// fixed order, mid-edge nodes included.
  template <class Use>
  void visit_nodes_below(const Plane& plane, const ModalView& eta, double reach,
                         const Use& use) const;
  /// The least height of a node above a plane [m].
  [[nodiscard]] double find_lowest_height(const Plane& plane,
                                          const ModalView& eta) const;

  /// Pads of a flat surface (ContactPads). Their places have indices `face`
  /// after those of all faces, and no u, v.
  [[nodiscard]] std::size_t pad_count() const {
    return static_cast<std::size_t>(surface_.pads.count());
  }
  struct PadHit {
    Vector3 x = Vector3::Zero();  ///< deformed, mean over the pad [m]
    SurfacePlace place;
  };
  [[nodiscard]] PadHit find_pad(std::size_t pad, const ModalView& eta) const;
  /// Unit normal of the mean plane of a deformed flat surface; before
  /// normalisation it is linear in eta.
  ///
  /// Equation   sum over faces of (x_1 - x_0) x (x_2 - x_0) / 2, x their
  ///            corners
  [[nodiscard]] Vector3 find_mean_normal(const ModalView& eta) const;

  /// Weights of the face's nodes at a place, and the modes' rows there.
  /// @param out 3 x mode_count() [kg^-1/2]
  void set_shape_functions(const SurfacePlace& place, Matrix3X& out) const;
  /// surface().residual, linear between corners [m/N].
  [[nodiscard]] double find_residual(const SurfacePlace& place) const;
  /// Upper bound of the deformed surface's distance from Bo [m].
  [[nodiscard]] double find_extent(const ModalView& eta) const;
  /// Boxes about its faces.
  [[nodiscard]] const SkinTree& tree() const { return tree_; }
  [[nodiscard]] std::size_t face_count() const { return surface_.faces.size(); }
  /// A deformed face, then moved by a pose.
  [[nodiscard]] FacePatch make_patch(int f, const ModalView& eta,
                                     const Pose& X) const;
  /// Measures of a face of the undeformed surface.
  struct FaceMeasures {
    double edge = 0.0;  ///< mean length of its edges [m]
    /// Least distance to the surface's opposite side, straight inward from the
    /// face's middle and corners; infinite where there is none [m].
    double thickness = std::numeric_limits<double>::infinity();
    /// Whether the surface is convex there by more than 20 degrees, at the
    /// edges 01, 12, 20.
    std::array<bool, 3> is_sharp = {};
    /// Which edges are sharp or borders: the rim of the surface, or of a part.
    std::array<bool, 3> is_rim = {};
    /// Which parts of the rim run straight to a corner or beyond it.
    std::array<bool, 3> is_ridge = {};
    /// Which corners are on a rim, also of another face; whether the rim goes
    /// on straight there, or turns by more than 5 degrees or ends.
    std::array<bool, 3> is_on_rim = {};
    std::array<bool, 3> is_on_ridge = {};
    std::array<bool, 3> is_corner = {};
    /// Largest distance beyond its edges of a place of the extended face whose
    /// normal is between those of the face and an adjacent one: 0 where they
    /// join smoothly; infinite where a rim meets the face [m].
    double overshoot = 0.0;
    /// Whether the face, and the surface beyond those of its edges that are not
    /// sharp, are plane.
    bool is_plane = true;
  };
  [[nodiscard]] const FaceMeasures& measures(int f) const {
    return measures_[index(f)];
  }
  /// The largest of all measures().edge [m].
  [[nodiscard]] double longest_edge() const { return longest_edge_; }
  [[nodiscard]] double mean_edge() const { return mean_edge_; }
  struct Ball {
    Vector3 centre = Vector3::Zero();  ///< [m]
    double radius = 0.0;               ///< [m]
  };
  /// A ball that contains the whole surface.
  [[nodiscard]] Ball find_ball(const ModalView& eta) const {
    return {centre_, radius_ + find_deformation_bound(eta)};
  }
  /// Whether no face around a place on a corner or an edge rises along a
  /// direction by a slope above `tolerance`, as deformed. True within a face
  /// and on a border.
  /// @param way unit, body frame
  [[nodiscard]] bool is_summit(const SurfacePlace& place, const ModalView& eta,
                               const Vector3& way, double tolerance) const;
  /// The least cosine between a direction and the normals of the deformed faces
  /// at a place.
  /// @param way unit, body frame
  [[nodiscard]] double find_least_cosine(const SurfacePlace& place,
                                         const ModalView& eta,
                                         const Vector3& way) const;

  /// The place on a face with its undeformed position.
  [[nodiscard]] SurfacePlace make_place(int f, const FacePlace& at) const;
  /// Position of a place of the deformed surface [m].
  [[nodiscard]] Vector3 find_position(const SurfacePlace& place,
                                      const ModalView& eta) const;

 private:
  using Face = std::array<int, 6>;
  // One of the faces of a node, and its index there as corner or mid-edge node.
  struct Owner {
    int face = -1;
    int corner = 0;
  };
  struct Candidate {
    int face = -1;
    FacePlace at;
    double square = 0.0;  // of its distance
  };
  // How close to 1 or 0 a corner's weight may be for a place to count as on the
  // corner, or on the edge opposite to it [-].
  static constexpr double kOnEdge = 1e-9;

  [[nodiscard]] FacePatch make_undeformed_patch(int f) const;
  // Index of a node among the corners of a face.
  [[nodiscard]] std::size_t find_corner(int f, int node) const;
  [[nodiscard]] double find_overshoot(int f, int edge, int other) const;
  [[nodiscard]] const Face& face(int f) const {
    return surface_.faces[index(f)];
  }
  // Index of the pad at a place, or < 0.
  [[nodiscard]] Eigen::Index pad_of(const SurfacePlace& place) const;
  [[nodiscard]] Vector3 deform(int node, const ModalView& eta) const;
  [[nodiscard]] FacePatch deform_face(int f, const ModalView& eta) const;
  [[nodiscard]] NodeHit make_node_hit(int node, double height, const Vector3& x,
                                      const ModalView& eta) const;
  [[nodiscard]] std::span<const int> find_faces_of(int node) const;
  [[nodiscard]] double find_deformation_bound(const ModalView& eta) const;
  // The nearest face within a distance.
  [[nodiscard]] std::optional<Candidate> search(const Vector3& p,
                                                const ModalView& eta,
                                                double most_square) const;
  // The normal for the sign of distances, of any length; none on a border.
  [[nodiscard]] std::optional<Vector3> find_pseudo_normal(
      const Candidate& at, const FacePatch& patch, const ModalView& eta) const;
  [[nodiscard]] Vector3 sum_corner_normals(int node,
                                           const ModalView& eta) const;
  [[nodiscard]] Vector3 sum_edge_normals(int f, int edge, const FacePlace& at,
                                         const ModalView& eta) const;

  // The face beyond an edge of a face; -1: a border.
  [[nodiscard]] int find_neighbour(int f, int edge) const;
  [[nodiscard]] double find_thickness(int f, const FacePlace& at) const;

  void check() const;
  void check_means() const;
  void prepare();
  // Whether the body is at level `full`.
  [[nodiscard]] bool has_means() const { return !means_.first.empty(); }
  // Adds weight times the rows of a node.
  void add_rows(int node, double weight, Matrix3X& out) const;
  [[nodiscard]] double sum_weights(int node) const;
  void measure();
  void measure_flat_area();
  void mark_rims();
  void connect();
  void mark_border();
  void set_bounds();

  flexbody::ContactSurface surface_;
  flexbody::NodalMeans means_;  // of a body at level `full`, else none
  Eigen::Index mesh_nodes_ = 0;
  double spread_ = 0.0;  // largest motion per largest displacement of a node
  MatrixX modes_;        // m x 3n: all modes of a node's axis in a column
  std::vector<Owner> owners_;
  std::vector<int> faces_of_nodes_;  // of each corner, one after another
  std::vector<int> first_faces_;     // n + 1: where those of a node begin
  std::vector<std::array<bool, 3>> is_border_;  // edges 01, 12, 20 of faces
  std::vector<bool> is_border_node_;
  bool is_closed_ = true;
  Vector3 centre_ = Vector3::Zero();  // of a sphere about the undeformed skin
  double radius_ = 0.0;
  VectorX largest_motions_;  // m, of any control point under each mode
  SkinTree tree_;
  Vector3 flat_area_ = Vector3::Zero();  // of a flat surface [m^2]
  Matrix3X flat_area_by_modes_;          // 3 x m
  std::vector<FaceMeasures> measures_;
  double longest_edge_ = 0.0;
  double mean_edge_ = 0.0;
};

/// The body's modal coordinates if the skin has modes, else none.
/// @throws ContractError if their numbers differ.
[[nodiscard]] ModalView find_modal_coordinates(const Skin& skin,
                                               const joints::PairBody& body);

template <class Use>
void Skin::visit_nodes_below(const Plane& plane, const ModalView& eta,
                             double reach, const Use& use) const {
  const double most = plane.offset + reach;
  std::array<int, SkinTree::kMostLevels> stack{};
  std::size_t size = 1;
  while (size > 0) {
    const int i = stack[--size];
    if (tree_.find_box(i, eta).find_lowest(plane.normal) > most) continue;
    const SkinTree::Node& node = tree_.node(i);
    if (!node.is_leaf()) {
      stack[size++] = node.right;
      stack[size++] = i + 1;
      continue;
    }
    for (const int f : tree_.find_faces(node)) {
      for (const int n : face(f)) {
        if (n < 0 || owners_[index(n)].face != f) continue;
        const Vector3 x = deform(n, eta);
        const double height = plane.normal.dot(x) - plane.offset;
        if (height <= reach) use(make_node_hit(n, height, x, eta));
      }
    }
  }
}

}  // namespace limber::contact
