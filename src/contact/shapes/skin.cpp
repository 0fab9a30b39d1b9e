// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/skin.hpp"

#include <utility>

namespace limber::contact {

Skin::Skin(flexbody::ContactSurface surface) : surface_(std::move(surface)) {}

}  // namespace limber::contact
