// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/make_contact.hpp"

#include "limber/contact/contact_pair.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/patches/patch_sides.hpp"

namespace limber::contact {

std::shared_ptr<const joints::PairInteraction> make_contact(
    const ContactSide& A, const ContactSide& B,
    const ContactParameters& parameters) {
  if (suits(A, B)) {
    return std::make_shared<const PatchPair>(A, B, parameters);
  }
  return std::make_shared<const ContactPair>(A, B, parameters);
}

}  // namespace limber::contact
