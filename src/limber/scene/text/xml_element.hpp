// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/scene/text/problems.hpp"
#include "limber/scene/text/range.hpp"

namespace limber::scene {

/// One XML element whose every attribute and child must be known. Wrong or
/// unknown ones are added to `problems`; reading continues with defaults.
class XmlElement {
 public:
  XmlElement(const TiXmlElement& element, Problems& problems)
      : element_(element), problems_(problems) {}

  [[nodiscard]] int line() const { return element_.Row(); }
  [[nodiscard]] std::string tag() const { return element_.ValueStr(); }
  [[nodiscard]] Problems& problems() const { return problems_; }
  void fail(const std::string& text) const;

  /// Attribute readers; each marks the name as known.
  [[nodiscard]] bool has(const std::string& name);
  [[nodiscard]] std::optional<std::string> text(const std::string& name);
  [[nodiscard]] std::string required_text(const std::string& name);
  [[nodiscard]] std::optional<double> number(const std::string& name,
                                             const Range& range = {});
  [[nodiscard]] double required_number(const std::string& name,
                                       const Range& range = {});
  [[nodiscard]] std::optional<int> integer(const std::string& name, int lower,
                                           int upper);
  [[nodiscard]] std::optional<bool> boolean(const std::string& name);
  [[nodiscard]] std::optional<std::vector<double>> numbers(
      const std::string& name, const Range& range = {});
  [[nodiscard]] std::optional<Vector3> vector(const std::string& name,
                                              const Range& range = {});
  /// `xyz` and `rpy` attributes as a pose.
  [[nodiscard]] Pose pose();

  /// Call after reading: unread attributes, unread children and text are
  /// problems.
  void finish() const;
  /// Calls the reader of each child's tag; a tag without one is a problem.
  using Reader = std::function<void(XmlElement&)>;
  void read_children(const std::map<std::string, Reader>& readers);

 private:
  const TiXmlElement& element_;
  Problems& problems_;
  std::set<std::string> known_;
  bool has_read_children_ = false;
};

}  // namespace limber::scene
