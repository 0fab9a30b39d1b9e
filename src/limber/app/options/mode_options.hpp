// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/app/console/json.hpp"
#include "limber/flexbody/modal/piece_check.hpp"
#include "limber/flexbody/model/mesh_locking.hpp"
#include "limber/flexbody/model/recipe.hpp"
#include "limber/flexbody/model/selection_record.hpp"

namespace CLI {
class App;
}

namespace limber::app {

/// Number of eigenmodes, or how they are selected.
struct ModeOptions {
  std::string count = "10";         ///< a number or "auto"
  std::optional<double> threshold;  ///< fraction to reach, in [0, 1] [-]
  std::optional<std::string> measure;
  std::optional<int> candidates;  ///< number to select from
};

/// @param names of the option that takes the count, e.g. "--modes"
void add_mode_options(CLI::App& command, const std::string& names,
                      ModeOptions& options);

/// Copies them to a basis. @throws InputError for an invalid count, and for a
/// threshold, measure or candidates without "auto".
void apply(const ModeOptions& options, flexbody::BasisOptions& basis);

/// A selection for `info`, summaries and --json; modes are counted from 1.
[[nodiscard]] Json to_json(const flexbody::SelectionRecord& record);
[[nodiscard]] Json to_json(const flexbody::MeshLocking& locking);
[[nodiscard]] Json to_json(const flexbody::PieceCheck& check);

}  // namespace limber::app
