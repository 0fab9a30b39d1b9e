// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/model/full_stress.hpp"

namespace limber::flexbody {

std::shared_ptr<const FullStress> make_full_stress(
    const FullBody& body, const std::vector<int>& nodes) {
  const std::unique_ptr<FullBodySolver> solver = body.make_solver();
  const auto* stressed = dynamic_cast<const StressedSolver*>(solver.get());
  return stressed == nullptr ? nullptr : stressed->make_stress(nodes);
}

}  // namespace limber::flexbody
