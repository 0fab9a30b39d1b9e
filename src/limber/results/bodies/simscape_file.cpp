// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <iterator>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/results/bodies/body_coordinates.hpp"
#include "limber/results/bodies/body_files.hpp"
#include "limber/results/mat_file.hpp"

namespace limber::results {
namespace {

/// All motions of the frames, 6B x (6 + m).
MatrixX stack_frames(const std::vector<BodyNode>& frames, Eigen::Index n) {
  MatrixX rows(6 * std::ssize(frames), n);
  for (std::size_t i = 0; i < frames.size(); ++i)
    rows.middleRows<6>(6 * static_cast<Eigen::Index>(i)) = frames[i].rows;
  return rows;
}

/// Orthonormal motions x with A x = 0. @param A rows of one size
MatrixX find_null_space(const MatrixX& A) {
  constexpr double kNone = 1e-14;  // of the largest, squared
  const auto pairs = dense::find_eigenpairs(MatrixX(A.transpose() * A));
  const double largest = pairs.values[pairs.values.size() - 1];
  const Eigen::Index count = (pairs.values.array() < kNone * largest).count();
  const Eigen::Index least = A.cols() - A.rows();
  return pairs.vectors.leftCols(std::max(count, least));
}

/// Rows of the boundary and fixed-interface coordinates in z.
MatrixX find_boundary_coordinates(const flexbody::ReducedBody& body,
                                  const MatrixX& frames) {
  const Eigen::Index n = frames.cols();
  const Eigen::Index b = frames.rows();
  const VectorX scales = find_scales(body);
  VectorX stiffness = VectorX::Zero(n);
  stiffness.tail(n - 6) = body.lambda;
  MatrixX mass = MatrixX::Identity(n, n);
  mass.topLeftCorner<3, 3>() *= body.mass;
  mass.block<3, 3>(3, 3) = body.inertia();
  // Of one size: translations, and rotations times the radius.
  MatrixX sized = frames * scales.asDiagonal();
  for (Eigen::Index i = 0; i < b; ++i)
    if (i % 6 >= 3) sized.row(i) /= scales[3];
  MatrixX N = find_null_space(sized);
  if (N.cols() != n - b)
    throw InputError(fmt::format(
        "body '{}': its {} modes do not let its {} interfaces move "
        "independently. Expected static-deformation modes of each: reduce it "
        "with these interfaces and more modes",
        body.name, n - 6, b / 6));
  N = scales.asDiagonal() * N;
  // Modes at fixed interfaces.
  if (N.cols() > 0) {
    const MatrixX M = N.transpose() * mass * N;
    const auto L = dense::find_cholesky(M);
    LIMBER_EXPECT(L.has_value());
    dense::divide_by_lower_transposed(*L, N);
    const MatrixX K = N.transpose() * stiffness.asDiagonal() * N;
    N = N * dense::find_eigenpairs(MatrixX(0.5 * (K + K.transpose()))).vectors;
  }
  // q = (N^T K N)^-1 N^T K z is zero in constraint modes.
  MatrixX coordinates(n, n);
  const MatrixX NK = N.transpose() * stiffness.asDiagonal();
  coordinates << frames, dense::solve(MatrixX(NK * N), NK);
  return coordinates;
}

}  // namespace

std::string make_simscape_file(const flexbody::ReducedBody& body,
                               double ratio) {
  require_free(body);
  const std::vector<BodyNode> frames = list_frames(body);
  if (frames.empty())
    throw InputError(
        fmt::format("body '{}' has no interface; expected one or more, where "
                    "Simscape attaches it",
                    body.name));
  const Eigen::Index n = 6 + body.lambda.size();
  if (6 * std::ssize(frames) > n)
    throw InputError(fmt::format(
        "body '{}' has {} modes; its {} interfaces need at least {}. Expected "
        "static-deformation modes of each",
        body.name, n - 6, frames.size(), 6 * frames.size() - 6));
  const BodyMatrices made = transform(
      body, find_boundary_coordinates(body, stack_frames(frames, n)), ratio);
  MatFile file;
  MatrixX origins(std::ssize(frames), 3);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    origins.row(static_cast<Eigen::Index>(i)) =
        (frames[i].x_B + body.p_MoBcm_M).transpose();
    names.push_back(frames[i].interface);
  }
  file.add("P", origins);
  file.add("K", made.K);
  file.add("M", made.M);
  file.add("D", made.D);
  file.add("interfaces", names);
  return file.finish();
}

}  // namespace limber::results
