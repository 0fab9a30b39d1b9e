// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/balanced_truncation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"
#include "limber/common/dense/singular_values.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/analysis/schur_form.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;

/// Decay of an eigenvalue's motion, beyond round-off. For a coordinate and its
/// rate, both zero, round-off is its square root.
struct Decay {
  explicit Decay(const MatrixX& A)
      : noise(100.0 * std::numeric_limits<double>::epsilon() * A.norm()),
        least(10.0 * std::sqrt(noise)) {}
  bool operator()(const Complex& s) const { return !is_free(s) && rate(s) < 0; }
  [[nodiscard]] bool is_free(const Complex& s) const {
    return std::abs(s) <= least;
  }
  [[nodiscard]] bool grows(const Complex& s) const {
    return !is_free(s) && rate(s) > 0;
  }
  [[nodiscard]] int rate(const Complex& s) const {
    constexpr double kUndamped = 1e-9;  // damping ratio
    const double limit = kUndamped * std::abs(s) + noise;
    return s.real() > limit ? 1 : s.real() < -limit ? -1 : 0;
  }
  double noise;  ///< [1/s]
  double least;  ///< [1/s]
};

/// A, B and C of one of two decoupled parts.
struct Part {
  MatrixX A;
  MatrixX B;
  MatrixX C;
};

/// A real orthonormal basis of a space that contains the conjugates of its
/// vectors.
MatrixX find_real_basis(const Eigen::MatrixXcd& Z) {
  MatrixX parts(Z.rows(), 2 * Z.cols());
  parts << Z.real(), Z.imag();
  return dense::find_pivoted_q(parts, 0.0).Q.leftCols(Z.cols());
}

/// Splits a model by invariant subspaces: first motion that does not decay.
std::pair<Part, Part> separate(const LinearModel& model, const SchurForm& form,
                               Index kept) {
  const Index n = model.A.rows();
  const Index rest = n - kept;
  if (kept == 0) {
    return {
        {MatrixX(0, 0), MatrixX(0, model.B.cols()), MatrixX(model.C.rows(), 0)},
        {model.A, model.B, model.C}};
  }
  const Eigen::MatrixXcd X = solve_sylvester(
      form.T.topLeftCorner(kept, kept), form.T.bottomRightCorner(rest, rest),
      -form.T.topRightCorner(kept, rest));
  MatrixX V(n, n);
  V << find_real_basis(form.U.leftCols(kept)),
      find_real_basis(form.U.leftCols(kept) * X + form.U.rightCols(rest));
  const MatrixX A = dense::solve(V, MatrixX(model.A * V));
  const MatrixX B = dense::solve(V, model.B);
  const MatrixX C = model.C * V;
  constexpr double kSeparate = 1e-6;
  if (!(A.topRightCorner(kept, rest).norm() +
            A.bottomLeftCorner(rest, kept).norm() <=
        kSeparate * A.norm())) {
    throw NumericalError(
        "motion that decays cannot be separated from motion that does not: "
        "their eigenvalues are too close to each other");
  }
  return {
      {A.topLeftCorner(kept, kept), B.topRows(kept), C.leftCols(kept)},
      {A.bottomRightCorner(rest, rest), B.bottomRows(rest), C.rightCols(rest)}};
}

/// X, square, of A P + P A' + B B' = 0, P = X X'.
MatrixX find_gramian_root(const MatrixX& A, const MatrixX& B) {
  const Index n = A.rows();
  const SchurForm form = find_schur_form(A);
  const Eigen::MatrixXcd L =
      form.U * find_gramian_factor(form.T, form.U.adjoint() * B);
  MatrixX parts(2 * n, n);  // P = L L*, and real
  parts << L.real().transpose(), L.imag().transpose();
  return dense::find_r(parts).transpose();
}

