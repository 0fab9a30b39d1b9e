// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/slices/surface_division.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/reduction/slices/slice_motion.hpp"

namespace limber::flexbody {
namespace {

// Coordinates of each sample along the axes.
Matrix3X list_places(const std::vector<SurfaceSample>& samples,
                     const Matrix3& axes) {
  Matrix3X places(3, std::ssize(samples));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    places.col(static_cast<Eigen::Index>(i)) = axes.transpose() * samples[i].x;
  }
  return places;
}

Matrix3 find_axes(const std::vector<SurfaceSample>& samples) {
  double area = 0.0;
  Vector3 first = Vector3::Zero();
  for (const SurfaceSample& s : samples) {
    area += s.area;
    first += s.area * s.x;
  }
  const Vector3 centre = first / area;
  Matrix3 second = Matrix3::Zero();
  for (const SurfaceSample& s : samples) {
    const Vector3 r = s.x - centre;
    second += s.area * r * r.transpose();
  }
  Matrix3 axes = dense::find_eigenpairs(second).vectors;
  if (axes.determinant() < 0.0) axes.col(2) *= -1.0;
  return axes;
}

/// A box, and the samples within it.
struct Cell {
  Vector3 low;
  Vector3 high;
  std::vector<Eigen::Index> samples;
  double own = 0.0;  // what its own deformation has of the flexibility

  [[nodiscard]] int find_longest() const {
    const Vector3 extent = high - low;
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if (extent[k] > (1.0 + 1e-6) * extent[longest]) longest = k;
    }
    return longest;
  }
};

class Division {
 public:
  Division(const std::vector<SurfaceSample>& samples, const VectorX& lambda,
           const MatrixX& Phi, double modulus)
      : samples_(samples),
        lambda_(lambda),
        modulus_(modulus),
        Phi_(Phi.leftCols(lambda.size())),
        axes_(find_axes(samples)),
        places_(list_places(samples, axes_)),
        heights_(lambda.size(), std::ssize(samples)) {
    for (Eigen::Index i = 0; i < heights_.cols(); ++i) {
      const SurfaceSample& s = samples_[static_cast<std::size_t>(i)];
      heights_.col(i) = find_heights(s, Phi_, lambda.size(), s.normal);
      all_ += s.area * weigh(heights_.col(i));
    }
  }

  [[nodiscard]] SurfaceDivision run(std::size_t most) {
    Cell whole{places_.rowwise().minCoeff(), places_.rowwise().maxCoeff(), {}};
    for (Eigen::Index i = 0; i < places_.cols(); ++i)
      whole.samples.push_back(i);
    whole.own = find_own(whole);
    low_ = whole.low;
    high_ = whole.high;
    cells_ = {std::move(whole)};
    while (find_all_own() > kMostDeformation * all_ && refine(most)) {
    }
    SurfaceDivision division{axes_, {}};
    for (const Cell& cell : cells_) division.slices.push_back(make(cell));
    return division;
  }

 private:
  // sum u_k^2 / lambda_k
  [[nodiscard]] double weigh(const VectorX& u) const {
    return u.cwiseAbs2().cwiseQuotient(lambda_).sum();
  }

  [[nodiscard]] std::vector<const SurfaceSample*> list_samples(
      const Cell& cell) const {
    std::vector<const SurfaceSample*> list;
    for (const Eigen::Index i : cell.samples) {
      list.push_back(&samples_[static_cast<std::size_t>(i)]);
    }
    return list;
  }

  [[nodiscard]] double find_own(const Cell& cell) const {
    const SliceMotion slice(list_samples(cell));
    const MatrixX motion = slice.find_motion(Phi_);
    double own = 0.0;
    for (const Eigen::Index i : cell.samples) {
      const SurfaceSample& s = samples_[static_cast<std::size_t>(i)];
      const Vector3 r = s.x - slice.centre();
      const VectorX fit =
          motion.topRows<3>().transpose() * s.normal +
          motion.bottomRows<3>().transpose() * r.cross(s.normal);
      own += s.area * weigh(heights_.col(i) - fit);
    }
    return own;
  }

  // Whether its own deformation is more than what a flat of a sixth of its
  // area, as a cube has, is pressed into its half space.
  [[nodiscard]] bool is_soft(const Cell& cell) const {
    constexpr double kMost = 4.0;
    double area = 0.0;
    for (const Eigen::Index i : cell.samples) {
      area += samples_[static_cast<std::size_t>(i)].area;
    }
    const double a = std::sqrt(area / (6.0 * std::numbers::pi));
    return cell.own / area > kMost / (2.0 * modulus_ * a);
  }

  [[nodiscard]] double find_all_own() const {
    double own = 0.0;
    for (const Cell& cell : cells_) own += cell.own;
    return own;
  }

  // Halves the soft cells that deform at least half as much as the worst one,
  // so that symmetric bodies have symmetric cells.
  // @return whether there are any and the number allows it
  bool refine(std::size_t most) {
    constexpr double kAlike = 0.5;
    double worst = 0.0;
    for (const Cell& cell : cells_) {
      if (is_soft(cell)) worst = std::max(worst, cell.own);
    }
    if (worst == 0.0) return false;
    std::vector<Cell> next;
    for (const Cell& cell : cells_) {
      if (cell.own < kAlike * worst || !is_soft(cell)) {
        next.push_back(cell);
        continue;
      }
      for (Cell& half : halve(cell)) {
        if (half.samples.empty()) continue;
        half.own = find_own(half);
        next.push_back(std::move(half));
      }
    }
    if (next.size() > most) return false;
    cells_ = std::move(next);
    return true;
  }

  [[nodiscard]] std::array<Cell, 2> halve(const Cell& cell) const {
    const int k = cell.find_longest();
    const double middle = 0.5 * (cell.low[k] + cell.high[k]);
    std::array<Cell, 2> halves{Cell{cell.low, cell.high, {}},
                               Cell{cell.low, cell.high, {}}};
    halves[0].high[k] = middle;
    halves[1].low[k] = middle;
    for (const Eigen::Index i : cell.samples) {
      halves[places_(k, i) < middle ? 0 : 1].samples.push_back(i);
    }
    return halves;
  }

  [[nodiscard]] SurfaceSlice make(const Cell& cell) const {
    SurfaceSlice slice{list_samples(cell), Matrix3X(3, 0), VectorX(0)};
    const auto add = [&](const Vector3& n, double h) {
      const Eigen::Index k = slice.heights.size();
      slice.normals.conservativeResize(Eigen::NoChange, k + 1);
      slice.heights.conservativeResize(k + 1);
      slice.normals.col(k) = n;
      slice.heights[k] = h;
    };
    for (int k = 0; k < 3; ++k) {
      if (cell.low[k] > low_[k]) add(-axes_.col(k), -cell.low[k]);
      if (cell.high[k] < high_[k]) add(axes_.col(k), cell.high[k]);
    }
    return slice;
  }

  const std::vector<SurfaceSample>& samples_;
  const VectorX& lambda_;
  double modulus_;
  MatrixX Phi_;
  Matrix3 axes_;
  Matrix3X places_;
  MatrixX heights_;  // of each mode at each sample
  double all_ = 0.0;
  Vector3 low_ = Vector3::Zero();
  Vector3 high_ = Vector3::Zero();
  std::vector<Cell> cells_;
};

}  // namespace

SurfaceDivision divide_surface(const std::vector<SurfaceSample>& samples,
                               const VectorX& lambda, const MatrixX& Phi,
                               double modulus, std::size_t most) {
  return Division(samples, lambda, Phi, modulus).run(most);
}

}  // namespace limber::flexbody
