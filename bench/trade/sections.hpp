// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "scene_page.hpp"

/// The page's scenes, a file each. Each runs its scene, adds its claims and
/// returns a function that writes its part of the page.
namespace limber::bench::trade {

struct Context {
  std::filesystem::path folder;  ///< of the page
  std::filesystem::path cache;   ///< of reduced bodies; empty at first
  std::vector<Claim> claims;
};

/// Whether advice and comparison agree, as a claim.
void add_verdict_claim(Context& context, const std::string& scene,
                       const Verdict& verdict);

using Writer = std::function<void(Page&)>;

[[nodiscard]] Writer study_rotation(Context& context);
[[nodiscard]] Writer study_complex(Context& context);
[[nodiscard]] Writer study_impact(Context& context);
[[nodiscard]] Writer study_arm(Context& context);
[[nodiscard]] Writer study_spin(Context& context);

}  // namespace limber::bench::trade
