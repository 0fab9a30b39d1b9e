// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/pad_law.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// Below this share of the depth's scale a pad is neither pressed nor free.
constexpr double kNone = 1e-12;

using Vector = PadLaw::Vector;
using Matrix = PadLaw::Matrix;
using Flags = Eigen::Array<bool, Eigen::Dynamic, 1, 0, PadLaw::kMost, 1>;

// The set of pressed pads.
struct Active {
  static Active of(const Flags& flags) {
    Active active;
    for (int i = 0; i < flags.size(); ++i) {
      if (flags[i]) active.at[active.count++] = i;
    }
    return active;
  }
  Eigen::Array<int, PadLaw::kMost, 1> at;
  int count = 0;
};

// Solves for the forces at given depths.
class Pressing {
 public:
  Pressing(const Matrix& C, const Vector& depth) : C_(C), depth_(depth) {}

  void find(Flags& active, Vector& force) const {
    active = depth_.array() > 0.0;
    if (!find_by_sets(active, force)) find_one_by_one(active, force);
  }
  // The inverse for the active pads.
  void invert(const Flags& flags, Matrix& out) const {
    const Active active = Active::of(flags);
    if (active.count == 0) return;
    const Matrix inverse =
        factor(active).solve(Matrix::Identity(active.count, active.count));
    for (int i = 0; i < active.count; ++i) {
      for (int j = 0; j < active.count; ++j) {
        out(active.at[i], active.at[j]) = inverse(i, j);
      }
    }
  }

 private:
  [[nodiscard]] Eigen::LLT<Matrix> factor(const Active& active) const {
    Matrix C(active.count, active.count);
    for (int i = 0; i < active.count; ++i) {
      for (int j = 0; j < active.count; ++j) {
        C(i, j) = C_(active.at[i], active.at[j]);
      }
    }
    return Eigen::LLT<Matrix>(C);
  }

  // Forces of the active pads only, of any sign.
  [[nodiscard]] Vector solve(const Flags& flags) const {
    Vector force = Vector::Zero(depth_.size());
    const Active active = Active::of(flags);
    if (active.count == 0) return force;
    Vector d(active.count);
    for (int i = 0; i < active.count; ++i) d[i] = depth_[active.at[i]];
    factor(active).solveInPlace(d);
    for (int i = 0; i < active.count; ++i) force[active.at[i]] = d[i];
    return force;
  }

  bool find_by_sets(Flags& active, Vector& force) const {
    constexpr int kMostSets = 20;
    for (int i = 0; i < kMostSets; ++i) {
      force = solve(active);
      const Vector left = depth_ - C_ * force;
      const Flags next = active.select(force.array() > 0.0, left.array() > 0.0);
      if ((next == active).all()) return true;
      active = next;
    }
    return false;
  }

  void find_one_by_one(Flags& active, Vector& force) const;

  const Matrix& C_;
  const Vector& depth_;
};

void Pressing::find_one_by_one(Flags& active, Vector& force) const {
  const double least = kNone * depth_.cwiseAbs().maxCoeff();
  active.setConstant(false);
  force.setZero();
  for (int added = 0; added < 4 * PadLaw::kMost; ++added) {
    const Vector left = depth_ - C_ * force;
    int next = -1;
    double most = least;
    for (int i = 0; i < depth_.size(); ++i) {
      if (active[i] || left[i] <= most) continue;
      next = i;
      most = left[i];
    }
    if (next < 0) return;
    active[next] = true;
    while (true) {
      const Vector trial = solve(active);
      double share = 1.0;
      int gone = -1;
      for (int i = 0; i < depth_.size(); ++i) {
        if (!active[i] || trial[i] > 0.0) continue;
        const double until = force[i] / (force[i] - trial[i]);
        if (gone >= 0 && until >= share) continue;
        share = until;
        gone = i;
      }
      if (gone < 0) {
        force = trial;
        break;
      }
      force += share * (trial - force);
      force[gone] = 0.0;
      active[gone] = false;
    }
  }
}

}  // namespace

PadLaw::PadLaw(const MatrixX& compliance, double common) {
  if (compliance.rows() < 1 || compliance.rows() > kMost ||
      compliance.cols() != compliance.rows() || !compliance.allFinite()) {
    throw InputError("contact: the flexibility of its pads has no valid size");
  }
  C_ = compliance;
  const Eigen::LLT<Matrix> factor(C_);
  if (factor.info() != Eigen::Success) {
    throw InputError(
        "contact: the flexibility of its pads is not positive definite");
  }
  uniform_ = factor.solve(Vector::Ones(C_.rows()));
  uniform_ /= 1.0 + common * uniform_.sum();  // Sherman and Morrison
  total_ = uniform_.sum();
  uniform_ = uniform_.cwiseMax(0.01 * total_ / static_cast<double>(C_.rows()));
}

void PadLaw::evaluate(const Vector& depth, Response& out) const {
  evaluate(depth, Matrix::Zero(C_.rows(), C_.rows()), out);
}

void PadLaw::evaluate(const Vector& depth, const Matrix& added,
                      Response& out) const {
  LIMBER_EXPECT(depth.size() == C_.rows() && added.rows() == C_.rows());
  const auto k = depth.size();
  out.force.setZero(k);
  out.stiffness.setZero(k, k);
  out.energy = 0.0;
  if (!depth.allFinite()) {
    out.force.setConstant(std::nan(""));
    return;
  }
  if (!(depth.maxCoeff() > 0.0)) return;
  const Matrix C = C_ + added;
  const Pressing pressing(C, depth);
  Flags active;
  pressing.find(active, out.force);
  out.energy = 0.5 * out.force.dot(C * out.force);
  pressing.invert(active, out.stiffness);
}

MatrixX calc_half_space_compliance(const Matrix3X& places, const VectorX& area,
                                   double modulus) {
  const Eigen::Index k = places.cols();
  MatrixX C(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < k; ++j) {
      const double r = (places.col(i) - places.col(j)).norm();
      C(i, j) = i == j
                    ? 16.0 / (3.0 * std::numbers::pi * std::numbers::pi *
                              modulus * std::sqrt(area[i] / std::numbers::pi))
                    : 1.0 / (std::numbers::pi * modulus * r);
    }
  }
  return C;
}

}  // namespace limber::contact
