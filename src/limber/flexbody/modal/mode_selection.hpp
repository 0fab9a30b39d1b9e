// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"

/// Which modes a load or a base motion needs, the error of omitting the others,
/// and how to recover most of it without them. Modes are M-orthonormal and
/// K-diagonal, without rigid motion. docs/theory/choosing.md.
namespace limber::flexbody {

/// The report's effective mass of every mode in every load case, m x k.
///
/// Equation   m_j = |phi_j^T M f| / lambda_j  [kg^1/2 N s^2]
/// Source     [@morrison2023, eq. 36], with the consistent mass
/// Limits     M f weights each nodal force by the mass around its node, so the
///            values depend on the mesh; no error estimate follows from them.
/// @param Phi 3N x m; @param lambda m; @param M_s N x N, both triangles [kg]
/// @param loads 3N x k [N]
[[nodiscard]] MatrixX calc_report_effective_mass(
    const MatrixX& Phi, const VectorX& lambda,
    const Eigen::SparseMatrix<double>& M_s, const MatrixX& loads);

/// Work of a load on the static response of each mode, m x k [J]. Over all
/// modes it sums to the load's compliance, f^T K^+ f.
///
/// Equation   c_j = (phi_j^T f)^2 / lambda_j
/// Source     spectral form of K^+; the fractions of modal strain energy
/// @param modal_loads Phi^T f, m x k [kg^-1/2 N]; @param lambda m > 0
[[nodiscard]] MatrixX calc_modal_compliance(const MatrixX& modal_loads,
                                            const VectorX& lambda);

/// Response of modes to a motion of the body's base.
struct Participation {
  /// 6 x m: translation along x, y, z [kg^1/2], rotation about x, y, z through
  /// a point [kg^1/2 m].
  Matrix6X factors;
  Matrix6X effective_mass;  ///< squared factors [kg, kg m^2]
  Vector6 rigid_mass;       ///< of the rigid motion itself [kg, kg m^2]
};

/// Participation factors and effective modal masses.
///
/// Equation   Gamma_aj = r_a^T M phi_j, m_aj = Gamma_aj^2,
///            sum over all modes m_aj = r_a^T M r_a
/// Source     [@wijker2004, ch. 6];
///            the unit generalised mass is that of Phi
/// Limits     For a free body every factor is zero: its modes are M-orthogonal
///            to rigid motion. For a clamped one the sum holds with M_s and x
///            of the free nodes alone (whose mass `rigid_mass` then is), on
///            which Phi is complete. With those of the whole mesh, Phi zero on
///            the clamp, the factors are the loads of a moving base with
///            consistent mass, and the sum is below `rigid_mass` by the
///            fraction of the clamp.
/// @param Phi 3N x m; @param M_s N x N, both triangles [kg]
/// @param x 3 x N relative to the centre of rotation [m]
[[nodiscard]] Participation calc_participation(
    const MatrixX& Phi, const Eigen::SparseMatrix<double>& M_s,
    const Matrix3X& x);

/// The same of any motions of the base; rows of others are zero.
/// @param M_s as multiply_mass @param motions of the degrees of freedom, at
/// most six columns: translations along x, y, z first
[[nodiscard]] Participation calc_base_participation(
    const MatrixX& Phi, const Eigen::SparseMatrix<double>& M_s,
    const MatrixX& motions);

/// Order in which modes are taken until their fractions reach the threshold.
enum class SelectionOrder {
  largest_first,  ///< as few modes as possible (the report's Table 2)
  given,          ///< the leading modes: "the first m"
};

struct SelectionOptions {
  double threshold = 0.9;  ///< fraction of the total to reach, in [0, 1] [-]
  SelectionOrder order = SelectionOrder::largest_first;
};

struct ModeSelection {
  std::vector<int> modes;  ///< indices of the modes of any case, ascending
  std::vector<std::vector<int>>
      cases;             ///< indices of those of each case, ascending
  VectorX reached;       ///< fraction of `modes` in each case [-]
  bool complete = true;  ///< false: even all given modes miss the threshold
};

/// The modes whose fractions reach a threshold in every load case (or, with
/// rows of effective modal mass transposed, in every direction of base motion).
/// @param fractions m x k, none negative, any unit; @param totals k, the sum
/// over all modes of the body: the column sums if all were computed, f^T K^+ f,
/// `rigid_mass`. A case with total zero needs no mode.
/// @throws InputError for a threshold outside [0, 1]; ContractError for sizes
/// or negative values.
[[nodiscard]] ModeSelection select_modes(const MatrixX& fractions,
                                         const VectorX& totals,
                                         const SelectionOptions& options = {});

/// Relative error of the static response by the retained modes, in the norm of
/// elastic energy, of each case (k) [-].
///
/// Equation   |u - u_m|_K / |u|_K = sqrt(1 - sum_kept c_j / f^T K^+ f)
/// Source     orthogonality of the modes in K; exact
/// @param compliance m x k and @param totals f^T K^+ f (k) [J]
[[nodiscard]] VectorX calc_static_error(const MatrixX& compliance,
                                        const VectorX& totals,
                                        const std::vector<int>& modes);

/// Bounds on the error of a steady vibration, relative to the static response
/// to the load's amplitude, in the norm of elastic energy [-].
struct HarmonicError {
  double mode_displacement = 0.0;  ///< [-]
  double mode_acceleration = 0.0;  ///< and truncation augmentation [-]
};

/// Equation   e_md <= e_0 / (1 - s), e_ma <= e_0 s / (1 - s),
///            s = omega^2 / lambda_cut, e_0 the static error
/// Source     mode by mode, docs/theory/choosing.md; augmentation is never
///            worse than mode acceleration there
/// Limits     undamped, omega^2 < lambda_cut
/// @param lambda_cut lowest omitted eigenvalue, or any value below it
/// @param omega load's angular frequency [rad/s]
/// @throws InputError if omega^2 >= lambda_cut: such a mode must be retained.
[[nodiscard]] HarmonicError calc_harmonic_error(double static_error,
                                                double lambda_cut,
                                                double omega);

/// Mode displacement: u = Phi eta, for T instants.
/// @param Phi rows x m, any rows; @param eta m x T [kg^1/2 m]
[[nodiscard]] MatrixX calc_mode_displacement(const MatrixX& Phi,
                                             const MatrixX& eta);

/// Mode acceleration: omitted modes respond statically.
///
/// Equation   u = K^+ F - Phi Lambda^-1 (eta'' + C eta')
///              = Phi eta + (K^+ F - Phi Lambda^-1 Phi^T F)
/// Source     [@dickens1997]; the
///            second form, which needs no rates and is valid with modal damping
/// @param modal_loads Phi^T F, m x T [kg^-1/2 N]
/// @param static_answers K^+ F on the rows of Phi, rows x T [m]
[[nodiscard]] MatrixX calc_mode_acceleration(const MatrixX& Phi,
                                             const VectorX& lambda,
                                             const MatrixX& eta,
                                             const MatrixX& modal_loads,
                                             const MatrixX& static_answers);

/// Mode truncation augmentation: adds one residual vector to the basis, the
/// static response of the omitted modes to the load. Returns the basis
/// unchanged if that is zero. Repeat for further loads.
///
/// Equation   x = K^+ F - Phi Lambda^-1 Phi^T F, phi = x / |x|_M,
///            lambda = x^T F / x^T M x
/// Source     [@dickens1997]; x is
///            orthogonal to Phi in M and in K
/// Limits     `basis` must consist of eigenmodes or residual vectors of the
///            same matrices: then K is not needed, because x^T K x = x^T F.
/// @param basis lambda (m), Phi (3N x m); @param M_s N x N, both triangles
/// @param load 3N [N]; @param static_answer K^+ F, 3N [m]
/// @param drop_tolerance ratio of |x|_M to |K^+ F|_M, at or below which x is
/// treated as noise [-]
/// @throws NumericalError if the residual vector has no stiffness.
[[nodiscard]] ReducedBasis augment_basis(const ReducedBasis& basis,
                                         const Eigen::SparseMatrix<double>& M_s,
                                         const VectorX& load,
                                         const VectorX& static_answer,
                                         double drop_tolerance = 1e-8);

}  // namespace limber::flexbody
