// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/akantu_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/names.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/scene/text/range.hpp"

namespace limber::scene {
namespace {

constexpr InputKind kMaterial = {"material file", std::uint64_t{1} << 26};

struct Token {
  std::string text;
  int line = 0;
};

/// Words, '[', ']' and '='; '#' starts a comment.
std::vector<Token> read_tokens(std::istream& stream) {
  std::vector<Token> tokens;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    line.resize(std::min(line.size(), line.find('#')));
    std::string word;
    const auto end_word = [&] {
      if (!word.empty()) tokens.push_back({word, number});
      word.clear();
    };
    for (const char c : line) {
      const bool is_mark = c == '[' || c == ']' || c == '=';
      if (is_mark || std::isspace(static_cast<unsigned char>(c)) != 0) {
        end_word();
        if (is_mark) tokens.push_back({std::string(1, c), number});
      } else {
        word += c;
      }
    }
    end_word();
  }
  return tokens;
}

class Parser {
 public:
  Parser(const std::filesystem::path& file, std::vector<Token> tokens)
      : file_(file), tokens_(std::move(tokens)) {}

  std::vector<flexbody::MaterialRegion> run() {
    std::vector<flexbody::MaterialRegion> regions;
    while (!is_end()) {
      if (take().text != "material") continue;  // other sections are ignored
      regions.push_back(read_section());
    }
    if (regions.empty()) {
      throw InputError(fmt::format(
          "{}: has no 'material elastic [ ... ]' section", file_.string()));
    }
    if (regions.size() == 1) regions[0].group.clear();
    return regions;
  }

 private:
  [[nodiscard]] bool is_end() const { return next_ == tokens_.size(); }

  const Token& take() {
    if (is_end()) fail("the file ends within a section");
    return tokens_[next_++];
  }

  [[noreturn]] void fail(const std::string& what) const {
    const int line = next_ == 0 ? 1 : tokens_[next_ - 1].line;
    throw InputError(fmt::format("{}:{}: {}", file_.string(), line, what));
  }

  void expect(const std::string& mark) {
    const Token& token = take();
    if (token.text != mark) {
      fail(fmt::format("expected '{}', found '{}'", mark, echo(token.text)));
    }
  }

  double number(const std::string& key, const std::string& text,
                const Range& range) {
    const std::optional<double> value = parse_number(text);
    if (!value || !range.contains(*value)) {
      fail(fmt::format("{} is '{}'; expected a number {}", key, echo(text),
                       range.text()));
    }
    return *value;
  }

  flexbody::MaterialRegion read_section() {
    if (const std::string law = take().text; law != "elastic") {
      fail(
          fmt::format("material law '{}'; only 'elastic' is known", echo(law)));
    }
    expect("[");
    flexbody::MaterialRegion region;
    std::map<std::string, bool> given;
    for (std::string key = take().text; key != "]"; key = take().text) {
      expect("=");
      set(region, key, take().text);
      given[key] = true;
    }
    for (const char* key : {"rho", "E"}) {
      if (!given[key]) fail(fmt::format("the section has no '{}'", key));
    }
    return region;
  }

  void set(flexbody::MaterialRegion& region, const std::string& key,
           const std::string& value) {
    if (key == "name") {
      if (has_control(value)) {
        fail(fmt::format("name '{}' has a control character", echo(value)));
      }
      region.group = value;
    } else if (key == "rho") {
      region.material.density = number("rho [kg/m^3]", value, kPositive);
    } else if (key == "E") {
      region.material.youngs_modulus = number("E [Pa]", value, kPositive);
    } else if (key == "nu") {
      region.material.poisson_ratio =
          number("nu", value, {-1.0, 0.5, true, true});
    } else {
      fail(describe_unknown("parameter", key, {"name", "rho", "E", "nu"}));
    }
  }

  const std::filesystem::path& file_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<flexbody::MaterialRegion> read_akantu_materials(
    const std::filesystem::path& file) {
  std::istringstream stream(read_input(file, kMaterial));
  return Parser(file, read_tokens(stream)).run();
}

}  // namespace limber::scene
