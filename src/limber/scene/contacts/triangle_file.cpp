// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/triangle_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/scene/contacts/dae_file.hpp"

namespace limber::scene {
namespace {

constexpr InputKind kMesh = {"mesh", std::uint64_t{1} << 28};
constexpr std::size_t kMostTriangles = 500000;

/// Binary STL: 80 bytes of text and the number of triangles, in 4; then for
/// each triangle a normal and three corners as floats, and two bytes more.
constexpr std::size_t kStlHead = 84;
constexpr std::size_t kStlRecord = 50;

class Reader {
 public:
  Reader(const std::filesystem::path& file, std::string_view text)
      : file_(file), text_(text) {}

  std::vector<Triangle> read_binary_stl() {
    const std::size_t count = find_binary_count();
    check_count(count);
    triangles_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::array<float, 9> numbers{};
      std::memcpy(numbers.data(), text_.data() + kStlHead + i * kStlRecord + 12,
                  sizeof(numbers));
      Triangle triangle;
      for (std::size_t k = 0; k < 9; ++k) {
        if (!std::isfinite(numbers[k])) {
          refuse(
              fmt::format("its triangle {} has a coordinate that is not "
                          "finite",
                          i + 1));
        }
        triangle[k / 3][static_cast<Eigen::Index>(k % 3)] = double{numbers[k]};
      }
      triangles_.push_back(triangle);
    }
    return finish();
  }

  std::vector<Triangle> read_text_stl() {
    Triangle triangle;
    std::size_t corners = 0;
    for_each_line([&](const std::vector<std::string_view>& words) {
      if (words[0] == "vertex") {
        if (corners == 3) refuse_line("more than three corners in a facet");
        triangle[corners++] = read_point(words);
      } else if (words[0] == "endfacet") {
        if (corners != 3) refuse_line("a facet without three corners");
        add(triangle);
        corners = 0;
      }
    });
    if (corners != 0) refuse("it ends within a facet");
    return finish();
  }

  std::vector<Triangle> read_obj() {
    std::vector<Vector3> points;
    std::vector<Vector3> polygon;
    for_each_line([&](const std::vector<std::string_view>& words) {
      if (words[0] == "v") points.push_back(read_point(words));
      if (words[0] != "f") return;
      if (words.size() < 4) refuse_line("a face of fewer than three corners");
      polygon.clear();
      for (std::size_t i = 1; i < words.size(); ++i) {
        polygon.push_back(points[read_index(words[i], points.size())]);
      }
      for (std::size_t i = 2; i < polygon.size(); ++i) {
        add({polygon[0], polygon[i - 1], polygon[i]});
      }
    });
    return finish();
  }

  [[nodiscard]] bool is_binary_stl() const {
    return text_.size() >= kStlHead &&
           text_.size() == kStlHead + kStlRecord * find_binary_count();
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("mesh '{}': {}", file_.string(), why));
  }

 private:
  [[nodiscard]] std::size_t find_binary_count() const {
    std::uint32_t count = 0;
    std::memcpy(&count, text_.data() + kStlHead - sizeof(count), sizeof(count));
    return count;
  }

  template <typename Use>
  void for_each_line(const Use& use) {
    std::size_t begin = 0;
    while (begin < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', begin), text_.size());
      ++line_;
      const auto words = split_words(text_.substr(begin, end - begin));
      if (!words.empty()) use(words);
      begin = end + 1;
    }
  }

  [[noreturn]] void refuse_line(const std::string& why) const {
    refuse(fmt::format("line {}: {}", line_, why));
  }

  [[nodiscard]] Vector3 read_point(
      const std::vector<std::string_view>& words) const {
    Vector3 point = Vector3::Zero();
    if (words.size() < 4) refuse_line("a point without three coordinates");
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = parse_number(words[i + 1]);
      if (!number) {
        refuse_line(
            fmt::format("'{}' is not a finite number", echo(words[i + 1])));
      }
      point[static_cast<Eigen::Index>(i)] = *number;
    }
    return point;
  }

  // Of "7", "7/1/3" or, from the end, "-1".
  [[nodiscard]] std::size_t read_index(std::string_view word,
                                       std::size_t points) const {
    const std::string_view text = word.substr(0, word.find('/'));
    long long number = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number =
        error == std::errc{} && end == text.data() + text.size();
    const auto most = static_cast<long long>(points);
    if (!is_number || number == 0 || number > most || number < -most) {
      refuse_line(
          fmt::format("corner '{}'; expected the number of one of the {} "
                      "points above",
                      echo(word), points));
    }
    return static_cast<std::size_t>(number > 0 ? number - 1 : most + number);
  }

  void add(const Triangle& triangle) {
    triangles_.push_back(triangle);
    check_count(triangles_.size());
  }

  void check_count(std::size_t count) const {
    if (count <= kMostTriangles) return;
    refuse(fmt::format("it has more than {} triangles; simplify it",
                       kMostTriangles));
  }

  std::vector<Triangle> finish() {
    if (triangles_.empty()) refuse("it has no triangles");
    return std::move(triangles_);
  }

  const std::filesystem::path& file_;
  std::string_view text_;
  std::size_t line_ = 0;
  std::vector<Triangle> triangles_;
};

std::string find_kind(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return kind;
}

std::vector<Triangle> read_dae(const std::filesystem::path& file,
                               const std::string& text) {
  const std::string obj = convert_dae(file);
  std::vector<Triangle> triangles = Reader(file, obj).read_obj();
  const Matrix3 axes = find_dae_axes(text);
  for (Triangle& triangle : triangles) {
    for (Vector3& x : triangle) x = axes * x;
  }
  return triangles;
}

}  // namespace

std::vector<Triangle> read_triangles(const std::filesystem::path& file) {
  const std::string text = read_input(file, kMesh);
  const std::string kind = find_kind(file);
  if (kind == ".dae") return read_dae(file, text);
  Reader reader(file, text);
  if (kind == ".obj") return reader.read_obj();
  if (kind != ".stl") {
    reader.refuse("its kind is not known; expected a file .stl, .obj or .dae");
  }
  if (reader.is_binary_stl()) return reader.read_binary_stl();
  if (text.rfind("solid", 0) != 0) {
    reader.refuse(
        "it is neither a text that begins with 'solid' nor a binary STL file "
        "of the length that it names");
  }
  return reader.read_text_stl();
}

std::vector<Triangle> read_triangles(const MeshGeometry& mesh) {
  std::vector<Triangle> triangles = read_triangles(mesh.file);
  const bool mirrors = mesh.scale.prod() < 0.0;
  for (Triangle& triangle : triangles) {
    for (Vector3& x : triangle) x = x.cwiseProduct(mesh.scale);
    if (mirrors) std::swap(triangle[1], triangle[2]);
  }
  return triangles;
}

}  // namespace limber::scene
