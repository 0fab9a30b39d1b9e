// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/quadratic_strain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/flexbody/elasticity/elasticity_checks.hpp"

namespace limber::flexbody {
namespace {

void check_paired(const std::vector<int>& paired, Eigen::Index modes) {
  if (paired.size() > QuadraticStrain::kMostPaired) {
    throw InputError(fmt::format("{} paired modes; expected at most {}",
                                 paired.size(), QuadraticStrain::kMostPaired));
  }
  int least = 0;
  for (const int k : paired) {
    if (k < least || k >= modes) {
      throw InputError(fmt::format(
          "paired mode {} is not among the {} modes, or not after the one "
          "before it; expected indices from 0 that increase",
          k, modes));
    }
    least = k + 1;
  }
}

// A row of Q as the symmetric matrix of its form.
MatrixX unpack(const MatrixX& Q, Eigen::Index row, Eigen::Index n) {
  MatrixX B(n, n);
  Eigen::Index pair = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    B(i, i) = Q(row, pair++);
    for (Eigen::Index j = i + 1; j < n; ++j) {
      B(i, j) = B(j, i) = 0.5 * Q(row, pair++);
    }
  }
  return B;
}

}  // namespace

QuadraticStrain::QuadraticStrain(Parameters parameters)
    : parameters_(std::move(parameters)), linear_(parameters_.lambda) {
  check_eigenvalues(parameters_.lambda);
  check_paired(parameters_.paired, size());
  const auto n = static_cast<Eigen::Index>(parameters_.paired.size());
  const MatrixX& Q = parameters_.Q;
  check_shape("the table of quadratic strains", Q, n, n * (n + 1) / 2);
  check_finite("the table of quadratic strains", Q);
  for (Eigen::Index r = 0; r < n; ++r) {
    if (Q.row(r).isZero(0.0)) continue;
    rows_.push_back({static_cast<int>(r),
                     std::sqrt(parameters_.lambda[mode(r)]), unpack(Q, r, n)});
    linear_[mode(r)] = 0.0;
  }
}

QuadraticStrain::Paired QuadraticStrain::gather(const ModesIn& q) const {
  Paired out(std::ssize(parameters_.paired));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = q[mode(i)];
  return out;
}

void QuadraticStrain::scatter(double factor, const Paired& row,
                              ModesOut force) const {
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    force[mode(i)] += factor * row[i];
  }
}

double QuadraticStrain::energy(const ModesIn& q) const {
  double sum = (linear_.array() * q.array().square()).sum();
  const Paired p = gather(q);
  Paired Bp(p.size());
  for (const Row& row : rows_) {
    Bp.noalias() = row.B * p;
    const double e = row.root * p[row.place] + p.dot(Bp);
    sum += e * e;
  }
  return 0.5 * sum;
}

void QuadraticStrain::calc_force(const ModesIn& q, ModesOut force) const {
  force.array() = linear_.array() * q.array();
  const Paired p = gather(q);
  Paired D(p.size());  // B p, then de/dq
  for (const Row& row : rows_) {
    D.noalias() = row.B * p;
    const double e = row.root * p[row.place] + p.dot(D);
    D *= 2.0;
    D[row.place] += row.root;
    scatter(e, D, force);
  }
}

void QuadraticStrain::set_linear_tangent(ModesSquare tangent) const {
  tangent.setZero();
  tangent.diagonal() = linear_;
}

void QuadraticStrain::add_to_tangent(const Paired& a, const Paired& b,
                                     double factor, const MatrixX& B,
                                     ModesSquare tangent) const {
  for (Eigen::Index j = 0; j < b.size(); ++j) {
    double* column = tangent.col(mode(j)).data();
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      column[mode(i)] += a[i] * b[j] + factor * B(i, j);
    }
  }
}

void QuadraticStrain::calc_tangent(const ModesIn& q,
                                   ModesSquare tangent) const {
  set_linear_tangent(tangent);
  const Paired p = gather(q);
  Paired D(p.size());
  for (const Row& row : rows_) {
    D.noalias() = row.B * p;
    const double e = row.root * p[row.place] + p.dot(D);
    D *= 2.0;
    D[row.place] += row.root;
    add_to_tangent(D, D, 2.0 * e, row.B, tangent);
  }
}

void QuadraticStrain::calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                                           ModesOut force) const {
  force.array() = linear_.array() * (0.5 * (q0 + q1)).array();
  const Paired p0 = gather(q0);
  const Paired p1 = gather(q1);
  Paired B0(p0.size());
  Paired D(p0.size());  // B p1, then de/dq at the middle
  for (const Row& row : rows_) {
    B0.noalias() = row.B * p0;
    D.noalias() = row.B * p1;
    const double both =
        row.root * (p0[row.place] + p1[row.place]) + p0.dot(B0) + p1.dot(D);
    D += B0;
    D[row.place] += row.root;
    scatter(0.5 * both, D, force);
  }
}

void QuadraticStrain::calc_tangent_over_step(const ModesIn& q0,
                                             const ModesIn& q1,
                                             ModesSquare tangent) const {
  set_linear_tangent(tangent);
  const Paired p0 = gather(q0);
  const Paired p1 = gather(q1);
  Paired middle(p0.size());  // B p0, then de/dq at the middle
  Paired end(p0.size());     // B p1, then de/dq at the end
  for (const Row& row : rows_) {
    middle.noalias() = row.B * p0;
    end.noalias() = row.B * p1;
    const double both = row.root * (p0[row.place] + p1[row.place]) +
                        p0.dot(middle) + p1.dot(end);
    middle += end;
    end *= 2.0;
    middle[row.place] += row.root;
    end[row.place] += row.root;
    add_to_tangent(middle, end, both, row.B, tangent);
  }
}

double QuadraticStrain::lowest_rest_stiffness() const {
  return parameters_.lambda.minCoeff();
}

}  // namespace limber::flexbody
