// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "limber/runs/run.hpp"
#include "limber/study/study.hpp"

namespace limber::study {

/// A number for each response; none if it does not exist, such as a restitution
/// while bodies still touch, or is not finite.
using ResponseValues = std::vector<std::optional<double>>;

/// The summary of a run, in which SummaryResponse::path is looked up.
using Summarize = std::function<nlohmann::ordered_json(const runs::Run&)>;

/// @throws InputError naming every response that runs of the scene cannot have:
/// an unknown column, contact or figure, or a wrong formula.
void check_responses(const Study& study, const scene::Scene& scene,
                     const scene::BuiltScene& built,
                     const Summarize& summarize);

/// Whether a response needs the judgement of levels, which costs time.
[[nodiscard]] bool needs_levels(const Study& study);

/// Each level that a response has, once.
[[nodiscard]] std::vector<dynamics::Fidelity> list_levels(const Study& study);

/// All responses except formulas.
/// @param at_levels the same run, with the outputs at the same times, at each
/// of list_levels
/// @throws InputError for a figure that the run's summary does not have
[[nodiscard]] ResponseValues evaluate_run(
    const Study& study, const runs::Run& run,
    const std::vector<runs::Run>& at_levels, const Summarize& summarize);

/// Adds the formulas. Not thread-safe.
void evaluate_formulas(const Study& study,
                       const std::vector<std::string>& factors,
                       ResponseValues& values);

}  // namespace limber::study
