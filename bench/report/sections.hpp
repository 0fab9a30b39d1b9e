// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "beam.hpp"
#include "full_modes.hpp"
#include "page.hpp"

/// The page's sections, a file each. Each computes its own numbers.
namespace limber::bench {

/// Found once, used by several sections.
class Shared {
 public:
  /// All modes of the beam held at z = 0, and of the free one.
  [[nodiscard]] const FullModes& clamped();
  [[nodiscard]] const FullModes& free();
  /// Ten free eigenmodes on every row.
  [[nodiscard]] const Body& beam();

 private:
  std::unique_ptr<FullModes> clamped_;
  std::unique_ptr<FullModes> free_;
  Body beam_;
};

void write_mesh_statistics(Page& page);                    // Table 1
void write_effective_masses(Page& page, Shared& shared);   // Table 2
void write_step_approximation(Page& page);                 // Figure 7
void write_truncation(Page& page, Shared& shared);         // Figure 8
void write_static_modes(Page& page, Shared& shared);       // beyond the report
void write_decision_boundary(Page& page, Shared& shared);  // Figure 9
void write_energy(Page& page, Shared& shared);             // Figures 10, 11
void write_time_steps(Page& page, Shared& shared);         // Figures 12, 13
void write_beam_theory(Page& page);                        // section 5.7.1
void write_shear_swing(Page& page);                        // Figure 14
void write_large_rotation(Page& page, Shared& shared);     // Figures 15 to 17
void write_case_study(Page& page, Shared& shared);         // Figures 18, 19
void write_case_cost(Page& page);                          // section 6.1
void write_boundary_savings(Page& page);                   // Table 3, Figure 20

}  // namespace limber::bench
