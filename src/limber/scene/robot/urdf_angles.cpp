// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/urdf_angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "limber/common/echo.hpp"

namespace limber::scene {
namespace {

/// The largest angle of an element's `rpy` [rad].
double find_largest_rpy(const TiXmlElement& element) {
  const char* text = element.Attribute("rpy");
  if (text == nullptr) return 0.0;
  std::istringstream stream(text);
  double largest = 0.0;
  for (double angle = 0.0; stream >> angle;) {
    largest = std::max(largest, std::abs(angle));
  }
  return largest;
}

/// "joint 'elbow': <origin>"
std::string describe_owner(const TiXmlElement& element) {
  const std::string tag = fmt::format("<{}>", element.ValueStr());
  const TiXmlNode* at = &element;
  for (; at != nullptr && at->ToElement() != nullptr; at = at->Parent()) {
    const TiXmlElement& owner = *at->ToElement();
    for (const char* key : {"name", "link", "joint"}) {
      const char* name = owner.Attribute(key);
      if (name == nullptr) continue;
      return fmt::format("{} '{}'{}", echo(owner.ValueStr()), echo(name),
                         &owner == &element ? "" : ", " + tag);
    }
  }
  return tag;
}

}  // namespace

std::optional<std::string> question_rpy(const TiXmlElement& robot,
                                        const Problems& problems) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounded = 1.001;  // 6.2832 is one turn
  const TiXmlElement* first = nullptr;
  std::size_t count = 0;
  std::vector<const TiXmlElement*> left = {&robot};
  while (!left.empty()) {
    const TiXmlElement* element = left.back();
    left.pop_back();
    if (find_largest_rpy(*element) > kRounded * kTurn) {
      ++count;
      if (first == nullptr || element->Row() < first->Row()) first = element;
    }
    for (const TiXmlElement* child = element->FirstChildElement();
         child != nullptr; child = child->NextSiblingElement()) {
      left.push_back(child);
    }
  }
  if (first == nullptr) return std::nullopt;
  const double angle = find_largest_rpy(*first);
  const std::string others =
      count == 1 ? "" : fmt::format(", as are {} more", count - 1);
  return problems.locate(
      first->Row(),
      fmt::format("{}: rpy=\"{}\" has {:g} rad, {:.1f} turns{}; is it in "
                  "radians?",
                  describe_owner(*first), echo(first->Attribute("rpy")), angle,
                  angle / kTurn, others));
}

}  // namespace limber::scene
