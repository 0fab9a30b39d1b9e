// SPDX-License-Identifier: BSD-3-Clause
#include "joints/switches.hpp"

#include "common/errors.hpp"

namespace limber::joints {
namespace {

// An element of a joint and which of its switches.
struct ElementSwitch {
  const JointElement* element = nullptr;
  int index = 0;
};

ElementSwitch find_element(const Joint& joint, int index) {
  for (const JointElement& element : joint.elements()) {
    const int count = switch_count(element.law);
    if (index < count) return {&element, index};
    index -= count;
  }
  throw ContractError("a joint's switch that is not there");
}

}  // namespace

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::stop_reached:
      return "stop reached";
    case EventKind::stop_left:
      return "stop left";
    case EventKind::taut:
      return "taut";
    case EventKind::slack:
      return "slack";
    case EventKind::latched:
      return "latched";
    case EventKind::released:
      break;
  }
  return "released";
}

int switch_count(const CouplerLaw& law) {
  if (std::holds_alternative<Latch>(law)) return Latch::switch_count();
  if (const auto* spring = std::get_if<PointSpring>(&law)) {
    return spring->switch_count();
  }
  const auto* joint = std::get_if<Joint>(&law);
  if (joint == nullptr) return 0;
  int count = 0;
  for (const JointElement& element : joint->elements()) {
    count += switch_count(element.law);
  }
  return count;
}

SwitchValue find_switch(const CouplerLaw& law, int index,
                        const RelativeMotion& motion,
                        const CouplerMemory& memory, double t) {
  LIMBER_EXPECT(index >= 0 && index < switch_count(law));
  if (const auto* latch = std::get_if<Latch>(&law)) {
    return latch->find_switch(index, motion, memory, t);
  }
  if (const auto* spring = std::get_if<PointSpring>(&law)) {
    return spring->find_switch(motion);
  }
  const auto& joint = std::get<Joint>(law);
  const ElementSwitch found = find_element(joint, index);
  const auto c = static_cast<std::size_t>(found.element->coordinate);
  const CoordinateValue value =
      evaluate(joint.coordinates()[c], motion, memory.near[c]);
  return find_switch(found.element->law, found.index, {value.z, value.rate});
}

EventKind find_event(const ScalarLaw& law, bool rises) {
  if (std::holds_alternative<EndStop>(law)) {
    return rises ? EventKind::stop_reached : EventKind::stop_left;
  }
  return rises ? EventKind::taut : EventKind::slack;
}

std::optional<EventKind> find_event(const CouplerLaw& law, int index,
                                    bool rises, const CouplerMemory& memory) {
  LIMBER_EXPECT(index >= 0 && index < switch_count(law));
  if (std::holds_alternative<Latch>(law)) {
    if (!rises) return std::nullopt;
    return index == 0 && memory.latch == LatchStatus::open
               ? EventKind::latched
               : EventKind::released;
  }
  if (std::holds_alternative<PointSpring>(law)) {
    return rises ? EventKind::taut : EventKind::slack;
  }
  return find_event(find_element(std::get<Joint>(law), index).element->law,
                    rises);
}

void update_memory(const CouplerLaw& law, int index,
                   const RelativeMotion& motion, CouplerMemory& memory) {
  if (const auto* latch = std::get_if<Latch>(&law)) {
    latch->update(index, motion, memory);
  }
}

}  // namespace limber::joints
