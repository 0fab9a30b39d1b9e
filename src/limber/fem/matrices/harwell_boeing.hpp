// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/fem/matrices/source_matrix.hpp"

namespace limber::fem {

/// Reads an assembled real square matrix in Harwell-Boeing format, RSA (lower
/// triangle) or RUA, as Ansys' HBMAT and *EXPORT,,HBMAT write it; its
/// right-hand sides are ignored. Source: Duff, Grimes, Lewis, "Users' Guide for
/// the Harwell-Boeing Sparse Matrix Collection", TR/PA/92/86 (1992).
/// @throws InputError with file and line
[[nodiscard]] SourceMatrix read_harwell_boeing(
    const std::filesystem::path& file);

}  // namespace limber::fem
