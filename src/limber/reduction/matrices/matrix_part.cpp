// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/matrix_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/length_unit.hpp"
#include "limber/reduction/matrices/matrix_checks.hpp"

namespace limber::flexbody {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A unit of the files that would give the stated mass: it is inverse to it.
std::string suggest_unit(double mass, double stated, double unit) {
  constexpr double kAlike = 0.01;
  for (const char* name : {"m", "cm", "mm", "in", "ft"}) {
    const std::optional<double> metres = parse_length_unit(name);
    if (!metres) continue;
    if (std::abs(mass * unit / *metres / stated - 1.0) < kAlike)
      return fmt::format(
          "; it would be {:.6g} kg if lengths were in {} (and forces in N)",
          mass * unit / *metres, name);
  }
  return "";
}

void check_mass(const MatrixSystem& system, const RigidInertia& inertia,
                double stated, double unit) {
  constexpr double kAllowed = 0.01;
  if (std::abs(inertia.mass / stated - 1.0) <= kAllowed) return;
  throw InputError(fmt::format(
      "{}: the mass matrix has {:.6g} kg, and {:.6g} kg are stated (with "
      "forces "
      "in N, time in s and lengths in units of {:g} m, masses are in units of "
      "{:g} kg){}",
      system.source, inertia.mass, stated, unit, 1.0 / unit,
      suggest_unit(inertia.mass, stated, unit)));
}

void check_rigid_mass(const RigidInertia& inertia, MatrixSystem& system) {
  constexpr double kSilent = 1e-6;
  constexpr double kAllowed = 1e-3;
  if (inertia.defect < kSilent) return;
  const std::string text = fmt::format(
      "{}: the mass differs by {:.2g} from direction to direction, or its "
      "centre does",
      system.source, inertia.defect);
  if (inertia.defect > kAllowed)
    throw InputError(
        text +
        "; expected that of a rigid body in rigid motion. Are "
        "displacements of some nodes in local frames, or rows in another "
        "order?");
  system.notices.push_back(text);
}

/// Nodes whose rows have the largest |K x|_i / (|K| |x|)_i, the largest first.
std::vector<int> find_holding_nodes(const MatrixSystem& system,
                                    const VectorX& x) {
  constexpr double kLeast = 0.1;  // of the largest
  VectorX force = VectorX::Zero(x.size());
  VectorX scale = VectorX::Zero(x.size());
  for (Eigen::Index j = 0; j < system.K.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(system.K, j); it; ++it) {
      force[it.row()] += it.value() * x[j];
      scale[it.row()] += std::abs(it.value() * x[j]);
    }
  VectorX fraction =
      VectorX::Zero(static_cast<Eigen::Index>(system.tags.size()));
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const int node = system.rows[static_cast<std::size_t>(i)].node;
    if (node >= 0 && scale[i] > 0.0)
      fraction[node] = std::max(fraction[node], std::abs(force[i]) / scale[i]);
  }
  std::vector<int> nodes;
  for (int n = 0; n < fraction.size(); ++n)
    if (fraction[n] > 0.0 && fraction[n] >= kLeast * fraction.maxCoeff())
      nodes.push_back(n);
  std::sort(nodes.begin(), nodes.end(),
            [&](int a, int b) { return fraction[a] > fraction[b]; });
  return nodes;
}

/// sum |A_ij x_i x_j|, of whose roundoff x^T A x is.
double sum_sizes(const fem::SparseMatrix& A, const VectorX& x) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(A, j); it; ++it)
      sum += std::abs(it.value() * x[it.row()] * x[j]);
  return sum;
}

constexpr std::array<const char*, 6> kMotions = {
    "translation along x", "translation along y", "translation along z",
    "rotation about x",    "rotation about y",    "rotation about z"};

void check_rigid_stiffness(const MatrixX& X, double lambda,
                           MatrixSystem& system) {
  constexpr double kSilent = 1e-6;
  constexpr double kAllowed = 1e-2;
  constexpr double kRoundoff = 10.0 * kEpsilon;
  double worst = 0.0;
  std::size_t motion = 0;
  for (Eigen::Index a = 0; a < 6; ++a) {
    const VectorX x = X.col(a);
    const double energy = std::abs(x.dot(system.K * x));
    if (energy <= kRoundoff * sum_sizes(system.K, x)) continue;
    const double rho = energy / (x.dot(system.M * x) * lambda);
    if (!(rho > worst)) continue;
    worst = rho;
    motion = static_cast<std::size_t>(a);
  }
  if (worst < kSilent) return;
  const std::string text = fmt::format(
      "{}: {} of the whole body has {:.2g} times the stiffness of the first "
      "mode, where a free body has none",
      system.source, kMotions[motion], worst);
  if (worst < kAllowed) {
    system.notices.push_back(
        text +
        "; it is projected out. Coordinates or matrices have too few "
        "digits, or a weak spring to ground");
    return;
  }
  const std::vector<int> nodes =
      find_holding_nodes(system, X.col(static_cast<Eigen::Index>(motion)));
  throw InputError(fmt::format(
      "{}, held at {}. Export the matrices without supports and springs to "
      "ground (clamp nodes here); coordinates must be in the unit and frame of "
      "the matrices, rows in the order of their table, rotations in rad",
      text, system.name_nodes(nodes)));
}

