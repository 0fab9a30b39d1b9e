// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/modal/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "limber/common/errors.hpp"

namespace limber::flexbody {
namespace {

int count_elastic(const fem::ElasticInverse& inverse) {
  return static_cast<int>(inverse.matrices().dof_count() -
                          inverse.rigid_count());
}

MatrixX find_compliances(const MatrixX& Phi, const VectorX& lambda,
                         const LoadCases& cases) {
  return calc_modal_compliance(Phi.transpose() * cases.loads, lambda);
}

std::vector<int> all_of(Eigen::Index count) {
  std::vector<int> modes(static_cast<std::size_t>(count));
  std::iota(modes.begin(), modes.end(), 0);
  return modes;
}

SelectionRecord make_record(const AutomaticModes& options,
                            const ModeSelection& selection,
                            const fem::Eigenmodes& candidates,
                            const LoadCases& cases) {
  SelectionRecord record;
  record.measure = options.measure;
  record.threshold = options.threshold;
  record.candidates = static_cast<int>(candidates.lambda.size());
  record.modes = selection.modes;
  const VectorX errors = calc_static_error(
      find_compliances(candidates.Phi, candidates.lambda, cases),
      cases.compliance, selection.modes);
  for (std::size_t i = 0; i < cases.names.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    record.cases.push_back({cases.names[i], selection.cases[i],
                            selection.reached[k], errors[k], 0.0});
  }
  return record;
}

// T_c of a free impact [s], [@johnson1985, ch. 11].
double calc_duration(const ExpectedImpact& impact, double own_mass) {
  const double mass = 1.0 / (1.0 / own_mass + 1.0 / impact.mass);
  const double k = impact.stiffness;
  return 3.2180 * std::pow(mass * mass / (k * k * impact.speed), 0.2);
}

// All modes with fewer periods in an impact are needed; the residual
// flexibility deforms, but does not vibrate (docs/theory/contact_laws.md).
constexpr double kPeriods = 2.0;

// Largest lambda that impacts need [rad^2/s^2].
double find_impact_limit(const AutomaticModes& options,
                         const ElasticBody& body) {
  const VectorX along_x = body.support.translations.col(0);
  const double own =
      body.support.is_clamped
          ? std::numeric_limits<double>::infinity()
          : fem::multiply_mass(body.support.matrices.M_s, along_x)
                .col(0)
                .dot(along_x);
  double limit = 0.0;
  for (const ExpectedImpact& impact : options.impacts) {
    if (std::isinf(own) && std::isinf(impact.mass)) continue;
    const double omega =
        2.0 * std::numbers::pi * kPeriods / calc_duration(impact, own);
    limit = std::max(limit, omega * omega);
  }
  return limit;
}

// Up to the first that is above, so that the basis reaches the limit.
void add_modes_to(double limit, const VectorX& lambda,
                  const CaseContributions& contributions,
                  ModeSelection& selection) {
  for (int k = 0; k < lambda.size(); ++k) {
    std::vector<int>& modes = selection.modes;
    if (!(limit > 0.0) || (k > 0 && lambda[k - 1] > limit)) break;
    if (std::binary_search(modes.begin(), modes.end(), k)) continue;
    modes.insert(std::lower_bound(modes.begin(), modes.end(), k), k);
    for (Eigen::Index c = 0; c < contributions.totals.size(); ++c) {
      if (contributions.totals[c] == 0.0) continue;
      selection.reached[c] +=
          contributions.by_mode(k, c) / contributions.totals[c];
    }
  }
}

/// Called before any long work.
void check_measure(ModeMeasure measure, const ElasticBody& body) {
  if (measure != ModeMeasure::report || can_find_all_modes(body)) return;
  throw InputError(fmt::format(
      "measure 'report' takes the sum over all modes of the mesh; {} free "
      "degrees of freedom are more than the {} that it is done for. Use "
      "measure 'compliance', whose total is one static solve.",
      body.inverse.matrices().dof_count(), kMostDofsForAllModes));
}

}  // namespace

void check_basis(const Recipe& recipe) {
  const auto check_count = [&](int count) {
    if (count >= 0) return;
    throw InputError(fmt::format(
        "body '{}': {} eigenmodes; expected 0 or more.", recipe.name, count));
  };
  check_count(recipe.basis.eigenmodes);
  if (recipe.basis.automatic) check_count(recipe.basis.automatic->candidates);
}

bool can_find_all_modes(const ElasticBody& body) {
  return body.inverse.matrices().dof_count() <= kMostDofsForAllModes;
}

VectorX find_report_totals(const LoadCases& cases, const ElasticBody& body,
                           const Progress& progress) {
  LIMBER_EXPECT(can_find_all_modes(body));
  report(progress, "all modes of the mesh", 0.0);
  const fem::Eigenmodes all =
      fem::find_eigenmodes(body.inverse, count_elastic(body.inverse), progress);
  return calc_report_effective_mass(all.Phi, all.lambda,
                                    body.support.matrices.M_s, cases.loads)
      .colwise()
      .sum()
      .transpose();
}

Participation calc_base_participation(const ElasticBody& body,
                                      const fem::Eigenmodes& modes) {
  return calc_base_participation(modes.Phi, body.support.matrices.M_s,
                                 body.support.translations);
}

CaseContributions find_contributions(ModeMeasure measure,
                                     const fem::Eigenmodes& modes,
                                     const LoadCases& cases,
                                     const ElasticBody& body,
                                     const Progress& progress) {
  switch (measure) {
    case ModeMeasure::report:
      return {
          calc_report_effective_mass(modes.Phi, modes.lambda,
                                     body.support.matrices.M_s, cases.loads),
          find_report_totals(cases, body, progress)};
    case ModeMeasure::mass: {
      const Participation base = calc_base_participation(body, modes);
      return {base.effective_mass.topRows<3>().transpose(),
              base.rigid_mass.head<3>()};
    }
    case ModeMeasure::compliance:
      break;
  }
  return {find_compliances(modes.Phi, modes.lambda, cases), cases.compliance};
}

ChosenModes choose_eigenmodes(const ElasticBody& body, const Recipe& recipe,
                              const Progress& progress) {
  const fem::ElasticInverse& inverse = body.inverse;
  ChosenModes chosen;
  if (!recipe.basis.automatic) {
    chosen.eigenmodes =
        fem::find_eigenmodes(inverse, recipe.basis.eigenmodes, progress);
    return chosen;
  }
  const AutomaticModes& options = *recipe.basis.automatic;
  check_measure(options.measure, body);
  chosen.cases = find_load_cases(body, recipe, options.measure);
  const fem::Eigenmodes candidates = fem::find_eigenmodes(
      inverse, std::min(options.candidates, count_elastic(inverse)), progress);
  const CaseContributions contributions = find_contributions(
      options.measure, candidates, chosen.cases, body, progress);
  ModeSelection selection = select_modes(
      contributions.by_mode, contributions.totals, {options.threshold});
  add_modes_to(find_impact_limit(options, body), candidates.lambda,
               contributions, selection);
  chosen.record = make_record(options, selection, candidates, chosen.cases);
  chosen.eigenmodes = {candidates.lambda(selection.modes),
                       candidates.Phi(Eigen::all, selection.modes)};
  return chosen;
}

std::optional<SelectionRecord> finish_record(const ChosenModes& chosen,
                                             const ReducedBasis& basis) {
  std::optional<SelectionRecord> record = chosen.record;
  if (!record) return record;
  const VectorX errors =
      calc_static_error(find_compliances(basis.Phi, basis.lambda, chosen.cases),
                        chosen.cases.compliance, all_of(basis.lambda.size()));
  for (std::size_t i = 0; i < record->cases.size(); ++i)
    record->cases[i].basis_error = errors[static_cast<Eigen::Index>(i)];
  return record;
}

}  // namespace limber::flexbody
