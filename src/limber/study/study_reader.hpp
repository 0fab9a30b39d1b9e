// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/study/study.hpp"

namespace limber::study {

/// Reads a study file.
/// @throws InputError with every problem of the file.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

/// The same from its text; `file` need not exist any more.
[[nodiscard]] Study read_study(const std::string& text,
                               const std::filesystem::path& file);

}  // namespace limber::study