/// Node that moves most, by the inertia of its rows.
std::string name_moving_node(const MatrixSystem& system,
                             const std::vector<int>& rows, const VectorX& phi) {
  Eigen::Index most = 0;
  phi.cwiseAbs().maxCoeff(&most);
  return system.name_row(rows[static_cast<std::size_t>(most)]);
}

void check_mechanism(const MatrixSystem& system, const std::vector<int>& rows,
                     const fem::StructuralMatrices& matrices,
                     const FirstMode& first) {
  constexpr double kRoundoff = 10.0 * kEpsilon;
  const double noise = kRoundoff * sum_sizes(matrices.K, first.phi);
  if (first.lambda > noise) return;
  throw InputError(fmt::format(
      "{}: besides the six rigid motions there is one without stiffness "
      "(eigenvalue {:.3g} rad^2/s^2), which moves {} most; expected one "
      "connected structure without mechanisms",
      system.source, first.lambda, name_moving_node(system, rows, first.phi)));
}

/// Root mean square of the change of lambda_1 by rounding K to its digits.
void check_digits(const fem::StructuralMatrices& matrices,
                  const FirstMode& first, MatrixSystem& system) {
  constexpr double kSilent = 1e-4;
  constexpr int kExact = 17;
  if (system.digits >= kExact) return;
  double sum = 0.0;
  for (Eigen::Index j = 0; j < matrices.K.outerSize(); ++j)
    for (fem::SparseMatrix::InnerIterator it(matrices.K, j); it; ++it) {
      const double part = it.value() * first.phi[it.row()] * first.phi[j] *
                          (it.row() == j ? 1.0 : 2.0);
      sum += part * part;
    }
  const double error =
      std::pow(10.0, -system.digits) * std::sqrt(sum) / first.lambda;
  if (error < kSilent) return;
  system.notices.push_back(fmt::format(
      "{}: the stiffness has {} digits, which leave the first eigenvalue an "
      "error of about {:.2g}; write more",
      system.source, system.digits, error));
}

constexpr double kSilentDefect = 2e-3;
constexpr double kMostDefect = 0.1;  // above, S1 and S2 are not taken

}  // namespace

std::shared_ptr<const MatrixPart> make_matrix_part(fem::MatrixModel model,
                                                   double mass, double unit,
                                                   const Progress& progress) {
  if (!(mass > 0.0) || !std::isfinite(mass))
    throw InputError(fmt::format(
        "{}: the stated mass is {} kg; expected that of the whole model, which "
        "its program prints, > 0",
        model.source, mass));
  report(progress, "checking the matrices", 0.0);
  MatrixSystem system = make_matrix_system(std::move(model), unit);
  check_symmetry(system);
  check_minors(system);
  const MatrixX X_o = make_rigid_motions(system);
  const RigidInertia inertia = calc_rigid_inertia(system, X_o);
  check_mass(system, inertia, mass, unit);
  check_rigid_mass(inertia, system);
  check_positive_mass(system);
  const MatrixX X = move_origin(X_o, inertia.center);
  const std::vector<int> rows = find_free_rows(system, {});
  const fem::StructuralMatrices matrices = restrict_system(system, rows);
  const bool is_free = system.held.empty();
  const MatrixX R = is_free
                        ? orthonormalise_rigid(matrices, X(rows, Eigen::all))
                        : MatrixX(std::ssize(rows), 0);
  const FirstMode first = find_first_mode(system, rows, matrices, R);
  check_mechanism(system, rows, matrices, first);
  if (is_free) check_rigid_stiffness(X, first.lambda, system);
  check_digits(matrices, first, system);
  MassBlocks blocks(system);
  auto part = std::make_shared<MatrixPart>(MatrixPart{
      std::move(system), X, inertia, std::move(blocks), first.shift});
  part->block_defect =
      calc_block_defect(part->system, part->blocks, part->inertia);
  if (part->block_defect >= kSilentDefect && part->block_defect < kMostDefect &&
      !part->system.has_recovery && !part->system.has_moments())
    part->system.notices.push_back(fmt::format(
        "{}: moments of inertia by the nodes' blocks of the mass matrix differ "
        "by {:.2g} from those of rigid rotation; the coupling of large "
        "rotation and deformation has an error of that size. More elements or "
        "lumped masses reduce it",
        part->system.source, part->block_defect));
  return part;
}

}  // namespace limber::flexbody
