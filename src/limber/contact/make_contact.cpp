// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/make_contact.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/patches/patch_sides.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

namespace limber::contact {
namespace {

// Surfaces for which no convex bodies stand, such as "'pad'".
std::string list_bare_surfaces(const ContactSide& A, const ContactSide& B) {
  std::string names;
  for (const ContactSide* side : {&A, &B}) {
    const auto* mesh_surface =
        std::get_if<std::shared_ptr<const MeshSurface>>(&side->shape.kind);
    if (mesh_surface == nullptr || !make_parts(*side).empty()) continue;
    names += fmt::format("{}'{}'", names.empty() ? "" : " and ",
                         (*mesh_surface)->surface().name);
  }
  return names;
}

}  // namespace

std::shared_ptr<const joints::PairInteraction> make_contact(
    const ContactSide& A, const ContactSide& B,
    const ContactParameters& parameters) {
  if (suits(A, B)) {
    return std::make_shared<const PatchPair>(A, B, parameters);
  }
  const std::string bare = list_bare_surfaces(A, B);
  if (bare.empty()) {
    throw InputError(
        "contact: contact between these two shapes is not supported");
  }
  throw InputError(fmt::format(
      "contact: surface {} has no convex parts, so that only spheres can be in "
      "contact with it: divide a flat group that is not convex into convex "
      "ones, or reduce the saved body again by 'limber reduce'",
      bare));
}

}  // namespace limber::contact
