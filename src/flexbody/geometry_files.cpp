// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/geometry_files.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace limber::flexbody {
namespace {

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A piece of a geometry's text: a name, a string, or one other sign.
struct Token {
  enum class Kind { end, name, text, sign } kind = Kind::end;
  std::string_view value;
};

/// Reads tokens one after another; comments and blanks are none.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : rest_(text) {}

  Token next() {
    skip_blanks();
    if (rest_.empty()) return {};
    if (rest_[0] == '"' || rest_[0] == '\'') return take_text();
    if (!is_letter(rest_[0])) return {Token::Kind::sign, take(1)};
    const auto end = std::find_if_not(rest_.begin(), rest_.end(), is_letter);
    return {Token::Kind::name,
            take(static_cast<std::size_t>(end - rest_.begin()))};
  }

 private:
  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  Token take_text() {
    const std::size_t end = rest_.find(rest_[0], 1);
    const std::string_view whole =
        take(end == std::string_view::npos ? end : end + 1);
    const std::size_t quotes = end == std::string_view::npos ? 1 : 2;
    return {Token::Kind::text, whole.substr(1, whole.size() - quotes)};
  }

  void skip_blanks() {
    while (!rest_.empty()) {
      if (rest_.starts_with("//")) {
        take(rest_.find('\n'));
      } else if (rest_.starts_with("/*")) {
        const std::size_t end = rest_.find("*/", 2);
        take(end == std::string_view::npos ? end : end + 2);
      } else if (std::isspace(static_cast<unsigned char>(rest_[0])) != 0) {
        take(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
};

/// Names that have to do with files: Include, Merge, MergeWithBoundingBox,
/// ShapeFromFile, ListFromFile, FileExists, Field[1].FileName ...
bool takes_file(std::string_view name) {
  return name.starts_with("Include") || name.starts_with("Merge") ||
         name.find("File") != std::string_view::npos;
}

/// Names behind which files can be that no text shows.
bool hides_files(std::string_view name) {
  return name == "Plugin" || name == "Parse" || name.starts_with("Onelab") ||
         name == "GetEnv";
}

/// The string that follows directly, but for "(" or "=", and ends there.
std::optional<std::string> take_name(Tokens& tokens) {
  Token token = tokens.next();
  while (token.value == "(" || token.value == "=") token = tokens.next();
  if (token.kind != Token::Kind::text) return std::nullopt;
  const Token after = tokens.next();
  const bool ends = after.kind == Token::Kind::sign &&
                    (after.value == ";" || after.value == ")");
  if (!ends) return std::nullopt;
  return std::string(token.value);
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return {};
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_geometry(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".geo";
}

class Search {
 public:
  explicit Search(std::filesystem::path root) : root_(std::move(root)) {}

  void add(const std::filesystem::path& file) {
    const std::filesystem::path place = file.lexically_normal();
    auto& files = found_.files;
    if (std::find(files.begin(), files.end(), place) != files.end()) return;
    files.push_back(place);
    const std::string text = read_text(place);
    // A mesh or shape may say "File" too, and runs nothing.
    const bool is_data = text.starts_with("$MeshFormat") ||
                         text.find("ISO-10303-21") < 1000 ||
                         text.find("DBRep_DrawableShape") < 1000;
    if (!is_data) follow(text, place.parent_path());
    if (is_geometry(place)) add(place.string() + ".opt");
  }
  [[nodiscard]] GeometryFiles found() const { return found_; }

 private:
  void follow(std::string_view text, const std::filesystem::path& folder) {
    Tokens tokens(text);
    for (Token token = tokens.next(); token.kind != Token::Kind::end;
         token = tokens.next()) {
      if (token.kind != Token::Kind::name) continue;
      if (hides_files(token.value)) found_.is_complete = false;
      if (!takes_file(token.value)) continue;
      if (const auto name = take_name(tokens)) {
        add(folder / *name);
        add(root_ / *name);  // where Gmsh looks next
      } else {
        found_.is_complete = false;
      }
    }
  }

  std::filesystem::path root_;
  GeometryFiles found_;
};

}  // namespace

GeometryFiles find_geometry_files(const std::filesystem::path& file) {
  if (!is_geometry(file)) return {{file}, true};
  Search search(file.parent_path());
  search.add(file);
  return search.found();
}

}  // namespace limber::flexbody
