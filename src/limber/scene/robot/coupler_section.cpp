// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/coupler_section.hpp"

#include <fmt/format.h>
#include <tinyxml.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/names.hpp"
#include "limber/scene/robot/extension_reader.hpp"
#include "limber/scene/text/problems.hpp"
#include "limber/scene/text/toml_attribute.hpp"

namespace limber::scene {
namespace {

const std::vector<std::string> kTypes = {"loop",  "spring", "bushing",
                                         "latch", "tendon", "gear"};

/// An element at a line of the scenario's file.
class PlacedElement : public TiXmlElement {
 public:
  PlacedElement(const std::string& tag, const toml::node& source)
      : TiXmlElement(tag) {
    location.row = static_cast<int>(source.source().begin.line) - 1;
  }
};

class Converter {
 public:
  explicit Converter(Problems& problems) : problems_(problems) {}

  /// The element of a [[coupler]], owned by `root`; none without known type.
  void add(const toml::table& table, TiXmlElement& root) {
    const std::string type = table["type"].value<std::string>().value_or("");
    if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
      fail(table, "type: " + describe_unknown("type", type, kTypes));
      return;
    }
    root.LinkEndChild(convert(type, table, "type"));
  }

 private:
  void fail(const toml::node& at, const std::string& text) {
    problems_.add(static_cast<int>(at.source().begin.line),
                  "[[coupler]] " + text);
  }

  /// @param left_out a key without attribute
  TiXmlElement* convert(const std::string& tag, const toml::table& table,
                        const char* left_out) {
    auto element = std::make_unique<PlacedElement>(tag, table);
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (name != left_out) add_value(name, node, *element);
    }
    return element.release();
  }

  void add_value(const std::string& name, const toml::node& node,
                 TiXmlElement& element) {
    if (const toml::table* table = node.as_table()) {
      element.LinkEndChild(convert(name, *table, ""));
      return;
    }
    if (node.is_array_of_tables()) {
      for (const toml::node& entry : *node.as_array()) {
        element.LinkEndChild(convert(name, *entry.as_table(), ""));
      }
      return;
    }
    try {
      element.SetAttribute(name, to_attribute(node));
    } catch (const InputError& error) {
      fail(node, echo(name) + ": it " + error.what());
    }
  }

  Problems& problems_;
};

}  // namespace

void add_couplers(const toml::table& scenario,
                  const std::filesystem::path& file, Robot& robot) {
  const toml::node* given = scenario.get("coupler");
  if (given == nullptr) return;
  Problems problems(file.string());
  if (!given->is_array_of_tables()) {
    problems.add(static_cast<int>(given->source().begin.line),
                 "coupler: expected [[coupler]] tables");
    problems.raise();
  }
  PlacedElement root("coupler", *given);
  Converter converter(problems);
  for (const toml::node& entry : *given->as_array()) {
    converter.add(*entry.as_table(), root);
  }
  read_extension(root, robot, problems);
  problems.raise();
}

}  // namespace limber::scene
