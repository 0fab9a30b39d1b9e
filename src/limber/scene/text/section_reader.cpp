// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/section_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string_view>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"

namespace limber::scene {
namespace {

std::optional<Vector3> read_direction(XmlElement& element, const char* name) {
  std::optional<Vector3> v = element.vector(name);
  if (v && !(v->norm() > 0.0))
    element.fail(fmt::format("{} is zero; expected a direction", name));
  return v;
}

std::string list_shapes() {
  std::string text;
  for (const SectionShape& shape : list_section_shapes())
    text += (text.empty() ? "" : ", ") + shape.name;
  return text;
}

const SectionShape* find_shape(XmlElement& element, const std::string& name) {
  const auto& shapes = list_section_shapes();
  const auto found = std::ranges::find(shapes, name, &SectionShape::name);
  if (found != shapes.end()) return &*found;
  if (!name.empty())
    element.fail(
        fmt::format("section=\"{}\": expected {}", echo(name), list_shapes()));
  return nullptr;
}

}  // namespace

ShellRegion read_shell(XmlElement& element) {
  ShellRegion region;
  region.group = element.text("group").value_or("");
  if (!element.has("thickness")) element.fail("needs 'thickness'");
  region.thicknesses = element.numbers("thickness", kPositive)
                           .value_or(std::vector<double>(1, 1.0));
  region.angles = element.numbers("angles").value_or(std::vector<double>());
  for (double& angle : region.angles) angle *= std::numbers::pi / 180.0;
  const std::string materials = element.text("materials").value_or("");
  for (const std::string_view name : split_words(materials))
    region.materials.emplace_back(name);
  region.axis_1 = read_direction(element, "axis_1");
  region.offset = element.number("offset").value_or(0.0);
  return region;
}

BeamRegion read_beam(XmlElement& element) {
  BeamRegion region;
  region.group = element.text("group").value_or("");
  region.section = element.required_text("section");
  if (const SectionShape* const shape = find_shape(element, region.section)) {
    for (const std::string& name : shape->sizes)
      region.sizes[name] = element.required_number(name, kPositive);
    for (const std::string& name : shape->optional)
      region.sizes[name] = element.number(name, kNonNegative).value_or(0.0);
  }
  region.y_axis = read_direction(element, "y_axis");
  region.offset = element.vector("offset").value_or(Vector3::Zero());
  return region;
}

void read_attributes(const std::string& option, const std::string& tag,
                     const std::string& attributes,
                     const XmlElement::Reader& read) {
  const std::string place = fmt::format("{} '{}'", option, echo(attributes));
  TiXmlDocument document;
  if (attributes.find_first_of("<>") == std::string::npos)
    document.Parse(fmt::format("<{} {}/>", tag, attributes).c_str());
  const TiXmlElement* const root = document.RootElement();
  if (document.Error() || root == nullptr || root->ValueStr() != tag ||
      root->NextSibling() != nullptr)
    throw InputError(fmt::format(
        "{}: expected attributes of <{}> of a robot, as in group=\"NAME\"",
        place, tag));
  Problems problems(place);
  XmlElement element(*root, problems);
  read(element);
  element.finish();
  std::vector<std::string> texts;
  // Without a line, which an option has not.
  for (std::string text : problems.texts()) {
    if (text.starts_with(place + ":1:")) text.erase(place.size(), 2);
    texts.push_back(std::move(text));
  }
  if (!texts.empty()) throw InputError(texts);
}

}  // namespace limber::scene
