// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/app/study/study_table.hpp"
#include "limber/study/study_file.hpp"

namespace limber::app {

/// Draws each response over each factor (`response_NAME.png`) and over each
/// pair of factors (`map_NAME.png`), all quantities over each other
/// (`matrix.png`), the effects (`effects.png`), the correlations
/// (`correlation.png`), and the distributions (`distribution.png`). A picture
/// that fails gives a warning.
void draw_study(const study::Study& study,
                const std::vector<study::StudyRow>& rows,
                const StudyFindings& findings,
                const std::filesystem::path& folder);

}  // namespace limber::app
