// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/text/xml_depth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace limber::scene {
namespace {

constexpr auto kEnd = std::string_view::npos;

// Position after the next `mark`, or the end.
std::size_t skip_past(std::string_view xml, std::string_view mark,
                      std::size_t from) {
  const std::size_t at = xml.find(mark, from);
  return at == kEnd ? xml.size() : at + mark.size();
}

// The '>' that ends a tag, skipping attribute values.
std::size_t find_tag_end(std::string_view xml, std::size_t at) {
  while (at < xml.size() && xml[at] != '>') {
    const char c = xml[at];
    at = c == '"' || c == '\'' ? skip_past(xml, {&c, 1}, at + 1) : at + 1;
  }
  return at;
}

bool starts_name(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 127 || c == '_' || std::isalpha(byte) != 0;
}

// The markup after a '<', and its change of depth.
struct Tag {
  std::size_t end = 0;
  int step = 0;
};

Tag read_tag(std::string_view xml, std::size_t at) {
  const std::string_view rest = xml.substr(at);
  if (rest.starts_with("<!--")) return {skip_past(xml, "-->", at + 4), 0};
  if (rest.starts_with("<![CDATA[")) return {skip_past(xml, "]]>", at + 9), 0};
  if (rest.starts_with("</")) return {skip_past(xml, ">", at), -1};
  if (rest.size() < 2 || !starts_name(rest[1])) {
    return {skip_past(xml, ">", at), 0};
  }
  const std::size_t end = find_tag_end(xml, at);
  return {end, xml[end - 1] == '/' ? 0 : 1};
}

}  // namespace

void check_xml_depth(std::string_view xml, Problems& problems) {
  int depth = 0;
  for (std::size_t at = xml.find('<'); at < xml.size();) {
    const Tag tag = read_tag(xml, at);
    depth = std::max(0, depth + tag.step);
    if (depth > kMostNestedElements) {
      const auto line = 1 + std::count(xml.begin(), xml.begin() + at, '\n');
      problems.add(static_cast<int>(line),
                   fmt::format("elements are nested more than {} deep; is an "
                               "end tag missing before?",
                               kMostNestedElements));
      return;
    }
    at = xml.find('<', tag.end);
  }
}

}  // namespace limber::scene
