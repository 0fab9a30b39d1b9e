// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
#include "limber/flexbody/model/initial_deformation.hpp"
#include "limber/flexbody/model/load_modes_record.hpp"
#include "limber/flexbody/model/mesh_locking.hpp"
#include "limber/flexbody/model/quadratic_manifold.hpp"
#include "limber/flexbody/model/selection_record.hpp"
#include "limber/flexbody/model/stress_modes.hpp"

namespace limber::flexbody {

/// Inertia constants, with which coupled dynamics needs no mesh.
///
/// Equation   S0_ab = x_a^T M_s x_b, S1_abk = x_a^T M_s phi_bk,
///            S2_abkl = phi_ak^T M_s phi_bl, x from the centre of mass.
/// Source     Shabana, Dynamics of Multibody Systems, ch. 5 (inertia shape
///            integrals), here about the mean-axis frame.
struct InertiaShapeIntegrals {
  Matrix3 S0 = Matrix3::Zero();  ///< [kg m^2]
  std::vector<Matrix3> S1;       ///< m entries [kg^1/2 m]
  std::vector<Matrix3> S2;       ///< m*m entries, index k*m + l [-]
  /// int phi_k dm, 3 x m [kg^1/2]: load of uniform gravity on a mode. Zero for
  /// a free body, whose modes do not move the centre of mass.
  Matrix3X P;
};

/// Stored nodal rows of the reduced basis.
struct NodeRows {
  std::vector<std::size_t> tags;  ///< Gmsh node tags
  Matrix3X x_B;                   ///< 3 x n undeformed, relative to the c.m.
                                  ///< [m]
  MatrixX Phi_B;                  ///< 3n x m mode shapes [kg^-1/2]
};

/// A named node set with the weights of its mean motion.
struct NodeGroup {
  std::string name;
  int dimension = 0;              ///< 0 point, 1 curve, 2 surface, 3 volume [-]
  std::vector<std::size_t> tags;  ///< Gmsh node tags
  VectorX weights;  ///< sum to one; consistent with a uniform load [-]
};

/// Mean motion of a weighted node set, in reduced form.
///
/// Equation   p = p_B + Phi_B eta; small rotation = Psi_B eta (least squares
///            over the weighted nodes). Their transposes map a force and a
///            moment to modal loads.
struct InterfaceTable {
  std::string name;
  Vector3 p_B = Vector3::Zero();  ///< undeformed mean point, from the c.m. [m]
  Matrix3X Phi_B;                 ///< 3 x m translation [kg^-1/2]
  Matrix3X Psi_B;                 ///< 3 x m rotation [kg^-1/2 m^-1]
  /// Orthonormal axes about which the node set defines a rotation, 3 x 0 (a
  /// point), 3 x 2 (a line) or 3 x 3, body frame [-].
  Matrix3X rotation_axes = Matrix3X(3, 0);
  std::size_t node_count = 0;  ///< number of nodes of the set
  /// Flexibility of the body at the interface: translation under a unit force
  /// and rotation under a unit moment, inertia-relieved, 6 x 6 (translation
  /// first), body frame [m/N, rad/(N m)].
  Matrix6 flexibility = Matrix6::Zero();
  /// 3 x pairs of the body's manifold, no columns without one: second
  /// derivatives of the mean motion and of the rotation vector by the paired
  /// modes (flexbody/model/quadratic_frame.hpp).
  Matrix3X Phi2_B = Matrix3X(3, 0);  ///< translation [kg^-1 m^-1]
  Matrix3X Psi2_B = Matrix3X(3, 0);  ///< rotation [kg^-1 m^-2]

  [[nodiscard]] int rotation_rank() const {
    return static_cast<int>(rotation_axes.cols());
  }
};

/// Effect of unit rotation on the whole mesh: the constants of the decision
/// boundaries (flexbody/modal/decision_boundary.hpp). All zero if clamped.
struct InertialLevers {
  double lumped = 0.0;      ///< max m_n |b_n| of the row sums, signed [kg m]
  double consistent = 0.0;  ///< max |sum_j M_nj b_j| [kg m]
  /// max (Phi Lambda^-1 Phi^T m|b|)_i, the report's displacement per unit of
  /// |alpha| + |Omega|^2 [m s^2]
  double displacement = 0.0;
};

/// How well S1 and S2 of a body from matrices are known.
struct InertiaRecord {
  std::string gap;  ///< why they are not, and are zero: the body has no level
                    ///< above `uncoupled`; empty: they are known
  std::string notice;  ///< that they have a large error; may be empty
};

/// A flexible body after reduction: all data for dynamics and pictures.
///
/// The body frame B has its origin at the centre of mass and the mesh frame's
/// axes; it is the mean-axis (Tisserand) frame. Phi is M-orthonormal,
/// K-diagonal and M-orthogonal to rigid motion. A body with clamped groups has
/// no rigid motion: `clamped` is true and B does not move.
struct ReducedBody {
  std::string name;
  bool clamped = false;
  double mass = 0.0;                    ///< [kg]
  Vector3 p_MoBcm_M = Vector3::Zero();  ///< c.m. in the mesh frame [m]
  Vector3 size = Vector3::Zero();       ///< bounding box edges [m]
  InertiaShapeIntegrals integrals;
  InertiaRecord inertia_record;
  InertialLevers levers;
  VectorX lambda;  ///< m eigenvalues [rad^2/s^2]
  NodeRows rows;
  std::vector<NodeGroup> groups;
  std::vector<InterfaceTable> interfaces;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< surface, as row
                                                      ///< indices, outward
  std::vector<ContactSurface> contact_surfaces;       ///< those requested
  std::size_t mesh_nodes = 0;                         ///< count
  std::size_t mesh_elements = 0;                      ///< count
  std::size_t mesh_boundary_nodes = 0;                ///< count
  std::optional<MeshLocking> locking;        ///< of a mesh of first order
  std::optional<SelectionRecord> selection;  ///< of automatic modes
  std::vector<LoadModesRecord> load_modes;   ///< of nodal forces
  InitialDeformation initial;  ///< projections of the recipe's fields
  std::string content_key;     ///< hash of all inputs
  std::optional<QuadraticManifold> manifold;  ///< if requested
  std::optional<StressModes> stress;          ///< if requested

  [[nodiscard]] int mode_count() const {
    return static_cast<int>(lambda.size());
  }
  /// Inertia about the centre of mass, tr(S0) I - S0 [kg m^2].
  [[nodiscard]] Matrix3 inertia() const {
    return integrals.S0.trace() * Matrix3::Identity() - integrals.S0;
  }
};

/// Index of the interface called `name`. @throws InputError, naming the
/// nearest known one.
[[nodiscard]] std::size_t find_interface(const ReducedBody& body,
                                         const std::string& name);

/// Row index of the node tagged `tag`. @throws InputError if it is not stored
/// or does not exist.
[[nodiscard]] std::size_t find_row(const ReducedBody& body, std::size_t tag);

/// Row index of the stored node nearest to `point_M` (mesh frame [m]).
[[nodiscard]] std::size_t find_nearest_row(const ReducedBody& body,
                                           const Vector3& point_M);

}  // namespace limber::flexbody
