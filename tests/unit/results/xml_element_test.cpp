// SPDX-License-Identifier: BSD-3-Clause
#include "xml_element.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace limber::results::test::xml_element_test {
namespace {

TEST(ParseXml, RefusesWhatIsNotWellFormed) {
  for (const char* document :
       {"", "<a>", "<a></b>", "<a><b></a></b>", "<a/><a/>", "<a>&</a>",
        "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a b=1/>",
        "<a b=\"1\"c=\"2\"/>", "<a></a>x", "<1/>"}) {
    EXPECT_THROW((void)parse_xml(document), std::runtime_error) << document;
  }
}

TEST(ParseXml, FindsElementsAttributesAndTexts) {
  const XmlElement root = parse_xml(
      "<?xml version=\"1.0\"?>\n<a b=\"1 &amp; 2\"><c>x</c>\n<c/>&lt;</a>\n");
  EXPECT_EQ(root.tag, "a");
  EXPECT_EQ(root.attributes.at("b"), "1 & 2");
  EXPECT_EQ(root.text, "\n<");
  ASSERT_EQ(find_children(root, "c").size(), 2U);
  EXPECT_EQ(find_children(root, "c")[0].text, "x");
}

}  // namespace
}  // namespace limber::results::test::xml_element_test
