// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {

/// Reads the elements along the coordinates of a joint or loop: its children
/// <stop>, <friction> and <spring>.
class ActionReader {
 public:
  /// @param actions existing ones; a <stop> modifies the one on its coordinate,
  /// a <friction> replaces it.
  ActionReader(joints::JointKind kind, std::vector<JointAction>& actions);

  /// For XmlElement::read_children; they refer to this reader.
  [[nodiscard]] std::map<std::string, XmlElement::Reader> readers();

 private:
  void read_stop(XmlElement& element);
  void read_friction(XmlElement& element);
  void read_spring(XmlElement& element);
  std::optional<int> read_coordinate(XmlElement& element);
  template <typename Law>
  void put(XmlElement& element, std::optional<int> coordinate, const Law& law);
  template <typename Law>
  [[nodiscard]] const Law* find(int coordinate) const;

  std::vector<JointAction>& actions_;
  int count_;                                   ///< coordinates of the joint
  std::set<std::pair<std::string, int>> seen_;  ///< tag and coordinate
};

/// `stiffness`, `quadratic` and `table` of a spring. At least one is needed.
[[nodiscard]] joints::SpringCurve::Parameters read_curve(XmlElement& element);

}  // namespace limber::scene
