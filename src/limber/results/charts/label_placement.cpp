// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/charts/label_placement.hpp"

#include <algorithm>
#include <array>

namespace limber::results {
namespace {

// For a sans-serif font of ten points at 96 dots per inch.
constexpr double kLetter = 7.0;
constexpr double kLine = 15.0;
constexpr double kMarker = 6.0;  // half its width
constexpr double kGap = 9.0;     // from a point to its label

struct Box {
  double left = 0.0;
  double right = 0.0;
  double bottom = 0.0;
  double top = 0.0;

  [[nodiscard]] bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top &&
           other.bottom < top;
  }
};

Box find_box(const LabelPlace& place, const std::string& text) {
  const double length = kLetter * static_cast<double>(text.size());
  const double left = place.reaches_right ? place.x : place.x - length;
  return {left, left + length, place.y - 0.5 * kLine, place.y + 0.5 * kLine};
}

}  // namespace

std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<LabelledPoint>& points, double width, double height,
    const std::vector<double>& lines) {
  std::vector<Box> taken;
  for (const double y : lines) taken.push_back({0.0, width, y, y});
  for (const LabelledPoint& p : points) {
    taken.push_back(
        {p.x - kMarker, p.x + kMarker, p.y - kMarker, p.y + kMarker});
  }
  std::vector<std::optional<LabelPlace>> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LabelledPoint& p = points[i];
    if (p.text.empty()) continue;
    const std::array<LabelPlace, 4> choices = {
        LabelPlace{p.x + kGap, p.y + kGap, true},
        LabelPlace{p.x + kGap, p.y - kGap, true},
        LabelPlace{p.x - kGap, p.y + kGap, false},
        LabelPlace{p.x - kGap, p.y - kGap, false}};
    for (const LabelPlace& choice : choices) {
      const Box box = find_box(choice, p.text);
      const bool is_inside = box.left > 0.0 && box.right < width &&
                             box.bottom > 0.0 && box.top < height;
      const auto meets = [&](const Box& other) { return box.meets(other); };
      if (!is_inside || std::any_of(taken.begin(), taken.end(), meets)) {
        continue;
      }
      places[i] = choice;
      taken.push_back(box);
      break;
    }
  }
  return places;
}

}  // namespace limber::results
