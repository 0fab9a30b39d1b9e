// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/applied_wrenches.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

// Row of a coupler, or of a transmission, which follow the couplers.
Eigen::Index row_of_coupler(std::size_t c) {
  return 6 * static_cast<Eigen::Index>(c);
}

Eigen::Index row_of_transmission(const SystemTerms& terms, std::size_t i) {
  return row_of_coupler(terms.couplers.size()) + static_cast<Eigen::Index>(i);
}

}  // namespace

Eigen::Index count_wrench_rows(const SystemTerms& terms) {
  return row_of_transmission(terms, terms.transmissions.size());
}

void get_applied(const SystemTerms& terms, VectorX& wrenches) {
  wrenches.resize(count_wrench_rows(terms));
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    wrenches.segment<6>(row_of_coupler(c)) = terms.couplers[c].applied;
  }
  for (std::size_t i = 0; i < terms.transmissions.size(); ++i) {
    wrenches[row_of_transmission(terms, i)] = terms.transmissions[i].applied;
  }
}

void set_applied(const VectorX& wrenches, SystemTerms& terms) {
  LIMBER_EXPECT(wrenches.size() == count_wrench_rows(terms));
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    terms.couplers[c].applied = wrenches.segment<6>(row_of_coupler(c));
  }
  for (std::size_t i = 0; i < terms.transmissions.size(); ++i) {
    terms.transmissions[i].applied = wrenches[row_of_transmission(terms, i)];
  }
}

void store_constraint_wrenches(const SystemTerms& terms, double ends,
                               double time, SystemState& state) {
  for (std::size_t c = 0; c < terms.couplers.size(); ++c) {
    const CouplerTerms& coupler = terms.couplers[c];
    if (coupler.ideal < 0) continue;
    joints::CouplerMemory& memory = state.memory[c];
    const Matrix6& held = terms.constraints[index(coupler.ideal)].directions;
    // The law's wrench has that of the last state.
    const Vector6 solved =
        held * (memory.constraint_wrench +
                (coupler.applied - coupler.response.wrench) / ends);
    const double beyond = state.t - time;
    const double between = time - memory.solved_time;
    memory.constraint_wrench = solved;
    if (beyond > 0.0 && beyond <= between && std::isfinite(between)) {
      memory.constraint_wrench +=
          beyond / between * (solved - memory.solved_wrench);
    }
    memory.solved_wrench = solved;
    memory.solved_time = time;
  }
}

void add_to_applied(const std::vector<Vector6>& increments, SystemTerms& terms,
                    double fraction) {
  const std::size_t couplers = terms.couplers.size();
  for (std::size_t c = 0; c < couplers; ++c) {
    terms.couplers[c].applied += fraction * increments[c];
  }
  for (std::size_t i = 0; i < terms.transmissions.size(); ++i) {
    terms.transmissions[i].applied += fraction * increments[couplers + i][0];
  }
}

}  // namespace limber::dynamics
