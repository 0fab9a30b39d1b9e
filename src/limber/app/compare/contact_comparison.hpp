// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/runs/compare/pair_contact.hpp"

namespace limber::app {

/// Contacts of one run for tables.
struct NamedContacts {
  std::string run;
  std::vector<runs::PairContact> contacts;
};

/// A list; with a reference also each `error`.
[[nodiscard]] Json to_json(const std::vector<runs::PairContact>& contacts,
                           const std::vector<runs::PairContact>* reference);

/// A table for each pair that touched in any run, the reference last; empty if
/// none did. If a pair was not in contact in a run, its row states it.
[[nodiscard]] std::string to_text(const std::vector<NamedContacts>& runs,
                                  const NamedContacts& reference);

}  // namespace limber::app
