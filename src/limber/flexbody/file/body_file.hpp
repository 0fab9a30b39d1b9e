// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "limber/flexbody/model/reduced_body.hpp"

namespace limber::flexbody {

/// The first line of its seal.
inline constexpr std::string_view kReducedBodyFormat = "limber reduced body";

/// Version of the layout that `write_body` uses for a body without contact
/// surfaces.
inline constexpr int kBodyFileVersion = 7;
/// The same for a body with contact surfaces.
inline constexpr int kContactBodyFileVersion = 8;

/// The same for a body with second-order kinematics, with or without surfaces.
inline constexpr int kManifoldBodyFileVersion = 9;

/// The same for a body with stress modes, with or without the others.
inline constexpr int kStressBodyFileVersion = 10;

/// The same for a body of beams and shells with stress modes.
inline constexpr int kSectionBodyFileVersion = 11;

/// Writes one self-describing HDF5 file (every dataset carries its unit and
/// meaning), atomically: a concurrent reader finds the old file or the new one,
/// and of several writers the last one wins. HDF5's user block, the first 512
/// bytes, holds a seal: lines of text with the layout's version and a digest of
/// all bytes after it.
/// @throws InputError if it cannot be written.
void write_body(const ReducedBody& body, const std::filesystem::path& file);

/// Whether the stress modes of a file are read; they are its largest tables.
enum class StressTables { needed, skipped };

/// @throws InputError if the file is missing, truncated, corrupt (even in a
/// single bit), of another version, or holds values that are not finite or of
/// wrong size. Stress modes that it lacks are none.
[[nodiscard]] ReducedBody read_body(const std::filesystem::path& file,
                                    StressTables stress = StressTables::needed);

/// Whether a file begins as a reduced body; false if it cannot be read.
[[nodiscard]] bool is_body_file(const std::filesystem::path& file);

/// Updates the seal of a file that another tool has changed on purpose; its
/// layout remains.
/// @throws InputError if it cannot be read or written.
void seal_body_file(const std::filesystem::path& file);

}  // namespace limber::flexbody
