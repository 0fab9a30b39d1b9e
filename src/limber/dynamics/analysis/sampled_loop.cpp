// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/sampled_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "limber/common/dense/exponential.hpp"
#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

constexpr double kSameRatio = 1e-9;    // relative
constexpr int kMostPeriods = 64;       // of the longest in the common one
constexpr double kMostWork = 5e8;      // samples of a period x size^3
constexpr double kLeastGrowth = 1e-5;  // in a common period
constexpr double kMatters = 0.5;       // of the largest sensitivity
constexpr double kOwn = 0.1;           // sensitivity / growth in a period

bool is_whole(double ratio) {
  return std::abs(ratio - std::round(ratio)) < kSameRatio * ratio;
}

double find_common_period(const std::vector<LoopController>& controllers) {
  double longest = 0.0;
  for (const auto& c : controllers) longest = std::max(longest, c.period);
  for (int q = 1; q <= kMostPeriods; ++q) {
    const double common = q * longest;
    if (std::all_of(controllers.begin(), controllers.end(), [&](const auto& c) {
          return is_whole(common / c.period);
        })) {
      return common;
    }
  }
  throw InputError(fmt::format(
      "the periods of the controllers have no common multiple within {} of the "
      "longest, {:g} s",
      kMostPeriods, longest));
}

// The left eigenvector w of w^H A = pole w^H, by inverse iteration.
Eigen::VectorXcd find_left_vector(const MatrixX& A, std::complex<double> pole) {
  constexpr double kApart = 1e-10;
  Eigen::MatrixXcd shifted = A.transpose().cast<std::complex<double>>();
  shifted.diagonal().array() -= std::conj(pole) * (1.0 + kApart);
  Eigen::MatrixXcd w = Eigen::MatrixXcd::Ones(A.rows(), 1);
  for (int i = 0; i < 3; ++i) {
    w = dense::solve(shifted, w);
    w /= w.norm();
  }
  return w;
}

}  // namespace

SampledLoop::SampledLoop(const LinearModel& plant,
                         std::vector<LoopController> controllers,
                         const std::optional<LoopSteps>& steps)
    : plant_(plant), controllers_(std::move(controllers)) {
  LIMBER_EXPECT(!controllers_.empty());
  if (steps) {
    steps_.emplace(plant_.A, steps->coordinates, steps->parameters,
                   steps->longest);
  }
  period_ = find_common_period(controllers_);
  find_layout();
  find_samples();
}

void SampledLoop::find_layout() {
  Index states = 0;
  for (const LoopController& c : controllers_) {
    first_written_.push_back(std::ssize(written_));
    written_.insert(written_.end(), c.writes.begin(), c.writes.end());
    first_law_.push_back(states);
    states += c.law.F.rows();
  }
  for (Index j = 0; j < plant_.B.cols(); ++j) {
    const bool is_written = std::any_of(
        written_.begin(), written_.end(),
        [&](const LoopInput& i) { return i.value == j || i.rate == j; });
    if (!is_written) external_.push_back(j);
  }
  const Index written = std::ssize(written_);
  at_.inputs = plant_.A.rows() + (steps_ ? steps_->memory_size(written) : 0);
  at_.slopes = at_.inputs + written;
  at_.laws = at_.slopes + written;
  at_.external = at_.laws + states;
  at_.references = at_.external + std::ssize(external_);
  at_.size = at_.references + std::ssize(controllers_);
}

// In the period that begins with a sample of the first controller.
void SampledLoop::find_samples() {
  const double same = kSameRatio * period_;
  std::vector<std::pair<double, std::size_t>> all;
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const LoopController& c = controllers_[i];
    const double shift = c.offset - controllers_[0].offset;
    double first = shift - std::floor(shift / c.period) * c.period;
    if (c.period - first < same) first = 0.0;
    const auto count = std::lround(period_ / c.period);
    for (long k = 0; k < count; ++k) {
      all.emplace_back(first + static_cast<double>(k) * c.period, i);
    }
  }
  std::sort(all.begin(), all.end());
  for (const auto& [time, controller] : all) {
    if (samples_.empty() || time - samples_.back().time > same) {
      samples_.push_back({time, {}});
    }
    samples_.back().controllers.push_back(controller);
  }
  const auto size = static_cast<double>(at_.size);
  if (static_cast<double>(samples_.size()) * size * size * size > kMostWork &&
      samples_.size() > 1) {
    throw InputError(fmt::format(
        "{} samples of the controllers within {:g} s, the common multiple of "
        "their periods, are too many for a loop of {} states",
        samples_.size(), period_, at_.size));
  }
}

