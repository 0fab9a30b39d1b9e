// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/xml_element.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "limber/common/echo.hpp"
#include "limber/common/names.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/common/roll_pitch_yaw.hpp"

namespace limber::scene {
void XmlElement::fail(const std::string& text) const {
  problems_.add(line(), fmt::format("<{}> {}", tag(), text));
}

bool XmlElement::has(const std::string& name) { return text(name).has_value(); }

std::optional<std::string> XmlElement::text(const std::string& name) {
  known_.insert(name);
  const std::string* value = element_.Attribute(name);
  if (value == nullptr) return std::nullopt;
  return *value;
}

std::string XmlElement::required_text(const std::string& name) {
  const std::optional<std::string> value = text(name);
  if (!value || value->empty()) fail(fmt::format("needs '{}'", name));
  return value.value_or("");
}

std::optional<std::vector<double>> XmlElement::numbers(const std::string& name,
                                                       const Range& range) {
  const std::optional<std::string> value = text(name);
  if (!value) return std::nullopt;
  std::vector<double> result;
  for (const std::string_view word : split_words(*value)) {
    const std::optional<double> number = parse_number(word);
    if (!number || !range.contains(*number)) {
      fail(fmt::format("{}=\"{}\": expected {}", name, echo(*value),
                       range.text()));
      return std::nullopt;
    }
    result.push_back(*number);
  }
  return result;
}

std::optional<double> XmlElement::number(const std::string& name,
                                         const Range& range) {
  const std::optional<std::vector<double>> values = numbers(name, range);
  if (!values) return std::nullopt;
  if (values->size() != 1) {
    fail(fmt::format("{}: expected one number, got {}", name, values->size()));
    return std::nullopt;
  }
  return values->front();
}

double XmlElement::required_number(const std::string& name,
                                   const Range& range) {
  if (element_.Attribute(name) == nullptr)
    fail(fmt::format("needs '{}'", name));
  return number(name, range).value_or(1.0);
}

std::optional<int> XmlElement::integer(const std::string& name, int lower,
                                       int upper) {
  const Range range{double(lower), double(upper), false, false};
  const std::optional<double> value = number(name, range);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) {
    fail(fmt::format("{}={}: expected a whole number", name, *value));
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

std::optional<bool> XmlElement::boolean(const std::string& name) {
  const std::optional<std::string> value = text(name);
  if (!value) return std::nullopt;
  if (*value == "true" || *value == "1") return true;
  if (*value == "false" || *value == "0") return false;
  fail(fmt::format("{}=\"{}\": expected true or false", name, echo(*value)));
  return std::nullopt;
}

std::optional<Vector3> XmlElement::vector(const std::string& name,
                                          const Range& range) {
  const std::optional<std::vector<double>> values = numbers(name, range);
  if (!values) return std::nullopt;
  if (values->size() != 3) {
    fail(fmt::format("{}: expected three numbers, got {}", name,
                     values->size()));
    return std::nullopt;
  }
  return Vector3((*values)[0], (*values)[1], (*values)[2]);
}

Pose XmlElement::pose() {
  Pose pose;
  pose.p = vector("xyz").value_or(Vector3::Zero());
  pose.R = rotation_rpy(vector("rpy").value_or(Vector3::Zero()));
  return pose;
}

void XmlElement::finish() const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const TiXmlAttribute* a = element_.FirstAttribute(); a != nullptr;
       a = a->Next()) {
    if (known_.count(a->Name()) == 0) {
      fail(describe_unknown("attribute", a->Name(), known));
    }
  }
  for (const TiXmlNode* child = element_.FirstChild(); child != nullptr;
       child = child->NextSibling()) {
    if (child->ToText() != nullptr) {
      problems_.add(child->Row(),
                    fmt::format("<{}> holds the text '{}', which is not read; "
                                "expected attributes",
                                tag(), echo(child->ValueStr())));
    } else if (child->ToElement() != nullptr && !has_read_children_) {
      problems_.add(child->Row(),
                    fmt::format("<{}> takes no elements; it has a <{}>", tag(),
                                echo(child->ValueStr())));
    }
  }
}

void XmlElement::read_children(const std::map<std::string, Reader>& readers) {
  has_read_children_ = true;
  std::vector<std::string> known;
  for (const auto& [name, reader] : readers) known.push_back(name);
  for (const TiXmlElement* child = element_.FirstChildElement();
       child != nullptr; child = child->NextSiblingElement()) {
    XmlElement element(*child, problems_);
    const auto found = readers.find(child->ValueStr());
    if (found == readers.end()) {
      problems_.add(
          child->Row(),
          fmt::format("in <{}>: {}", tag(),
                      describe_unknown("element", child->ValueStr(), known)));
      continue;
    }
    found->second(element);
    element.finish();
  }
}

}  // namespace limber::scene
