// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/fourier.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/dense/qr.hpp"
#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

void check_table(const LoadTable& table, int harmonics) {
  auto problems = find_time_problems(table.times, 2, "load table");
  if (table.values.cols() != std::ssize(table.times)) {
    problems.push_back(fmt::format("load table: {} times but {} columns",
                                   table.times.size(), table.values.cols()));
  }
  const auto more = find_value_problems(table.values, "load table");
  problems.insert(problems.end(), more.begin(), more.end());
  if (harmonics < 0 || 2 * harmonics + 1 > std::ssize(table.times) - 1) {
    problems.push_back(fmt::format(
        "load table: {} times cannot determine {} harmonics; expected "
        "0 <= harmonics <= (times - 2) / 2 (the last time repeats the first)",
        table.times.size(), harmonics));
  }
  refuse(std::move(problems));
}

// Columns: 1, cos(w t), sin(w t), cos(2 w t), ... at the angles w t.
MatrixX make_waves(const VectorX& angles, Eigen::Index harmonics) {
  MatrixX waves(angles.size(), 2 * harmonics + 1);
  waves.col(0).setOnes();
  for (Eigen::Index k = 1; k <= harmonics; ++k) {
    const double order = static_cast<double>(k);
    waves.col(2 * k - 1) = (order * angles).array().cos();
    waves.col(2 * k) = (order * angles).array().sin();
  }
  return waves;
}

// Reduced to one period first, so that late times keep their digits.
VectorX find_angles(const std::vector<double>& times, double start,
                    double period) {
  VectorX angles(std::ssize(times));
  for (Eigen::Index i = 0; i < angles.size(); ++i) {
    const double since = times[static_cast<std::size_t>(i)] - start;
    angles[i] = 2.0 * std::numbers::pi * (std::fmod(since, period) / period);
  }
  return angles;
}

// Fractions of the period, which sum to one.
VectorX find_weights(const std::vector<double>& times) {
  const Eigen::Map<const VectorX> t(times.data(), std::ssize(times));
  const Eigen::Index intervals = t.size() - 1;
  const VectorX spacing = t.tail(intervals) - t.head(intervals);
  VectorX weights = VectorX::Zero(t.size());
  weights.head(intervals) += 0.5 * spacing;
  weights.tail(intervals) += 0.5 * spacing;
  return weights / (t[intervals] - t[0]);
}

MatrixX find_coefficients(const MatrixX& A, const MatrixX& b) {
  auto [x, rank] = dense::solve_least_squares(A, b, 1.0 / kMostAmplification);
  if (rank < A.cols()) {
    throw InputError(
        fmt::format("load table: its times are too unevenly spaced for {} "
                    "harmonics, of which they determine only {} of {} "
                    "coefficients; use fewer harmonics or fill the gaps",
                    (A.cols() - 1) / 2, rank, A.cols()));
  }
  return x;
}

}  // namespace

FourierSeries fit_fourier_series(const LoadTable& table, int harmonics) {
  check_table(table, harmonics);
  const double start = table.times.front();
  const double period = table.times.back() - start;
  const VectorX root = find_weights(table.times).cwiseSqrt();
  const MatrixX A =
      root.asDiagonal() *
      make_waves(find_angles(table.times, start, period), harmonics);
  const MatrixX b = root.asDiagonal() * table.values.transpose();
  const MatrixX x = find_coefficients(A, b);

  FourierSeries series{start, period, {}, {}, {}};
  series.cosine.resize(table.values.rows(), harmonics + 1);
  series.sine.setZero(table.values.rows(), harmonics + 1);
  series.cosine.col(0) = x.row(0).transpose();
  for (Eigen::Index k = 1; k <= harmonics; ++k) {
    series.cosine.col(k) = x.row(2 * k - 1).transpose();
    series.sine.col(k) = x.row(2 * k).transpose();
  }
  series.residual = (b - A * x).colwise().norm().transpose();
  return series;
}

MatrixX evaluate(const FourierSeries& series,
                 const std::vector<double>& times) {
  const Eigen::Index harmonics = series.cosine.cols() - 1;
  const MatrixX waves =
      make_waves(find_angles(times, series.start, series.period), harmonics);
  MatrixX values =
      series.cosine.col(0) * Eigen::RowVectorXd::Ones(std::ssize(times));
  for (Eigen::Index k = 1; k <= harmonics; ++k) {
    values += series.cosine.col(k) * waves.col(2 * k - 1).transpose() +
              series.sine.col(k) * waves.col(2 * k).transpose();
  }
  return values;
}

std::vector<SinusoidalLoad> make_sinusoids(const FourierSeries& series,
                                           double until) {
  std::vector<SinusoidalLoad> loads;
  for (Eigen::Index k = 0; k < series.cosine.cols(); ++k) {
    const double turns = static_cast<double>(k) / series.period;
    loads.push_back({.omega = 2.0 * std::numbers::pi * turns,
                     .cosine = series.cosine.col(k),
                     .sine = series.sine.col(k),
                     .from = series.start,
                     .until = until});
  }
  return loads;
}

}  // namespace limber::flexbody
