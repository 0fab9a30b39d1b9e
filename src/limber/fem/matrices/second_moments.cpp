// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/matrices/second_moments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

double find_largest_entry(const Eigen::SparseMatrix<double>& A) {
  double largest = 0.0;
  for (int j = 0; j < A.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(A, j); it; ++it)
      largest = std::max(largest, std::abs(it.value()));
  return largest;
}

void check_sum(const MatrixModel& model, const std::string& file) {
  constexpr double kRounding = 1e-6;
  const Eigen::SparseMatrix<double> rest = model.moments[0] + model.moments[1] +
                                           model.moments[2] -
                                           model.mass.entries;
  const double fraction =
      find_largest_entry(rest) / find_largest_entry(model.mass.entries);
  if (fraction <= kRounding) return;
  throw InputError(fmt::format(
      "{}: S_xx + S_yy + S_zz differs from the mass matrix {} by {:.2g} of its "
      "largest entry. Expected second moments of the same mass, with rows in "
      "the same order.",
      file, model.mass.file, fraction));
}

}  // namespace

void take_second_moments(FileSet& set, MatrixModel& model) {
  std::size_t count = 0;
  std::string file;
  const Eigen::Index rows = model.mass.entries.rows();
  for (SourceMatrix& source : set.matrices) {
    if (source.role != MatrixRole::moment) continue;
    file = source.matrix.file;
    Eigen::SparseMatrix<double>& entries = source.matrix.entries;
    if (entries.rows() != rows || entries.cols() != rows)
      throw InputError(fmt::format(
          "{}: {} x {} entries. Expected {} x {}, as the mass matrix has.",
          file, entries.rows(), entries.cols(), rows, rows));
    const int i = find_second_moment(file);
    auto& moment = model.moments[static_cast<std::size_t>(i)];
    if (moment.rows() > 0)
      throw InputError(fmt::format("{}: {} is given twice. Expected one file.",
                                   file, source.name));
    moment = std::move(entries);
    ++count;
  }
  if (count == 0) return;
  if (count != model.moments.size())
    throw InputError(
        fmt::format("{}: {} of six second moments of the mass are given. "
                    "Expected S_xx, S_yy, S_zz, S_xy, S_xz and S_yz, or none.",
                    file, count));
  check_sum(model, file);
}

}  // namespace limber::fem
