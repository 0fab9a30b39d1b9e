// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "metamorphic/contact_plan.hpp"

namespace limber::metamorphic {

/// A strike changed in a way that cannot matter.
struct ChangedContact {
  ContactPlan plan;
  /// Turns the changed strike's bodies into what the first one's should be.
  std::function<void(Strike::Body&)> undo = [](Strike::Body&) {};
  /// Where and how fast its bodies are at most, beyond the first ones.
  double place = 0.0;  ///< [m]
  double speed = 0.0;  ///< [m/s]
};

struct ContactRelation {
  std::string name;
  /// Nothing for a strike to which the relation does not apply.
  std::function<std::optional<ChangedContact>(const ContactPlan&, RandomDraw&)>
      change;
};

/// For messages of tests.
inline void PrintTo(const ContactRelation& relation, std::ostream* out) {
  *out << relation.name;
}

[[nodiscard]] std::vector<ContactRelation> contact_relations();

}  // namespace limber::metamorphic
