// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace limber::results::test {

/// One element of an XML document.
struct XmlElement {
  std::string tag;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< its own, without its children's
  std::vector<XmlElement> children;
};

/// The children called `tag`.
[[nodiscard]] std::vector<XmlElement> find_children(const XmlElement& element,
                                                    const std::string& tag);

/// Root of a document of elements, attributes, text and the five predefined
/// entities, which is all that we write. (The tests of this layer link no XML
/// library.)
/// @throws std::runtime_error if it is not well-formed.
[[nodiscard]] XmlElement parse_xml(const std::string& document);

}  // namespace limber::results::test
