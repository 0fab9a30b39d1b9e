// SPDX-License-Identifier: BSD-3-Clause
#include "xml_element.hpp"

#include <cctype>
#include <stdexcept>

namespace limber::results::test {
namespace {

class Parser {
 public:
  explicit Parser(const std::string& document) : text_(document) {}

  XmlElement parse_document() {
    if (take("<?xml ")) take_until("?>");
    skip_space();
    XmlElement root = parse_element();
    skip_space();
    if (at_ != text_.size()) fail("something follows the root");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error("byte " + std::to_string(at_) + ": " + why);
  }
  bool take(const std::string& word) {
    if (text_.compare(at_, word.size(), word) != 0) return false;
    at_ += word.size();
    return true;
  }
  void expect(const std::string& word) {
    if (!take(word)) fail("'" + word + "' is missing");
  }
  char peek() const {
    if (at_ >= text_.size()) fail("it ends too early");
    return text_[at_];
  }
  std::string take_until(const std::string& word) {
    const std::size_t end = text_.find(word, at_);
    if (end == std::string::npos) fail("'" + word + "' is missing");
    std::string taken = text_.substr(at_, end - at_);
    at_ = end + word.size();
    return taken;
  }
  bool skip_space() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::isspace(as_byte(text_[at_])) != 0) ++at_;
    return at_ > start;
  }
  static int as_byte(char c) { return static_cast<unsigned char>(c); }

  std::string parse_name() {
    std::string name;
    while (std::isalnum(as_byte(peek())) != 0 || peek() == '_') {
      name += text_[at_++];
    }
    if (name.empty() || std::isdigit(as_byte(name[0])) != 0) fail("no name");
    return name;
  }

  char parse_character() {
    if (peek() == '<') fail("'<' inside a text");
    if (peek() != '&') return text_[at_++];
    const std::map<std::string, char> entities = {{"&amp;", '&'},
                                                  {"&lt;", '<'},
                                                  {"&gt;", '>'},
                                                  {"&quot;", '"'},
                                                  {"&apos;", '\''}};
    for (const auto& [entity, c] : entities) {
      if (take(entity)) return c;
    }
    fail("'&' begins no entity");
  }

  // Up to '/' or '>', which ends the tag.
  void parse_attributes(XmlElement& element) {
    while (skip_space() && peek() != '/' && peek() != '>') {
      const std::string name = parse_name();
      expect("=\"");
      std::string value;
      while (peek() != '"') value += parse_character();
      expect("\"");
      if (!element.attributes.emplace(name, value).second) {
        fail("attribute " + name + " twice");
      }
    }
  }

  XmlElement parse_element() {
    XmlElement element;
    expect("<");
    element.tag = parse_name();
    parse_attributes(element);
    if (take("/>")) return element;
    expect(">");
    while (!take("</")) {
      if (peek() == '<') {
        element.children.push_back(parse_element());
      } else {
        element.text += parse_character();
      }
    }
    expect(element.tag);
    expect(">");
    return element;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<XmlElement> find_children(const XmlElement& element,
                                      const std::string& tag) {
  std::vector<XmlElement> found;
  for (const XmlElement& child : element.children) {
    if (child.tag == tag) found.push_back(child);
  }
  return found;
}

XmlElement parse_xml(const std::string& document) {
  return Parser(document).parse_document();
}

}  // namespace limber::results::test
