// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace limber::fem {

/// What a card that is not read means for the elastic body.
enum class CardEffect {
  on_body,  ///< an element, a mass or a constraint between nodes
  unknown,  ///< of no known kind: it may be any of these
  outside,  ///< support, load or another that the scene has in its own way
  none      ///< properties, materials, settings of analyses, output
};

/// By its name. Unknown names beginning with C are elements.
[[nodiscard]] CardEffect find_card_effect(std::string_view name);

/// Shells and bars by which mesh generators mark faces and edges of a solid.
[[nodiscard]] bool is_mark_of_surface(std::string_view name);

/// Properties of elements: PSOLID, PSHELL and the like.
[[nodiscard]] bool is_property(std::string_view name);

/// CORD1R, CORD1C, CORD1S, CORD2R, CORD2C, CORD2S.
[[nodiscard]] bool is_coordinate_system(std::string_view name);

}  // namespace limber::fem
