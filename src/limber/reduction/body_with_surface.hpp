// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/matrices/matrix_model.hpp"
#include "limber/reduction/meshed_body.hpp"

namespace limber::flexbody {

/// A body with the mesh whose boundary may touch others. Part of
/// limber_reduction.
struct BodyWithSurface {
  BodyWithSurface(const MeshedBody& meshed)  // NOLINT: it is one
      : body(meshed), mesh(meshed.mesh) {}
  /// @param its_mesh the surface's, with its boundary; its nodes are those of
  /// the body's fields of six rows a node
  BodyWithSurface(const ElasticBody& its_body,
                  const fem::ModelSurface& its_surface,
                  const fem::Mesh& its_mesh)
      : body(its_body), mesh(its_mesh), mesh_surface(&its_surface) {}

  const ElasticBody& body;
  const fem::Mesh& mesh;
  const fem::ModelSurface* mesh_surface = nullptr;  ///< of beams and shells

  /// Generalized forces of loads on the mesh's nodes, 3N x k.
  [[nodiscard]] MatrixX put_on_free(const MatrixX& loads) const {
    if (mesh_surface == nullptr) return body.support.on_free(loads);
    const Eigen::Index nodes = loads.rows() / 3;
    MatrixX fields = MatrixX::Zero(6 * nodes, loads.cols());
    for (Eigen::Index n = 0; n < nodes; ++n)
      fields.middleRows<3>(6 * n) = loads.middleRows<3>(3 * n);
    return body.support.on_free(fields);
  }
  /// Whether the body's own stiffness has the local deformation under a load on
  /// the node: that of solid elements has.
  [[nodiscard]] bool has_depth(int node) const {
    return mesh_surface == nullptr ||
           mesh_surface->bases[static_cast<std::size_t>(node)] == node;
  }
};

}  // namespace limber::flexbody
