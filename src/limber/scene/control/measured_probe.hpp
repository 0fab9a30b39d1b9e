// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/system/controller.hpp"
#include "limber/scene/probes/probe.hpp"

namespace limber::scene {

/// A column of a probe, "tip.ux", as a controller's measurement.
/// @throws InputError naming the probe's columns if it is not among them.
[[nodiscard]] dynamics::Measurement measure_probe(const Probe& probe,
                                                  const std::string& column);

}  // namespace limber::scene
