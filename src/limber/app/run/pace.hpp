// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/app/reports/check_report.hpp"
#include "limber/scene/build/build_system.hpp"

namespace limber::app {

/// Makes steps of a run for half a second.
///
/// Equation   without a tolerance the pace is that of the later half of the
///            measured steps. With one a coarse pass, to 100 times the
///            tolerance, shows where in the motion steps are short:
///            time = s(f) + (c(1) - c(f)) (s(f) - s(f/2)) / (c(f) - c(f/2)),
///            s and c: time of the run and of the coarse pass until a fraction
///            of the motion, f: what was measured of the run. Verified passes
///            are mostly three, with steps of half and of a third the length:
///            six times the first
/// Limits     a coarse pass of a second, extrapolated where that does not reach
///            the end
[[nodiscard]] Pace measure_pace(const scene::BuiltScene& built);

}  // namespace limber::app
