// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/contact/law/contact_parameters.hpp"
#include "limber/contact/patches/contact_side.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// The contact law between two bodies.
/// @throws InputError for parameters outside their range, or that these shapes
/// do not have, and unless suits(A, B).
[[nodiscard]] std::shared_ptr<const joints::PairInteraction> make_contact(
    const ContactSide& A, const ContactSide& B,
    const ContactParameters& parameters);

}  // namespace limber::contact
