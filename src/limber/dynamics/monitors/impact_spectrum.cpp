// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/impact_spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/index.hpp"
#include "limber/dynamics/monitors/shortest_impact.hpp"

namespace limber::dynamics {
namespace {

// Modes up to f grow as f^p: p = 1/2 of a bar that bends, 1 of a plate, 3 of a
// solid, found between the middle and the end of the basis.
std::optional<int> estimate_modes(const VectorX& omega, double wanted) {
  const Eigen::Index count = omega.size();
  const Eigen::Index half = count / 2;
  const double middle = count < 4 ? 0.0 : omega[half - 1];
  const double end = count < 4 ? 0.0 : omega[count - 1];
  if (!(middle > 0.0) || !(end > middle)) return std::nullopt;
  const double ratio = static_cast<double>(count) / static_cast<double>(half);
  const double power =
      std::clamp(std::log(ratio) / std::log(end / middle), 0.5, 3.0);
  return static_cast<int>(
      std::ceil(static_cast<double>(count) * std::pow(wanted / end, power)));
}

VectorX find_frequencies(const BodyModel& body) {
  VectorX omega = body.reduced->lambda.cwiseMax(0.0).cwiseSqrt();
  std::sort(omega.begin(), omega.end());
  return omega;
}

}  // namespace

std::vector<ImpactSpectrum> find_impact_spectra(
    const SystemModel& model, const std::vector<ContactRecord>& records) {
  const auto shortest = find_shortest_impacts(records);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<ImpactSpectrum> spectra;
  for (const Pair& pair : model.pairs) {
    const auto found = shortest.find(pair.name);
    if (found == shortest.end()) continue;
    for (const BodyIndex b : {pair.body_A, pair.body_B}) {
      if (b == kWorld) continue;
      const BodyModel& body = model.bodies[index(b)];
      if (!body.reduced || body.modes == 0) continue;
      const VectorX omega = find_frequencies(body);
      ImpactSpectrum spectrum;
      spectrum.pair = pair.name;
      spectrum.body = body.name;
      spectrum.duration = found->second;
      spectrum.frequency = omega[omega.size() - 1] / kTurn;
      spectrum.modes = body.modes;
      spectrum.needed = estimate_modes(
          omega, kTurn * ImpactSpectrum::kEnough / spectrum.duration);
      spectra.push_back(spectrum);
    }
  }
  return spectra;
}

std::string describe(const ImpactSpectrum& spectrum) {
  const std::string found = fmt::format(
      "contact '{}': an impact lasts about {:.3g} s, and the {} modes of body "
      "'{}' end at {:.4g} Hz, {:.2g} periods of which fit into it",
      spectrum.pair, spectrum.duration, spectrum.modes, spectrum.body,
      spectrum.frequency, spectrum.fraction());
  if (spectrum.is_enough()) return found + ": they respond to it";
  const std::string more =
      spectrum.needed
          ? fmt::format("; about {} modes would respond", *spectrum.needed)
          : "";
  return fmt::format(
      "{}, {:g} are needed: the remaining deformation is quasi-static, so "
      "forces may be wrong by 10 to 20 %{}{}",
      found, ImpactSpectrum::kEnough,
      spectrum.fraction() < ImpactSpectrum::kPoor
          ? ", and impulses by 20 % or more"
          : "",
      more);
}

}  // namespace limber::dynamics
