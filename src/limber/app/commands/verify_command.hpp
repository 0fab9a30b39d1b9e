// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limber/app/console/command_line.hpp"
#include "limber/app/options/setting_options.hpp"

namespace limber::app {

/// Options of the command line.
struct VerifyOptions {
  std::string scenario;
  std::string joints;
  std::string integrator;
  std::string cache;
  SettingOptions robots;        ///< how their files are read
  double step = 0.0;            ///< [s]
  double duration = 0.0;        ///< [s]
  double accuracy = 1e-12;      ///< of Simbody's integrator [-]
  int refine = 0;               ///< number of halvings of the step
  std::vector<double> stiffen;  ///< factors of stiffness [-]
  std::string out;
  bool json = false;
};

using Verify = std::function<void(const VerifyOptions&)>;

/// Adds `verify`; choosing it calls `verify`.
void add_verify(CLI::App& app, Action& action, const Verify& verify);

}  // namespace limber::app
