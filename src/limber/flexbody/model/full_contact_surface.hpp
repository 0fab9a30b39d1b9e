// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/flexbody/model/full_body.hpp"

namespace limber::flexbody {

/// Means over the nodes of a mesh, one for each node of a surface.
struct NodalMeans {
  std::vector<std::size_t> first;  ///< n + 1: where those of a node begin
  std::vector<int> nodes;          ///< of the mesh, one after another
  std::vector<double> weights;     ///< sum to one each [-]
};

/// A piece of a surface that moves as one, by the nodes of a mesh.
///
/// Equation   (u, theta) = motion d of small displacements d of the nodes: that
///            of every small rigid motion about the centre
struct NodalPiece {
  std::vector<int> nodes;  ///< of the mesh
  Matrix3X x_P;            ///< 3 x n undeformed, from the piece's centre [m]
  MatrixX motion;          ///< 6 x 3n [-, 1/m]
};

/// A surface of a body at level `full`: its Phi_B and the motions of its parts
/// or slices have no columns. Each of its nodes moves as the mean of the mesh's
/// nodes in its patch, each part or slice as a NodalPiece.
///
/// Equation   residual = -3 / (5 E' b): the mesh itself deforms locally, so
///            Hertz's fraction is subtracted
struct FullContactSurface {
  ContactSurface surface;
  NodalMeans means;
  std::vector<NodalPiece> pieces;  ///< of all parts, or of all slices
};

/// Additional interface of a FullBodySolver whose body may be in contact with
/// others.
class ContactSurfaces {
 public:
  ContactSurfaces() = default;
  ContactSurfaces(const ContactSurfaces&) = delete;
  ContactSurfaces& operator=(const ContactSurfaces&) = delete;
  virtual ~ContactSurfaces() = default;

  [[nodiscard]] virtual const std::vector<FullContactSurface>&
  contact_surfaces() const = 0;
};

/// Those of a body; none if its solver has none.
[[nodiscard]] inline std::vector<FullContactSurface> find_contact_surfaces(
    const FullBody& body) {
  const auto solver = body.make_solver();
  const auto* touching = dynamic_cast<const ContactSurfaces*>(solver.get());
  if (touching == nullptr) return {};
  return touching->contact_surfaces();
}

}  // namespace limber::flexbody
