// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/end_reader.hpp"

#include <fmt/format.h>

#include "limber/common/roll_pitch_yaw.hpp"
#include "limber/scene/robot/place_reader.hpp"

namespace limber::scene {
namespace {

/// from="LINK/INTERFACE" or from="LINK" from_xyz="x y z".
ConnectorEnd read_end_attributes(XmlElement& element, const std::string& side) {
  ConnectorEnd end;
  const std::string text = element.required_text(side);
  const std::size_t slash = text.find('/');
  end.where.link = text.substr(0, slash);
  if (slash != std::string::npos) end.where.interface = text.substr(slash + 1);
  end.where.point = element.vector(side + "_xyz");
  return end;
}

ConnectorEnd read_turned_end(XmlElement& element) {
  ConnectorEnd end;
  end.where = read_place(element);
  end.R = rotation_rpy(element.vector("rpy").value_or(Vector3::Zero()));
  return end;
}

}  // namespace

ConnectorEnd read_end(XmlElement& element) {
  ConnectorEnd end;
  end.where = read_place(element);
  if (element.has("rpy")) {
    (void)element.vector("rpy");
    element.fail("'rpy' has no effect here; leave it out");
  }
  return end;
}

void read_ends(XmlElement& element, TurnedEnds turned, ConnectorEnd& from,
               ConnectorEnd& to,
               std::map<std::string, XmlElement::Reader> others) {
  const std::map<std::string, ConnectorEnd*> sides = {{"from", &from},
                                                      {"to", &to}};
  std::map<std::string, int> given;
  for (const auto& [side, end] : sides) {
    const bool rotates = turned == TurnedEnds::both ||
                         (turned == TurnedEnds::from && end == &from);
    others[side] = [&given, side = side, end = end,
                    rotates](XmlElement& child) {
      ++given[side];
      *end = rotates ? read_turned_end(child) : read_end(child);
    };
  }
  element.read_children(others);
  for (const auto& [side, end] : sides) {
    const int count = given[side] + (element.has(side) ? 1 : 0);
    if (count > 1) element.fail(fmt::format("has more than one '{}'", side));
    if (given[side] == 0) *end = read_end_attributes(element, side);
  }
}

}  // namespace limber::scene
