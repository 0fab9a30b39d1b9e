// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_memory.hpp"

namespace limber::contact {
namespace {

// Calls `visit` with every number, in the order of the memory.
template <typename Patch, typename Visit>
void for_numbers(Patch& patch, const Visit& visit) {
  visit(patch.time);
  for (auto* vector : {&patch.x_A, &patch.x_B}) {
    for (Eigen::Index i = 0; i < 3; ++i) visit((*vector)[i]);
  }
  visit_friction(patch.friction, visit);
}

}  // namespace

PatchMemory load_patch(std::span<const double> memory) {
  PatchMemory patch;
  if (!is_touching(memory)) return patch;
  patch.is_touching = true;
  std::size_t next = 1;
  for_numbers(patch, [&](double& number) { number = memory[next++]; });
  return patch;
}

void save_patch(const PatchMemory& patch, std::span<double> memory) {
  memory[0] = patch.is_touching ? 1.0 : 0.0;
  std::size_t next = 1;
  for_numbers(patch, [&](const double& number) { memory[next++] = number; });
}

}  // namespace limber::contact
