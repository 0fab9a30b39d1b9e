// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "app/json.hpp"
#include "flexbody/recipe.hpp"
#include "flexbody/selection_record.hpp"

namespace CLI {
class App;
}

namespace limber::app {

/// How many eigenmodes, or by what they are chosen.
struct ModeOptions {
  std::string count = "10";  ///< a number or "auto"
  std::optional<double> threshold;
  std::optional<std::string> measure;
  std::optional<int> candidates;
};

/// @param names of the option that takes the count, e.g. "--modes"
void add_mode_options(CLI::App& command, const std::string& names,
                      ModeOptions& options);

/// Puts them into a basis. @throws InputError for what is no count, and for a
/// threshold, measure or candidates without "auto".
void apply(const ModeOptions& options, flexbody::BasisOptions& basis);

/// A selection for `info`, summaries and --json; modes are counted from 1.
[[nodiscard]] Json to_json(const flexbody::SelectionRecord& record);

}  // namespace limber::app
