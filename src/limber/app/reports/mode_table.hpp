// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/app/console/json.hpp"
#include "limber/reduction/mode_study.hpp"

namespace limber::app {

/// The study of `limber modes`, as JSON and as text. Fractions are in percent
/// of the total over all modes of the mesh.
[[nodiscard]] Json to_json(const flexbody::ModeStudy& study);
void print_text(const flexbody::ModeStudy& study);

}  // namespace limber::app
