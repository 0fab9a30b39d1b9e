// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/motion_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/dense/symmetric_eigen.hpp"

namespace limber::results {
namespace {

MatrixX take_snapshots(const FieldColumn& column, std::size_t count) {
  const std::size_t taken = std::min(count, kMostSnapshots);
  MatrixX snapshots;
  for (std::size_t k = 0; k < taken; ++k) {
    const std::size_t i = taken < 2 ? 0 : k * (count - 1) / (taken - 1);
    const VectorX u = column(i);
    if (k == 0) snapshots.resize(u.size(), static_cast<Eigen::Index>(taken));
    snapshots.col(static_cast<Eigen::Index>(k)) = u;
  }
  return snapshots;
}

/// Left singular vectors whose singular values matter, largest first.
MatrixX find_shapes(const MatrixX& snapshots) {
  const auto [squares, directions] =
      dense::find_eigenpairs(MatrixX(snapshots.transpose() * snapshots));
  const Eigen::Index n = squares.size();
  const double least =
      squares[n - 1] * kShapeTolerance * kShapeTolerance * 1e-2;
  MatrixX shapes(snapshots.rows(), 0);
  for (Eigen::Index k = n - 1; k >= 0 && shapes.cols() < kMostShapes; --k) {
    if (!(squares[k] > least)) break;
    shapes.conservativeResize(Eigen::NoChange, shapes.cols() + 1);
    VectorX shape = snapshots * directions.col(k);
    const auto known = shapes.leftCols(shapes.cols() - 1);
    shape -= known * (known.transpose() * shape);
    shapes.rightCols<1>() = shape.normalized();
  }
  return shapes;
}

}  // namespace

double find_largest_length(const VectorX& u) {
  if (u.size() == 0) return 0.0;
  return std::sqrt(
      u.reshaped(3, u.size() / 3).colwise().squaredNorm().maxCoeff());
}

MatrixX find_motion_shapes(const FieldColumn& column, std::size_t count) {
  if (count == 0) return {};
  return find_shapes(take_snapshots(column, count));
}

double find_coordinates(const MatrixX& shapes, const FieldColumn& column,
                        std::size_t count,
                        const std::function<void(const VectorX&)>& take,
                        const std::function<double(const VectorX&)>& size) {
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const VectorX u = column(i);
    const VectorX coordinates = shapes.transpose() * u;
    take(coordinates);
    most = std::max(most, size(u - shapes * coordinates));
  }
  return most;
}

}  // namespace limber::results