std::string describe_kept(const SchurForm& form, const Decay& decays) {
  int free = 0;
  int growing = 0;
  int undamped = 0;
  for (const Complex& s : form.T.diagonal()) {
    if (decays(s)) continue;
    ++(decays.is_free(s) ? free : decays.grows(s) ? growing : undamped);
  }
  return fmt::format("{} of free motion, {} undamped, {} growing", free,
                     undamped, growing);
}

void check(const LinearModel& model, const SchurForm& form, const Decay& decays,
           Index kept, Index states) {
  if (model.inputs.empty() || model.outputs.empty()) {
    throw InputError(fmt::format(
        "the model has {} inputs and {} outputs; the importance of states is "
        "measured from inputs to outputs, which needs at least one of each",
        model.inputs.size(), model.outputs.size()));
  }
  const Index n = model.A.rows();
  if (states > n) {
    throw InputError(fmt::format(
        "{} states are requested; the model has only {}", states, n));
  }
  if (states < std::max<Index>(kept, 1)) {
    throw InputError(fmt::format(
        "{} states are requested, but {} of {} do not decay ({}) and cannot be "
        "left out; request at least {}{}",
        states, kept, n, describe_kept(form, decays), std::max<Index>(kept, 1),
        kept > 0 ? ", or give the links damping" : ""));
  }
}

std::vector<LinearSignal> name_truncated_states(Index kept, Index n) {
  std::vector<LinearSignal> states;
  for (Index i = 0; i < n; ++i) {
    states.push_back({i < kept ? fmt::format("kept{}", i + 1)
                               : fmt::format("balanced{}", i + 1 - kept),
                      "", 0.0});
  }
  return states;
}

LinearModel join_parts(const LinearModel& of, const Part& kept,
                       const Part& rest) {
  const Index k = kept.A.rows();
  const Index r = rest.A.rows();
  LinearModel model{MatrixX::Zero(k + r, k + r),
                    MatrixX(k + r, of.B.cols()),
                    MatrixX(of.C.rows(), k + r),
                    of.D,
                    name_truncated_states(k, k + r),
                    of.inputs,
                    of.outputs};
  model.A.topLeftCorner(k, k) = kept.A;
  model.A.bottomRightCorner(r, r) = rest.A;
  model.B.topRows(k) = kept.B;
  model.B.bottomRows(r) = rest.B;
  model.C.leftCols(k) = kept.C;
  model.C.rightCols(r) = rest.C;
  return model;
}

}  // namespace

TruncatedModel truncate_balanced(const LinearModel& model, Index states) {
  const Decay decays(model.A);
  const SchurForm form =
      find_schur_form(model.A, [&](const Complex& s) { return !decays(s); });
  Index kept = 0;
  for (const Complex& s : form.T.diagonal()) kept += decays(s) ? 0 : 1;
  check(model, form, decays, kept, states);
  TruncatedModel out;
  out.kept = kept;
  if (kept == model.A.rows()) {
    out.model = model;
    return out;
  }
  const auto [still, part] = separate(model, form, kept);
  const MatrixX X = find_gramian_root(part.A, part.B);
  const MatrixX Y = find_gramian_root(part.A.transpose(), part.C.transpose());
  const auto svd = dense::find_singular_form(MatrixX(Y.transpose() * X));
  constexpr double kNothing = 1e-13;  // of the largest
  out.hankel = svd.values;
  const double least = out.hankel.size() > 0 ? kNothing * out.hankel[0] : 0.0;
  const Index r =
      std::min<Index>(states - kept, (out.hankel.array() > least).count());
  out.bound = 2.0 * out.hankel.tail(out.hankel.size() - r).sum();
  const VectorX root = out.hankel.head(r).cwiseSqrt().cwiseInverse();
  const MatrixX to = X * svd.V.leftCols(r) * root.asDiagonal();
  const MatrixX from = (Y * svd.U.leftCols(r) * root.asDiagonal()).transpose();
  out.model = join_parts(model, still,
                         {from * part.A * to, from * part.B, part.C * to});
  return out;
}

}  // namespace limber::dynamics
