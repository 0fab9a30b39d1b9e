// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/initial_deformation.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/flexbody/model/multiply_mass.hpp"

namespace limber::flexbody {
namespace {

/// Smallest fraction that is reported.
constexpr double kSmall = 0.01;
/// Remainder of a rigid field by roundoff.
constexpr double kRoundoffOfField = 1e-10;

double calc_norm(const VectorX& u, const Eigen::SparseMatrix<double>& M_s) {
  return std::sqrt(u.dot(multiply_mass(M_s, u).col(0)));
}

}  // namespace

ProjectedField project_field(const VectorX& u, const MatrixX& Phi,
                             const Eigen::SparseMatrix<double>& M_s,
                             const MatrixX& R) {
  LIMBER_EXPECT(u.size() == Phi.rows() && u.size() == R.rows());
  const VectorX momentum = multiply_mass(M_s, u);
  const VectorX rigid = R.transpose() * momentum;
  const VectorX elastic = u - R * rigid;
  ProjectedField field;
  field.key = find_field_key(u);
  field.eta = Phi.transpose() * multiply_mass(M_s, elastic);
  const double whole = std::sqrt(u.dot(momentum));
  const double deformed = calc_norm(elastic, M_s);
  if (whole > 0.0) field.rigid_fraction = rigid.norm() / whole;
  if (deformed > kRoundoffOfField * whole) {
    field.missed_fraction =
        calc_norm(elastic - Phi * field.eta, M_s) / deformed;
  }
  return field;
}

std::string find_field_key(const VectorX& u) {
  const XXH128_hash_t hash = XXH3_128bits(
      u.data(), sizeof(double) * static_cast<std::size_t>(u.size()));
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::vector<std::string> describe_losses(const ProjectedField& field,
                                         const std::string& what) {
  std::vector<std::string> texts;
  if (field.rigid_fraction > kSmall) {
    texts.push_back(fmt::format(
        "{:.3g} % of the {} (in the norm of mass) is rigid motion and is left "
        "out; specify it by [initial.base] or [initial.joints]",
        100.0 * field.rigid_fraction, what));
  }
  if (field.missed_fraction > kSmall) {
    texts.push_back(fmt::format(
        "{:.3g} % of the {} (deformation, in the norm of mass) is not in the "
        "basis and is left out; keep more modes",
        100.0 * field.missed_fraction, what));
  }
  return texts;
}

}  // namespace limber::flexbody
