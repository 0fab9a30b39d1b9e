// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"
#include "limber/study/study.hpp"

namespace limber::study {

/// The runs of a study: for each the value of each factor, as TOML.
using Design = std::vector<std::vector<std::string>>;

/// Most runs of a study.
inline constexpr int kMostRuns = 10'000'000;

/// All runs. They depend on the study only, so that any machine can make any
/// part of them.
///
/// `grid`: all combinations, the last factor varies fastest. `list`: the k-th
/// run has the k-th value of every factor. `monte-carlo`: independent values.
/// `latin-hypercube`: each of n intervals of equal probability of each factor
/// once. `sobol`: for each of n points of Sobol's sequence in 2 d dimensions,
/// (A, B), d + 2 runs: A, B, and A with one coordinate of B each, from which
/// find_effects has its indices.
///
/// Source     Saltelli et al. (2010) [@saltelli2010]
/// @throws InputError naming a factor whose values do not suit the design.
[[nodiscard]] Design make_design(const Study& study);

/// A factor's value at a fraction u in (0, 1) of its distribution.
[[nodiscard]] std::string find_value(const Factor& factor, double u);

/// Quantile u of the standard normal distribution, u in (0, 1).
///
/// Source     Wichura (1988), algorithm AS 241, 16 digits [@wichura1988]
[[nodiscard]] double find_normal_quantile(double u);

/// A value that is a number; none of texts and arrays.
[[nodiscard]] std::optional<double> find_number(const std::string& value);

/// The overrides that turn the scenario into the run with these values.
[[nodiscard]] scene::Overrides to_overrides(
    const Study& study, const std::vector<std::string>& values);

}  // namespace limber::study
