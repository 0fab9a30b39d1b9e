// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "fem/mesh_options.hpp"
#include "fem/mesh_wire.hpp"

namespace limber::fem {

/// The program that makes meshes, and how much it may take.
struct Mesher {
  std::filesystem::path program;
  double seconds = 0.0;      ///< of wall time [s]
  std::uint64_t memory = 0;  ///< bytes of address space
};

/// The mesher of this installation: what LIMBER_MESHER names, else
/// `limber-mesh` beside the running program, in ../libexec/limber, or where
/// Limber was configured to be installed. Limits are LIMBER_MESH_SECONDS, or
/// 300 s, and LIMBER_MESH_MEMORY in GiB, or half of the machine's memory.
/// @throws InputError if there is no such program, or a value is no positive
/// number
[[nodiscard]] Mesher find_mesher();

/// What of this installation a mesh may depend on but for files that are read:
/// the mesher's place and its environment. Empty if there is no mesher.
[[nodiscard]] std::string identify_mesher();

/// Has the file meshed. @throws InputError naming the file and why: a problem
/// of it, a limit that it hit, something that it may not do, or how the mesher
/// died, with its last words.
[[nodiscard]] MeshReply ask_mesher(const Mesher& mesher,
                                   const std::filesystem::path& file,
                                   const MeshOptions& options);

/// Exit statuses by which the mesher says more than "failed".
inline constexpr int kMesherRefused = 40;  ///< its words say what
inline constexpr int kMesherOutOfMemory = 41;

}  // namespace limber::fem
