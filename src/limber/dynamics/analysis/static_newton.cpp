// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/static_newton.hpp"

#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/applied_wrenches.hpp"
#include "limber/dynamics/newton/matrix_free.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Step of force differences, relative to the extents of groups.
constexpr double kProbe = 1e-7;
// Largest correction, likewise.
constexpr double kLongestCorrection = 0.2;
// Tolerance of the linear solution of a correction, and where corrections do
// not decrease: beside large motion of soft coordinates the former can leave
// forces in stiff couplers.
constexpr double kLinear = 1e-4;
constexpr double kFineLinear = 1e-9;
// Forces that balance, relative to those that were left at first.
constexpr double kLeft = 1e-11;
// Above this residual the matrix is singular.
constexpr double kSolved = 0.1;
constexpr int kKrylovVectors = 60;
constexpr int kKrylovIterations = 240;

VectorX collect_laws(const SystemTerms& terms) {
  const auto couplers = std::ssize(terms.couplers);
  VectorX all(6 * couplers + std::ssize(terms.transmissions));
  for (Eigen::Index c = 0; c < couplers; ++c) {
    all.segment<6>(6 * c) =
        terms.couplers[static_cast<std::size_t>(c)].response.wrench;
  }
  for (std::size_t i = 0; i < terms.transmissions.size(); ++i) {
    all[6 * couplers + static_cast<Eigen::Index>(i)] =
        terms.transmissions[i].response.force;
  }
  return all;
}

/// The NewtonMatrix of a slow step, as a preconditioner for Eigen.
class SlowStep {
 public:
  using Solve = std::function<VectorX(const VectorX&)>;
  template <typename Matrix>
  SlowStep& analyzePattern(const Matrix& /*matrix*/) {
    return *this;
  }
  template <typename Matrix>
  SlowStep& factorize(const Matrix& /*matrix*/) {
    return *this;
  }
  template <typename Matrix>
  SlowStep& compute(const Matrix& /*matrix*/) {
    return *this;
  }
  void set(Solve solve) { solve_ = std::move(solve); }
  [[nodiscard]] VectorX solve(const VectorX& right) const {
    return solve_(right);
  }
  [[nodiscard]] static Eigen::ComputationInfo info() { return Eigen::Success; }

 private:
  Solve solve_;
};

}  // namespace

StaticNewton::StaticNewton(const SystemModel& model, const SystemState& start)
    : model_(model),
      lengths_(model, start),
      no_motion_(make_unknowns(model)),
      terms_(make_terms(model)),
      probed_(make_terms(model)),
      matrix_(model),
      residual_(VectorX::Zero(count_unknowns(model))),
      base_(residual_),
      correction_(residual_) {
  slowness_ =
      std::max(lengths_.measure_acceleration(calc_forces_left(start)), 1e-12);
  wrenches_ = laws_;
}

void StaticNewton::evaluate(const SystemState& state, WrenchSource source,
                            SystemTerms& terms, VectorX& residual) const {
  calc_terms(model_, state, Side::right, terms, source);
  calc_residual(model_, no_motion_, terms, residual);
}

const VectorX& StaticNewton::calc_forces_left(const SystemState& state) {
  evaluate(state, WrenchSource::law, terms_, residual_);
  laws_ = collect_laws(terms_);
  return residual_;
}

BodyIndex StaticNewton::most_moved() const {
  BodyIndex most(0);
  double largest = -1.0;
  for (BodyIndex b(0); b < std::ssize(model_.bodies); ++b) {
    const VectorX moved = correction_.cwiseProduct(lengths_.weights());
    double squared = 0.0;
    for (const UnknownRange& range : list_unknowns(model_, index(b))) {
      squared += moved.segment(range.row, range.size).squaredNorm();
    }
    const double mass = model_.bodies[index(b)].mass;
    if (squared / mass > largest) {
      largest = squared / mass;
      most = b;
    }
  }
  return most;
}

