// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/elasticity/quadratic_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
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

// Number of pairs treated at once, without allocation.
constexpr Eigen::Index kChunk = 512;
using Chunk = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kChunk, 1>;
// Rows of D that are multiplied at once.
constexpr Eigen::Index kRows = 8;

// Sets of rows that share a pair, and of pairs that share a row.
class Connected {
 public:
  explicit Connected(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) { above_[find(a)] = find(b); }
  [[nodiscard]] std::size_t find(std::size_t a) {
    while (above_[a] != a) a = above_[a] = above_[above_[a]];
    return a;
  }

 private:
  std::vector<std::size_t> above_;
};

// Columns are rows of D = de/dq at p.
using RowsOfD = Eigen::Matrix<double, Eigen::Dynamic, kRows, 0,
                              QuadraticStrain::kMostPaired, kRows>;

}  // namespace

QuadraticStrain::QuadraticStrain(Parameters parameters)
    : parameters_(std::move(parameters)), linear_(parameters_.lambda) {
  check_eigenvalues(parameters_.lambda);
  check_paired(parameters_.paired, size());
  const auto n = static_cast<Eigen::Index>(parameters_.paired.size());
  const MatrixX& Q = parameters_.Q;
  check_shape("the table of quadratic strains", Q, n, n * (n + 1) / 2);
  check_finite("the table of quadratic strains", Q);
  MatrixX& self = parameters_.self;
  if (self.size() == 0) self.resize(0, Q.cols());
  if (self.rows() > kMostPaired - n) {
    throw InputError(fmt::format("{} self-strains; expected at most {}",
                                 self.rows(), kMostPaired - n));
  }
  check_shape("the table of self-strains", self, self.rows(), Q.cols());
  check_finite("the table of self-strains", self);
  blocks_ = find_blocks();
  for (const Block& block : blocks_) {
    for (std::size_t r = 0; r < block.rows.size(); ++r) {
      if (block.roots[static_cast<Eigen::Index>(r)] > 0.0) {
        linear_[mode(block.rows[r])] = 0.0;
      }
    }
  }
}

