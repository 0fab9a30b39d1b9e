// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "limber/flexbody/modal/modal_response.hpp"

namespace limber::flexbody {
namespace {

// Gauss-Legendre, five points on [0, 1] (Abramowitz and Stegun, table 25.4).
constexpr std::array<double, 5> kPoints = {
    0.046910077030668004, 0.23076534494715845, 0.5, 0.7692346550528415,
    0.95308992296933200};
constexpr std::array<double, 5> kWeights = {
    0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
    0.23931433524968324, 0.11846344252809454};

// Largest change of phase over a panel: the rule is then accurate to 1e-10.
constexpr double kPanelPhase = 1.0;

}  // namespace

ModalLosses ModalResponse::evaluate_losses(
    const std::vector<double>& times) const {
  ModalLosses losses{evaluate_step_work(times), make_zeros(times)};
  const bool is_any_damped = std::any_of(
      modes_.begin(), modes_.end(),
      [](const ModalOscillator& mode) { return mode.damping() > 0.0; });
  if (!is_any_damped && waves_.empty()) return losses;
  const MatrixX start = find_energy({starts_.front()});
  const MatrixX gain = find_energy(times).colwise() - VectorX(start.col(0));
  MatrixX integral;
  for (Eigen::Index k = 0; k < modes(); ++k) {
    const bool is_damped = modes_[static_cast<std::size_t>(k)].damping() > 0.0;
    if (is_driven_by_wave(k)) {
      if (is_damped) {
        if (integral.size() == 0) integral = integrate_dissipation(times);
        losses.dissipated.row(k) = integral.row(k);
      }
      losses.work.row(k) = gain.row(k) + losses.dissipated.row(k);
    } else if (is_damped) {
      losses.dissipated.row(k) = losses.work.row(k) - gain.row(k);
    }
  }
  return losses;
}

bool ModalResponse::is_driven_by_wave(Eigen::Index mode) const {
  return std::any_of(waves_.begin(), waves_.end(), [&](const Wave& wave) {
    return wave.amplitude[mode] != 0.0;
  });
}

MatrixX ModalResponse::find_energy(const std::vector<double>& times) const {
  const ModalEnergies energies = evaluate_energies(times);
  return energies.kinetic + energies.elastic;
}

// Ends of panels between `times`: loads are smooth within each.
std::vector<double> ModalResponse::find_panels(
    const std::vector<double>& times) const {
  std::vector<double> ends = {starts_.front()};
  const auto add = [&](double t) {
    if (t > starts_.front() && t < times.back()) ends.push_back(t);
  };
  for (const double t : starts_) add(t);
  for (const double t : times) add(t);
  double rate = 0.0;
  for (const ModalOscillator& mode : modes_) {
    rate = std::max({rate, std::sqrt(mode.lambda()), mode.damping()});
  }
  for (const Wave& wave : waves_) {
    add(wave.start);
    add(wave.end);
    rate = std::max(rate, wave.omega);
  }
  ends.push_back(times.back());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());

  std::vector<double> panels = {ends.front()};
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double span = ends[i] - ends[i - 1];
    const auto count = static_cast<int>(
        std::fmin(std::fmax(std::ceil(span * rate / kPanelPhase), 1.0),
                  double{kMostPanels}));
    for (int j = 1; j < count; ++j) {
      panels.push_back(ends[i - 1] + span * j / count);
    }
    panels.push_back(ends[i]);
  }
  return panels;
}

MatrixX ModalResponse::integrate_dissipation(
    const std::vector<double>& times) const {
  MatrixX result = make_zeros(times);
  if (times.empty()) return result;
  const std::vector<double> panels = find_panels(times);
  VectorX sum = VectorX::Zero(modes());
  std::size_t next = 0;  // first time without a result
  const auto answer = [&](double reached) {
    while (next < times.size() && times[next] <= reached) {
      result.col(static_cast<Eigen::Index>(next++)) = sum;
    }
  };
  answer(panels.front());
  std::vector<double> points(kPoints.size());
  for (std::size_t i = 1; i < panels.size(); ++i) {
    const double width = panels[i] - panels[i - 1];
    for (std::size_t p = 0; p < points.size(); ++p) {
      points[p] = panels[i - 1] + kPoints[p] * width;
    }
    const MatrixX etadot = evaluate(points).etadot;
    for (std::size_t p = 0; p < points.size(); ++p) {
      sum += kWeights[p] * width *
             etadot.col(static_cast<Eigen::Index>(p)).cwiseAbs2();
    }
    answer(panels[i]);
  }
  for (Eigen::Index k = 0; k < modes(); ++k) {
    result.row(k) *= modes_[static_cast<std::size_t>(k)].damping();
  }
  return result;
}

}  // namespace limber::flexbody