const MatrixX& SampledLoop::find_flow(double duration) {
  const auto known =
      std::find_if(flows_.begin(), flows_.end(), [&](const auto& flow) {
        return std::abs(flow.first - duration) < kSameRatio * duration;
      });
  if (known != flows_.end()) return known->second;
  // States, inputs, slopes, and external inputs; all else stays.
  const Index moving = at_.laws;
  const MatrixX E =
      steps_ ? find_stepped_flow(duration) : find_exact_flow(duration);
  MatrixX flow = MatrixX::Identity(at_.size, at_.size);
  flow.topLeftCorner(moving, moving) = E.topLeftCorner(moving, moving);
  flow.block(0, at_.external, moving, E.cols() - moving) =
      E.topRightCorner(moving, E.cols() - moving);
  return flows_.emplace(duration, std::move(flow)).first->second;
}

MatrixX SampledLoop::find_external_inputs() const {
  MatrixX columns(plant_.B.rows(), std::ssize(external_));
  for (std::size_t i = 0; i < external_.size(); ++i) {
    columns.col(static_cast<Index>(i)) = plant_.B.col(external_[i]);
  }
  return columns;
}

MatrixX SampledLoop::find_exact_flow(double duration) const {
  const Index size = at_.laws + std::ssize(external_);
  MatrixX M = MatrixX::Zero(size, size);
  M.topLeftCorner(at_.inputs, at_.inputs) = plant_.A;
  for (std::size_t i = 0; i < written_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const LoopInput& input = written_[i];
    M.col(at_.inputs + k).head(at_.inputs) = plant_.B.col(input.value);
    if (input.hold == InputHold::held) continue;
    M(at_.inputs + k, at_.slopes + k) = 1.0;
    if (input.rate < 0) continue;
    M.col(at_.slopes + k).head(at_.inputs) = plant_.B.col(input.rate);
  }
  M.topRightCorner(at_.inputs, std::ssize(external_)) = find_external_inputs();
  return dense::Exponential(size)(M * duration);
}

// A held input has the slope 0.
MatrixX SampledLoop::find_stepped_flow(double duration) const {
  SteppedMotion::Inputs inputs;
  inputs.by_value = inputs.by_slope =
      MatrixX::Zero(plant_.B.rows(), std::ssize(written_));
  for (std::size_t i = 0; i < written_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    inputs.by_value.col(k) = plant_.B.col(written_[i].value);
    if (written_[i].rate < 0) continue;
    inputs.by_slope.col(k) = plant_.B.col(written_[i].rate);
  }
  inputs.by_steady = find_external_inputs();
  return steps_->find_flow(inputs, duration);
}

// The plant's outputs by the joint state, before a sample.
MatrixX SampledLoop::find_outputs() const {
  MatrixX rows = MatrixX::Zero(plant_.C.rows(), at_.size);
  rows.leftCols(plant_.C.cols()) = plant_.C;
  for (std::size_t i = 0; i < written_.size(); ++i) {
    const auto k = static_cast<Index>(i);
    rows.col(at_.inputs + k) = plant_.D.col(written_[i].value);
    if (written_[i].rate < 0) continue;
    rows.col(at_.slopes + k) = plant_.D.col(written_[i].rate);
  }
  for (std::size_t i = 0; i < external_.size(); ++i) {
    rows.col(at_.external + static_cast<Index>(i)) = plant_.D.col(external_[i]);
  }
  return rows;
}

MatrixX SampledLoop::find_seen(std::size_t controller,
                               const MatrixX& outputs) const {
  const LoopController& c = controllers_[controller];
  const Index reference = std::ssize(c.measures);
  MatrixX seen = MatrixX::Zero(reference + 2, at_.size);
  for (Index m = 0; m < reference; ++m) {
    seen.row(m) = outputs.row(c.measures[static_cast<std::size_t>(m)]);
  }
  seen(reference, at_.references + static_cast<Index>(controller)) = 1.0;
  for (std::size_t i = 0; i < written_.size(); ++i) {
    if (written_[i].value != c.reference.input) continue;
    const auto k = static_cast<Index>(i);
    seen(reference, at_.inputs + k) = c.reference.factor;
    seen(reference + 1, at_.slopes + k) = c.reference.factor;
  }
  return seen;
}

