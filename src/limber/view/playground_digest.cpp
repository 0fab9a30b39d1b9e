// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/playground_digest.hpp"

#include "limber/view/playground_sources.hpp"

namespace limber::view {

std::string_view playground_digest() { return LIMBER_PLAYGROUND_DIGEST; }

}  // namespace limber::view