std::vector<QuadraticStrain::Block> QuadraticStrain::find_blocks() const {
  const Eigen::Index paired = parameters_.Q.rows();
  MatrixX Q(paired + parameters_.self.rows(), parameters_.Q.cols());
  Q << parameters_.Q, parameters_.self;
  const auto rows = static_cast<std::size_t>(Q.rows());
  Connected sets(rows + static_cast<std::size_t>(Q.cols()));
  for (Eigen::Index k = 0; k < Q.cols(); ++k) {
    for (Eigen::Index r = 0; r < Q.rows(); ++r) {
      if (Q(r, k) == 0.0) continue;
      sets.join(static_cast<std::size_t>(r),
                rows + static_cast<std::size_t>(k));
    }
  }
  std::map<std::size_t, Block> found;
  for (std::size_t r = 0; r < rows; ++r) {
    if (Q.row(static_cast<Eigen::Index>(r)).isZero(0.0)) continue;
    found[sets.find(r)].rows.push_back(static_cast<int>(r));
  }
  std::map<std::size_t, std::vector<Eigen::Index>> columns;
  Eigen::Index pair = 0;
  for (int i = 0; i < static_cast<int>(paired); ++i) {
    for (int j = i; j < static_cast<int>(paired); ++j, ++pair) {
      if (Q.col(pair).isZero(0.0)) continue;
      const std::size_t set = sets.find(rows + static_cast<std::size_t>(pair));
      found[set].i.push_back(i);
      found[set].j.push_back(j);
      columns[set].push_back(pair);
    }
  }
  std::vector<Block> blocks;
  for (auto& [set, block] : found) {
    block.Q = Q(block.rows, columns[set]).transpose();
    block.roots.resize(block.Q.cols());
    for (Eigen::Index r = 0; r < block.roots.size(); ++r) {
      int& row = block.rows[static_cast<std::size_t>(r)];
      const bool is_self = row >= paired;
      if (is_self) row = 0;
      block.roots[r] = is_self ? 0.0 : std::sqrt(parameters_.lambda[mode(row)]);
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

QuadraticStrain::Paired QuadraticStrain::gather(const ModesIn& q) const {
  Paired out(std::ssize(parameters_.paired));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = q[mode(i)];
  return out;
}

void QuadraticStrain::scatter(const Paired& forces, ModesOut force) const {
  for (Eigen::Index i = 0; i < forces.size(); ++i) force[mode(i)] += forces[i];
}

QuadraticStrain::Paired QuadraticStrain::find_strains(const Block& block,
                                                      const Paired& p) {
  Paired e(block.roots.size());
  for (Eigen::Index r = 0; r < e.size(); ++r) {
    e[r] = block.roots[r] * p[block.rows[static_cast<std::size_t>(r)]];
  }
  Chunk products;
  for (Eigen::Index first = 0; first < block.Q.rows(); first += kChunk) {
    products.resize(std::min(kChunk, block.Q.rows() - first));
    const int* i = block.i.data() + first;
    const int* j = block.j.data() + first;
    for (Eigen::Index k = 0; k < products.size(); ++k) {
      products[k] = p[i[k]] * p[j[k]];
    }
    // Without the overhead of a general product, which is larger.
    e.noalias() += block.Q.middleRows(first, products.size())
                       .transpose()
                       .lazyProduct(products);
  }
  return e;
}

void QuadraticStrain::add_force(const Block& block, const Paired& p,
                                const Paired& w, Paired& force) {
  for (Eigen::Index r = 0; r < w.size(); ++r) {
    force[block.rows[static_cast<std::size_t>(r)]] += block.roots[r] * w[r];
  }
  Chunk weights;
  for (Eigen::Index first = 0; first < block.Q.rows(); first += kChunk) {
    weights.setZero(std::min(kChunk, block.Q.rows() - first));
    const auto Q = block.Q.middleRows(first, weights.size());
    // Column by column, as in memory: a product by rows would wait for
    // memory.
    Eigen::Index r = 0;
    for (; r + 3 < w.size(); r += 4) {
      weights += w[r] * Q.col(r) + w[r + 1] * Q.col(r + 1) +
                 w[r + 2] * Q.col(r + 2) + w[r + 3] * Q.col(r + 3);
    }
    for (; r < w.size(); ++r) weights += w[r] * Q.col(r);
    const int* i = block.i.data() + first;
    const int* j = block.j.data() + first;
    int row = i[0];  // pairs are in order of i
    double sum = 0.0;
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
      if (i[k] != row) {
        force[row] += sum;
        sum = 0.0;
        row = i[k];
      }
      sum += weights[k] * p[j[k]];
      force[j[k]] += weights[k] * p[row];
    }
    force[row] += sum;
  }
}

double QuadraticStrain::energy(const ModesIn& q) const {
  double sum = (linear_.array() * q.array().square()).sum();
  const Paired p = gather(q);
  for (const Block& block : blocks_)
    sum += find_strains(block, p).squaredNorm();
  return 0.5 * sum;
}

void QuadraticStrain::calc_force(const ModesIn& q, ModesOut force) const {
  force.array() = linear_.array() * q.array();
  if (blocks_.empty()) return;
  const Paired p = gather(q);
  Paired forces = Paired::Zero(p.size());
  for (const Block& block : blocks_) {
    add_force(block, p, find_strains(block, p), forces);
  }
  scatter(forces, force);
}

void QuadraticStrain::calc_force_over_step(const ModesIn& q0, const ModesIn& q1,
                                           ModesOut force) const {
  force.array() = linear_.array() * (0.5 * (q0 + q1)).array();
  if (blocks_.empty()) return;
  const Paired p0 = gather(q0);
  const Paired p1 = gather(q1);
  const Paired middle = 0.5 * (p0 + p1);
  Paired forces = Paired::Zero(p0.size());
  for (const Block& block : blocks_) {
    const Paired mean =
        0.5 * (find_strains(block, p0) + find_strains(block, p1));
    add_force(block, middle, mean, forces);
  }
  scatter(forces, force);
}

void QuadraticStrain::add_tangent(const Block& block, const Paired& a,
                                  const Paired& b, const Paired& w,
                                  ModesSquare tangent) const {
  const Eigen::Index pairs = block.Q.rows();
  const auto find_rows = [&](Eigen::Index first, const Paired& p) {
    RowsOfD D = RowsOfD::Zero(p.size(), kRows);
    const Eigen::Index rows = std::min(kRows, w.size() - first);
    for (Eigen::Index r = 0; r < rows; ++r) {
      D(block.rows[static_cast<std::size_t>(first + r)], r) =
          block.roots[first + r];
    }
    for (Eigen::Index k = 0, n = 0; k < pairs; k += n) {
      // A run of pairs i, j; i, j + 1; ..
      const int* i = block.i.data() + k;
      const int* j = block.j.data() + k;
      n = 1;
      while (k + n < pairs && i[n] == i[0] && j[n] == j[0] + n) ++n;
      for (Eigen::Index r = 0; r < rows; ++r) {
        const auto q = block.Q.col(first + r).segment(k, n);
        D(i[0], r) += q.dot(p.segment(j[0], n));
        D.col(r).segment(j[0], n) += p[i[0]] * q;
      }
    }
    return D;
  };
  Paired sum(a.size());
  for (Eigen::Index first = 0; first < w.size(); first += kRows) {
    const RowsOfD D_a = find_rows(first, a);
    const RowsOfD D_b = &a == &b ? D_a : find_rows(first, b);
    for (Eigen::Index j = 0; j < b.size(); ++j) {
      if (D_b.row(j).isZero(0.0)) continue;
      sum.noalias() = D_a.lazyProduct(D_b.row(j).transpose());
      double* column = tangent.col(mode(j)).data();
      for (Eigen::Index i = 0; i < sum.size(); ++i) column[mode(i)] += sum[i];
    }
  }
  for (Eigen::Index k = 0; k < pairs; ++k) {
    const int i = mode(block.i[static_cast<std::size_t>(k)]);
    const int j = mode(block.j[static_cast<std::size_t>(k)]);
    const double curvature = block.Q.row(k).dot(w);
    tangent(i, j) += curvature;
    tangent(j, i) += curvature;
  }
}

void QuadraticStrain::calc_tangent(const ModesIn& q,
                                   ModesSquare tangent) const {
  tangent.setZero();
  tangent.diagonal() = linear_;
  const Paired p = gather(q);
  for (const Block& block : blocks_) {
    add_tangent(block, p, p, find_strains(block, p), tangent);
  }
}

void QuadraticStrain::calc_tangent_over_step(const ModesIn& q0,
                                             const ModesIn& q1,
                                             ModesSquare tangent) const {
  tangent.setZero();
  tangent.diagonal() = linear_;
  const Paired p0 = gather(q0);
  const Paired p1 = gather(q1);
  const Paired middle = 0.5 * (p0 + p1);
  for (const Block& block : blocks_) {
    const Paired mean =
        0.5 * (find_strains(block, p0) + find_strains(block, p1));
    add_tangent(block, middle, p1, mean, tangent);
  }
}

double QuadraticStrain::lowest_rest_stiffness() const {
  return parameters_.lambda.minCoeff();
}

}  // namespace limber::flexbody
