// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "page.hpp"
#include "study.hpp"

/// What every scene's part of the page has.
namespace limber::bench::trade {

/// What the study was to show, and whether it did in this run.
struct Claim {
  bool is_held = false;
  std::string text;      ///< with the measured figures
  std::string why = {};  ///< it was missed, if it was
};

/// A percentage with two digits.
[[nodiscard]] std::string to_percent(double fraction);

/// Table of all runs, and `name`.png: errors over cost.
/// @param yardstick times cheaper than this run
void write_choices(Page& page, const std::filesystem::path& folder,
                   const std::string& name, const std::string& title,
                   const Study& study, const Outcome& yardstick);

/// The advice for one link and the errors of its levels.
struct LinkVerdict {
  std::string link;
  double neglected = 0.0;  ///< the criterion: displacement of any node [m]
  Fidelity advised = Fidelity::coupled;
  bool is_beyond_linear = false;
  /// Largest distance of any node from `coupled` in the same basis and steps,
  /// and from the reference [m]; an entry a level, rigid to coupled.
  std::vector<double> from_coupled = {};
  std::vector<double> from_full = {};
  Fidelity needed = Fidelity::coupled;          ///< by from_coupled
  std::optional<Fidelity> needed_by_full = {};  ///< none: only `full` is enough
};

struct Verdict {
  std::vector<LinkVerdict> links;
  [[nodiscard]] bool agrees() const;   ///< with `needed`, on all links
  [[nodiscard]] bool is_safe() const;  ///< never below it
  [[nodiscard]] bool agrees_by_full() const;
};

/// Advice on the study's scene, and all four reduced levels run by `base`.
[[nodiscard]] Verdict judge_advice(const Study& study, const Choice& base);
void write_verdict(Page& page, const Verdict& verdict);

}  // namespace limber::bench::trade
