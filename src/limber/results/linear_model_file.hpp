// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "limber/dynamics/analysis/linear_model.hpp"

namespace limber::results {

/// A linear model with the metadata of its file.
struct LinearRecord {
  dynamics::LinearModel model;
  double time = 0.0;  ///< of the reference [s]
  /// Of a discrete model, z_(k+1) = A z_k + B du_k; 0: continuous [s].
  double period = 0.0;
  std::vector<double> axes_angular_velocity{0.0, 0.0, 0.0};  ///< [rad/s]
  /// Of a truncated model; else empty [output's / input's].
  std::vector<double> hankel;
  double bound = 0.0;    ///< of the truncation [output's / input's]
  std::string scenario;  ///< its name
  std::string about;     ///< "start", "equilibrium", "time"
  std::vector<std::string> warnings;
};

/// Writes MATLAB's format 5 (.mat), NumPy's (.npz) or JSON (.json), by the
/// file's extension. Keys: docs/reference/linearize.md.
/// @throws InputError for another extension, or if it cannot be written.
void write_linear_model(const std::filesystem::path& file,
                        const LinearRecord& record);

/// @throws InputError for the extension of no format.
void check_linear_model_ending(const std::filesystem::path& file);

}  // namespace limber::results