MatrixX SampledLoop::find_jump(const Sample& sample, std::size_t scaled,
                               double gain) const {
  const MatrixX outputs = find_outputs();
  MatrixX jump = MatrixX::Identity(at_.size, at_.size);
  for (const std::size_t i : sample.controllers) {
    const LoopController& c = controllers_[i];
    const Index n = c.law.F.rows();
    const Index first = at_.laws + first_law_[i];
    const MatrixX seen = find_seen(i, outputs);
    MatrixX own = MatrixX::Zero(n, at_.size);
    own.middleCols(first, n).setIdentity();
    const double factor = i == scaled ? gain : 1.0;
    const MatrixX u = factor * (c.law.H * own + c.law.J * seen);
    jump.middleRows(first, n) = c.law.F * own + c.law.G * seen;
    for (std::size_t w = 0; w < c.writes.size(); ++w) {
      const Index row = first_written_[i] + static_cast<Index>(w);
      const auto to = u.row(static_cast<Index>(w));
      if (c.writes[w].hold == InputHold::held) {
        jump.row(at_.inputs + row) = to;
        jump.row(at_.slopes + row).setZero();
        continue;
      }
      jump.row(at_.slopes + row) = to / c.period;
      jump(at_.slopes + row, at_.inputs + row) -= 1.0 / c.period;
    }
  }
  return jump;
}

MatrixX SampledLoop::find_transition(std::size_t scaled, double gain) {
  MatrixX transition = MatrixX::Identity(at_.size, at_.size);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double next =
        i + 1 < samples_.size() ? samples_[i + 1].time : period_;
    transition = find_jump(samples_[i], scaled, gain) * transition;
    transition = find_flow(next - samples_[i].time) * transition;
  }
  return transition;
}

LinearModel SampledLoop::find_model() {
  const MatrixX transition = find_transition();
  const MatrixX outputs = find_outputs();
  const Index n = at_.external;
  LinearModel model{transition.topLeftCorner(n, n),
                    transition.topRightCorner(n, at_.size - n),
                    outputs.leftCols(n),
                    outputs.rightCols(at_.size - n),
                    plant_.states,
                    {},
                    plant_.outputs};
  std::vector<LinearSignal> slopes;
  for (const LoopInput& input : written_) {
    const LinearSignal& signal =
        plant_.inputs[static_cast<std::size_t>(input.value)];
    model.states.push_back(signal);
    slopes.push_back({signal.name + ".rate", signal.unit + "/s", 0.0});
  }
  model.states.insert(model.states.end(), slopes.begin(), slopes.end());
  for (const LoopController& c : controllers_) {
    for (Index i = 0; i < c.law.F.rows(); ++i) {
      model.states.push_back(
          {fmt::format("{}.state_{}", c.name, i + 1), "", 0.0});
    }
  }
  for (const Index j : external_) {
    model.inputs.push_back(plant_.inputs[static_cast<std::size_t>(j)]);
  }
  for (const LoopController& c : controllers_) {
    model.inputs.push_back({c.name + ".reference", "", c.reference_value});
  }
  return model;
}

// w^H (dA / d gain) v / w^H v
std::vector<double> SampledLoop::find_sensitivities(const MatrixX& A,
                                                    const Eigen::VectorXcd& v,
                                                    std::complex<double> pole) {
  constexpr double kGain = 1e-4;
  const Eigen::VectorXcd w = find_left_vector(A, pole);
  std::vector<double> moves;
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const MatrixX change =
        find_transition(i, 1.0 + kGain).topLeftCorner(A.rows(), A.rows()) - A;
    moves.push_back(std::abs(w.dot(change * v) / w.dot(v)) / kGain);
  }
  return moves;
}

std::optional<SampledLoop::Instability> SampledLoop::find_instability() {
  const Index n = at_.external;
  const MatrixX A = find_transition().topLeftCorner(n, n);
  const auto is_unstable = [](const std::complex<double>& pole) {
    return !(std::abs(pole) <= 1.0 + kLeastGrowth);
  };
  const Eigen::VectorXcd poles =
      dense::find_general_eigenpairs(A, false).values;
  if (std::none_of(poles.begin(), poles.end(), is_unstable)) {
    return std::nullopt;
  }
  const dense::GeneralEigenpairs pairs =
      dense::find_general_eigenpairs(A, true);
  std::vector<Index> order;
  for (Index i = 0; i < n; ++i) {
    if (is_unstable(pairs.values[i]) && pairs.values[i].imag() >= 0.0) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(pairs.values[a]) > std::abs(pairs.values[b]);
  });
  for (const Index i : order) {
    const std::complex<double> pole = pairs.values[i];
    const std::vector<double> moves =
        find_sensitivities(A, pairs.vectors.col(i), pole);
    const double most = *std::max_element(moves.begin(), moves.end());
    if (most < kOwn * (std::abs(pole) - 1.0)) continue;
    Instability found{
        pole,
        std::log(std::abs(pole)) / period_,
        std::abs(std::arg(pole)) / (2.0 * std::numbers::pi * period_),
        {}};
    for (std::size_t c = 0; c < moves.size(); ++c) {
      if (moves[c] >= kMatters * most) found.loops.push_back(c);
    }
    return found;
  }
  return std::nullopt;
}

}  // namespace limber::dynamics
