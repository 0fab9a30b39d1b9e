// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::contact {

/// Refuses a value of a law that is outside its range or not finite.
/// @throws InputError "contact: its WHAT is VALUE; expected EXPECTED".
void check_value(bool holds, const char* what, double value,
                 const char* expected);

}  // namespace limber::contact
