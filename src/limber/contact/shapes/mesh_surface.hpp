// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/face_patch.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/contact/shapes/surface_tree.hpp"
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
class MeshSurface {
 public:
  /// @throws InputError, with the surface's name, for sizes that do not fit,
  /// rows out of range, nodes without a face, values that are not finite, or
  /// faces without area.
  explicit MeshSurface(flexbody::ContactSurface surface);
  /// For a body at level `full`. @param mesh_nodes N
  /// @throws InputError as above, also for nodes beyond N
  MeshSurface(flexbody::FullContactSurface surface, Eigen::Index mesh_nodes);

  [[nodiscard]] const flexbody::ContactSurface& surface() const {
    return surface_;
  }
  /// Of a body at level `full`, how its parts or slices move.
  [[nodiscard]] const std::vector<flexbody::NodalPiece>& pieces() const {
    return pieces_;
  }
  [[nodiscard]] bool has_pieces() const { return !pieces_.empty(); }
  [[nodiscard]] int mode_count() const {
    return static_cast<int>(has_means() ? 3 * mesh_nodes_ + 1
                                        : surface_.Phi_B.cols());
  }
  /// For each modal coordinate the largest displacement of a point [kg^-1/2, at
  /// level `full` -].
  [[nodiscard]] VectorX find_mode_reach() const;
  [[nodiscard]] std::size_t node_count() const {
    return static_cast<std::size_t>(surface_.x_B.cols());
  }
  /// Whether no edge belongs to one face alone.
  [[nodiscard]] bool is_closed() const { return is_closed_; }

  /// The point of the deformed surface that is nearest to a point p.
  struct NearestPoint {
    double distance = 0.0;             ///< of p, < 0 inside [m]
    Vector3 point = Vector3::Zero();   ///< [m]
    Vector3 normal = Vector3::Zero();  ///< unit, outward: d distance / dp [-]
    double curvature = 0.0;  ///< mean curvature there, 0 on edges [1/m]
  };
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

  /// Weights of the face's nodes at a place, and the modes' rows there.
  /// @param out 3 x mode_count() [kg^-1/2]
  void set_shape_functions(const SurfacePlace& place, Matrix3X& out) const;
  /// surface().residual, linear between corners [m/N].
  [[nodiscard]] double find_residual(const SurfacePlace& place) const;
  /// Upper bound of the deformed surface's distance from Bo [m].
  [[nodiscard]] double find_extent(const ModalView& eta) const;
  [[nodiscard]] std::size_t face_count() const { return surface_.faces.size(); }
  /// The place on a face with its undeformed position.
  [[nodiscard]] SurfacePlace make_place(int f, const FacePlace& at) const;
  /// Position of a place of the deformed surface [m].
  [[nodiscard]] Vector3 find_position(const SurfacePlace& place,
                                      const ModalView& eta) const;

 private:
  using Face = std::array<int, 6>;
  struct Candidate {
    int face = -1;
    FacePlace at;
    double square = 0.0;  // of its distance
  };
  // How close to 1 or 0 a corner's weight may be for a place to count as on the
  // corner, or on the edge opposite to it [-].
  static constexpr double kOnEdge = 1e-9;

  [[nodiscard]] const Face& face(int f) const {
    return surface_.faces[index(f)];
  }
  [[nodiscard]] Vector3 deform(int node, const ModalView& eta) const;
  [[nodiscard]] FacePatch deform_face(int f, const ModalView& eta) const;
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

  void check() const;
  void check_means() const;
  void prepare();
  // Whether the body is at level `full`.
  [[nodiscard]] bool has_means() const { return !means_.first.empty(); }
  // Adds weight times the rows of a node.
  void add_rows(int node, double weight, Matrix3X& out) const;
  [[nodiscard]] double sum_weights(int node) const;
  void connect();
  void mark_border();
  void set_bounds();

  flexbody::ContactSurface surface_;
  flexbody::NodalMeans means_;  // of a body at level `full`, else none
  std::vector<flexbody::NodalPiece> pieces_;  // likewise
  Eigen::Index mesh_nodes_ = 0;
  double spread_ = 0.0;  // largest motion per largest displacement of a node
  MatrixX modes_;        // m x 3n: all modes of a node's axis in a column
  std::vector<int> faces_of_nodes_;  // of each corner, one after another
  std::vector<int> first_faces_;     // n + 1: where those of a node begin
  std::vector<std::array<bool, 3>> is_border_;  // edges 01, 12, 20 of faces
  std::vector<bool> is_border_node_;
  bool is_closed_ = true;
  Vector3 centre_ =
      Vector3::Zero();  // of a sphere about the undeformed surface
  double radius_ = 0.0;
  VectorX largest_motions_;  // m, of any control point under each mode
  SurfaceTree tree_;
};

/// The body's modal coordinates if the surface has modes, else none.
/// @throws ContractError if their numbers differ.
[[nodiscard]] ModalView find_modal_coordinates(const MeshSurface& mesh_surface,
                                               const joints::PairBody& body);

}  // namespace limber::contact
