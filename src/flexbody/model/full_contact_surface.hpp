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

/// A surface of a body at level `full`: its Phi_B has no columns, and each of
/// its nodes moves as the mean of the mesh's nodes in its patch.
///
/// Equation   residual = -3 / (5 E' b): the mesh itself deforms locally, so
///            Hertz's share is subtracted
struct FullContactSurface {
  ContactSurface surface;
  NodalMeans means;
};

/// Additional interface of a FullBodySolver whose body may touch others.
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
