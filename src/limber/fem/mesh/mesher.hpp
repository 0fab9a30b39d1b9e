// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "limber/common/progress.hpp"
#include "limber/fem/mesh/mesh_options.hpp"
#include "limber/fem/mesh/mesh_wire.hpp"

namespace limber::fem {

/// The meshing program and its limits.
struct Mesher {
  std::filesystem::path program;
  double seconds = 0.0;      ///< wall time [s]
  std::uint64_t memory = 0;  ///< address space [bytes]
};

/// The mesher of this installation: the one LIMBER_MESHER names, else
/// `limber-mesh` beside the running program, in ../libexec/limber, or where
/// Limber was configured to be installed. Limits are LIMBER_MESH_SECONDS, or
/// 300 s, and LIMBER_MESH_MEMORY in GiB, or half of the machine's memory.
/// @throws InputError if there is no such program, or a value is not a positive
/// number
[[nodiscard]] Mesher find_mesher();

/// What a mesh depends on besides the files read: the mesher's path and its
/// environment. Empty if there is no mesher.
[[nodiscard]] std::string identify_mesher();

/// Meshes the file in a mesher process, and reports how many elements it
/// expects as soon as that is known. @throws InputError naming the file and
/// the cause: a problem of the file, an exceeded limit, a forbidden action, or
/// how the mesher ended, with its last output.
[[nodiscard]] MeshReply run_mesher(const Mesher& mesher,
                                   const std::filesystem::path& file,
                                   const MeshOptions& options,
                                   const Progress& progress = {});

/// Beginning of its line of output that states the number of expected elements.
inline constexpr std::string_view kExpectedElements =
    "limber-mesh: expected elements: ";

/// Exit statuses of the mesher with a specific meaning.
inline constexpr int kMesherRefused = 40;  ///< its output states why
inline constexpr int kMesherOutOfMemory = 41;

}  // namespace limber::fem