/// Change of the residual, with that of the laws' wrenches, per unit of a
/// motion.
VectorX StaticNewton::apply(const SystemState& state,
                            const VectorX& direction) {
  const double length = lengths_.measure(direction);
  if (!(length > 0.0)) return VectorX::Zero(direction.size());
  const double fraction = kProbe / length;
  matrix_.find_wrench_changes(terms_, direction, changes_);
  set_applied(wrenches_ + fraction * changes_, probed_);
  SystemState near = state;
  displace(model_, direction, fraction, near);
  calc_terms(model_, near, Side::right, probed_, WrenchSource::iterate);
  VectorX changed = VectorX::Zero(direction.size());
  calc_residual(model_, no_motion_, probed_, changed);
  return (changed - base_) / fraction;
}

void StaticNewton::factor(const SystemState& state) {
  set_applied(wrenches_, terms_);
  calc_forces(model_, state, Side::right, terms_, WrenchSource::iterate);
  calc_residual(model_, no_motion_, terms_, base_);
  matrix_.factor(model_, state, terms_, no_motion_, {slowness_, 0.0}, true);
  set_applied(laws_, terms_);  // so that it solves for forces only
}

double StaticNewton::measure_slow_step(const SystemState& state) {
  const VectorX left = calc_forces_left(state);
  wrenches_ = laws_;
  factor(state);
  matrix_.solve(model_, terms_, left, correction_);
  return lengths_.measure(correction_);
}

bool StaticNewton::correct(const SystemState& state, const VectorX& right,
                           double tolerance) {
  factor(state);
  // Unknowns are lengths, so that norms are means over groups.
  const VectorX& weights = lengths_.weights();
  const VectorX scale =
      (weights.array() > 0.0).select(weights.cwiseInverse(), 1.0);
  const MatrixFree map(scale.size(), [&](const VectorX& lengths) {
    return apply(state, scale.cwiseProduct(lengths));
  });
  Eigen::GMRES<MatrixFree, SlowStep> solver(map);
  solver.preconditioner().set([&](const VectorX& forces) {
    VectorX increments;
    matrix_.solve(model_, terms_, -forces, increments);
    return VectorX(increments.cwiseQuotient(scale));
  });
  solver.set_restart(std::min<Eigen::Index>(kKrylovVectors, scale.size()));
  solver.setMaxIterations(kKrylovIterations);
  solver.setTolerance(tolerance);
  correction_ = scale.cwiseProduct(VectorX(solver.solve(right)));
  return solver.error() <= kSolved && correction_.allFinite();
}

bool StaticNewton::solve(const VectorX& target, const Settings& settings,
                         SystemState& state) {
  (void)calc_forces_left(state);
  wrenches_ = laws_;
  double last = 0.0;
  double tolerance = kLinear;
  VectorX first;  // forces left of groups
  for (int i = 0; i < settings.max_iterations; ++i) {
    ++iterations_;
    const VectorX right = target - calc_forces_left(state);
    const VectorX forces = lengths_.measure_forces(right);
    if (i == 0) first = forces;
    // Free motion makes the matrix singular: it has no solution for round-off.
    if (i > 0 && (forces.array() <= kLeft * first.array()).all()) return true;
    if (!correct(state, right, tolerance)) return false;
    const double left = lengths_.measure(correction_);
    const double fraction = std::min(1.0, kLongestCorrection / left);
    matrix_.find_wrench_changes(terms_, correction_, changes_);
    wrenches_ += fraction * (laws_ - wrenches_ + changes_);
    displace(model_, correction_, fraction, state);
    if (fraction == 1.0 && left <= settings.tolerance) return true;
    // Round-off: corrections no longer decrease.
    constexpr double kFineLength = 1e-9;
    if (i > 0 && left < kFineLength && left > 0.5 * last) return true;
    if (i > 0 && left > 0.5 * last) tolerance = kFineLinear;
    last = left;
  }
  return false;
}

}  // namespace limber::dynamics
