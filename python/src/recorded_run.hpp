// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <vector>

#include "bindings.hpp"
#include "limber/app/run/run_scene.hpp"

namespace limber::python {

/// A finished run, as NumPy sees it. What the run holds output by output, most
/// of it in a file, is gathered in memory once, when it is first asked for.
struct RecordedRun {
  using Block =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  runs::Run run;
  py::object cause = py::none();  ///< what Python code raised and ended it
  /// Writes its files where they are not those of a run (app::write_run).
  std::function<void(const std::filesystem::path& folder, bool xdmf)> write;

  /// Outputs x columns.
  const Block& probes();
  /// Outputs x 13 a body: position, quaternion w x y z, velocity in the world,
  /// angular velocity in the body.
  const Block& motion();
  /// Outputs x modes of all bodies.
  const Block& eta();
  const Block& etadot();
  /// One an output.
  const std::vector<dynamics::EnergyBalance>& energies();

 private:
  Block probes_;
  Block motion_;
  Block eta_;
  Block etadot_;
  std::vector<dynamics::EnergyBalance> energies_;
};

/// Values a body in RecordedRun::motion.
inline constexpr Eigen::Index kBodyValues = 13;

}  // namespace limber::python
