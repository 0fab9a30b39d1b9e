// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/app/study/study_file.hpp"
#include "limber/app/study/study_table.hpp"

namespace limber::app {

/// Draws, for each response, it over each factor (`response_NAME.png`) and over
/// each two (`map_NAME.png`), all over each other (`matrix.png`), the effects
/// (`effects.png`), and the distributions (`distribution.png`). One that cannot
/// be drawn costs a warning.
void draw_study(const Study& study, const std::vector<StudyRow>& rows,
                const Effects& effects, const std::filesystem::path& folder);

}  // namespace limber::app
