// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/contact_probe_reader.hpp"

#include <fmt/format.h>

namespace limber::scene {
namespace {

const std::vector<std::pair<std::string, ContactQuantity>> kContactQuantities =
    {{"force", ContactQuantity::force},
     {"normal_force", ContactQuantity::normal_force},
     {"friction_force", ContactQuantity::friction_force},
     {"place", ContactQuantity::place},
     {"depth", ContactQuantity::depth},
     {"area", ContactQuantity::area},
     {"energy", ContactQuantity::energy},
     {"touching", ContactQuantity::touching},
     {"slipping", ContactQuantity::slipping}};

void refuse_others(TomlTable& table) {
  for (const char* other : {"link", "joint", "coupler"}) {
    if (!table.has(other)) continue;
    table.fail(fmt::format("has both '{}' and 'contact'; keep one", other));
    table.skip(other);
  }
  if (table.has("side")) {
    table.fail("side",
               "applies only to couplers; a contact's force is that on the "
               "second body of 'contact'");
    table.skip("side");
  }
  if (table.has("frame")) {
    table.fail("frame",
               "applies only to couplers; vectors of a contact are in the "
               "world frame");
    table.skip("frame");
  }
}

}  // namespace

ContactProbeSpec read_contact_probe(TomlTable& table) {
  ContactProbeSpec probe;
  const auto names = table.texts("contact");
  if (names && names->size() == 2) {
    probe.bodies = {(*names)[0], (*names)[1]};
  } else if (names) {
    table.fail("contact",
               fmt::format("has {} names; expected those of two bodies",
                           names->size()));
  }
  refuse_others(table);
  probe.quantity = read_choice<ContactQuantity>(
      table, "quantity", kContactQuantities, probe.quantity);
  return probe;
}

}  // namespace limber::scene
