// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/selection_record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace limber::flexbody {
namespace {

/// Roundoff of a fraction.
constexpr double kRoundoffOfRecord = 1e-9;

double percent(double fraction) { return 100.0 * fraction; }

/// Cases below the threshold, the worst first.
std::vector<const SelectedCase*> find_missed(const SelectionRecord& record) {
  std::vector<const SelectedCase*> missed;
  for (const SelectedCase& item : record.cases)
    if (item.reached < record.threshold - kRoundoffOfRecord)
      missed.push_back(&item);
  std::stable_sort(missed.begin(), missed.end(),
                   [](const SelectedCase* a, const SelectedCase* b) {
                     return a->reached < b->reached;
                   });
  return missed;
}

std::string describe(const SelectedCase& item, const SelectionRecord& record) {
  return fmt::format(
      "automatic modes: {} candidates reach {:.4g} % of '{}' by measure '{}', "
      "not {:.4g} %; static error {:.3g} % by them, {:.3g} % by the whole "
      "basis. Allow more candidates or require less.",
      record.candidates, percent(item.reached), item.name,
      to_string(record.measure), percent(record.threshold),
      percent(item.eigenmode_error), percent(item.basis_error));
}

}  // namespace

std::vector<std::string> describe_shortfalls(const SelectionRecord& record) {
  constexpr std::size_t kMost = 4;
  std::vector<const SelectedCase*> missed = find_missed(record);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(kMost, missed.size()); ++i)
    texts.push_back(describe(*missed[i], record));
  if (missed.size() > kMost)
    texts.push_back(
        fmt::format("automatic modes: the same holds for {} further load cases",
                    missed.size() - kMost));
  return texts;
}

std::string summarize(const SelectionRecord& record) {
  double reached = 1.0;
  double eigenmode_error = 0.0;
  double basis_error = 0.0;
  for (const SelectedCase& item : record.cases) {
    reached = std::min(reached, item.reached);
    eigenmode_error = std::max(eigenmode_error, item.eigenmode_error);
    basis_error = std::max(basis_error, item.basis_error);
  }
  return fmt::format(
      "{} of {} eigenmodes reach {:.4g} % by measure '{}' in each of {} load "
      "cases; static error up to {:.3g} % by them, {:.3g} % by the whole basis",
      record.modes.size(), record.candidates, percent(reached),
      to_string(record.measure), record.cases.size(), percent(eigenmode_error),
      percent(basis_error));
}

}  // namespace limber::flexbody
