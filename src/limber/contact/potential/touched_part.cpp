// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/touched_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace limber::contact {
namespace {

constexpr double kGolden = 0.6180339887498949;
constexpr int kMostSteps = 70;
// Of the deepest place within the touched lines.
constexpr int kStepsToDeepest = 16;
constexpr int kStepsToLongest = 30;
constexpr int kSectors = 8;
// Of an end of the touched lines, where the depth is 0 [-].
constexpr double kEnd = 1e-6;

struct Peak {
  double u = 0.0;
  double depth = 0.0;
};

class Search {
 public:
  Search(const RuledSurface& surface, const DepthField& body)
      : surface_(surface), body_(body), speed_(surface.find_speed()) {}

  [[nodiscard]] double find_depth(double u) const {
    const StraightLine line = surface_.find_line(u);
    return body_.find_t(line.at(body_.find_deepest(line)));
  }

  // The first line found to touch, or one of negative depth.
  [[nodiscard]] Peak find_touching(Span in) const {
    return climb(in, kMostSteps, true);
  }
  [[nodiscard]] Peak find_deepest(Span in) const {
    return climb(in, kStepsToDeepest, false);
  }

  // The sector of a closed surface that holds its deepest line.
  [[nodiscard]] Span find_sector() const {
    const double width = surface_.u.length() / kSectors;
    Peak best{0.0, find_depth(0.0)};
    for (int i = 1; i < kSectors; ++i) {
      const double depth = find_depth(i * width);
      if (depth > best.depth) best = {i * width, depth};
    }
    return {best.u - width, best.u + width};
  }

  // Of a closed surface, whose lines all touch, the line that is longest within
  // the body.
  [[nodiscard]] double find_longest() const {
    const double width = surface_.u.length() / kSectors;
    const auto find_length = [&](double u) {
      return body_.cut(surface_.find_line(u)).length();
    };
    double best = 0.0;
    for (int i = 1; i < kSectors; ++i) {
      if (find_length(i * width) > find_length(best)) best = i * width;
    }
    Span in{best - width, best + width};
    for (int i = 0; i < kStepsToLongest; ++i) {
      const double left = in.last - kGolden * in.length();
      const double right = in.first + kGolden * in.length();
      if (find_length(left) > find_length(right)) {
        in.last = right;
      } else {
        in.first = left;
      }
    }
    return in.middle();
  }

  // Where the depth ends to be positive, from a line that touches to one that
  // may not: by the rule of Illinois.
  [[nodiscard]] double find_end(const Peak& touching, double limit) const {
    Peak in = touching;
    Peak out{limit, find_depth(limit)};
    if (out.depth >= 0.0) return limit;
    int side = 0;
    for (int i = 0; i < kMostSteps; ++i) {
      if (std::abs(out.u - in.u) < kEnd * std::abs(out.u - touching.u)) break;
      const double fraction =
          i % 4 == 3 ? 0.5 : in.depth / (in.depth - out.depth);
      const double u =
          in.u + std::clamp(fraction, 1e-3, 0.999) * (out.u - in.u);
      const double depth = find_depth(u);
      if (depth > 0.0) {
        in = {u, depth};
        if (side == 1) out.depth *= 0.5;
        side = 1;
      } else {
        out = {u, std::min(depth, -1e-300)};
        if (side == -1) in.depth *= 0.5;
        side = -1;
      }
    }
    return out.u;
  }

 private:
  // Golden sections; the depth changes at most by the speed.
  [[nodiscard]] Peak climb(Span in, int steps, bool stops_at_touch) const {
    const auto at = [&](double u) { return Peak{u, find_depth(u)}; };
    Peak left = at(in.last - kGolden * in.length());
    Peak right = at(in.first + kGolden * in.length());
    for (int i = 0; i < steps; ++i) {
      const double best = std::max(left.depth, right.depth);
      if (stops_at_touch && (best > 0.0 || best + speed_ * in.length() < 0.0)) {
        break;
      }
      if (left.depth > right.depth) {
        in.last = right.u;
        right = left;
        left = at(in.last - kGolden * in.length());
      } else {
        in.first = left.u;
        left = right;
        right = at(in.first + kGolden * in.length());
      }
    }
    return left.depth > right.depth ? left : right;
  }

  const RuledSurface& surface_;
  const DepthField& body_;
  double speed_;
};

// Whether all lines of a cone touch.
bool holds_tip(const RuledSurface& surface, const Span& touched) {
  constexpr double kAll = 1.0 - 1e-9;
  return surface.narrows() && touched.length() > kAll * surface.u.length();
}

// Which ends and faces the part of a line within the body has; 0: none.
std::uint64_t describe_line(const RuledSurface& surface, const DepthField& body,
                            double u) {
  const StraightLine line = surface.find_line(u);
  const Span part = body.cut(line);
  if (part.is_empty()) return 0;
  std::uint64_t code = 1;
  if (part.first == line.span.first) code += 1;
  if (part.last == line.span.last) code += 2;
  LinePieces pieces;
  body.divide(line, part, pieces);
  int last = -1;
  for (const LinePiece& piece : pieces.all()) {
    if (piece.face != last) {
      code = 131 * code + static_cast<std::uint64_t>(piece.face) + 1;
    }
    last = piece.face;
  }
  return code;
}

// Of a polygon, corners within the body, at which the lines' ends bend.
void add_corners(const RuledSurface& surface, const DepthField& body,
                 const Span& part, Cuts& out) {
  constexpr std::size_t kMost = 128;
  for (std::size_t i = 0; i < surface.outline.size(); ++i) {
    const Eigen::Vector2d corner = surface.find_corner(i);
    if (corner[0] > part.first && corner[0] < part.last &&
        body.find_t(surface.at(corner)) > 0.0 && out.all().size() < kMost) {
      out.add() = corner[0];
    }
  }
  std::ranges::sort(out.all());
}

// Where lines of a part change.
void add_changes(const RuledSurface& surface, const DepthField& body,
                 const Span& part, Cuts& out) {
  constexpr int kSamples = 6;
  // The nearest face of flats may change along a whole line.
  const int halvings = body.is_flat() ? 45 : 22;
  constexpr double kInside = 1e-5;
  constexpr std::size_t kMost = 500;
  double u = part.first + kInside * part.length();
  std::uint64_t code = describe_line(surface, body, u);
  for (int i = 1; i <= kSamples; ++i) {
    const double fraction =
        i == kSamples ? 1.0 - kInside : static_cast<double>(i) / kSamples;
    const double end = part.first + fraction * part.length();
    const std::uint64_t next = describe_line(surface, body, end);
    while (code != next && out.all().size() < kMost) {
      double before = u;
      double after = end;
      std::uint64_t found = next;
      for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (before + after);
        const std::uint64_t at = describe_line(surface, body, middle);
        if (at == code) {
          before = middle;
        } else {
          after = middle;
          found = at;
        }
      }
      out.add() = 0.5 * (before + after);
      u = after;
      code = found;
    }
    u = end;
    code = next;
  }
}

// Of lines that meet in a tip within the body, where others soon become much
// shorter than the longest one: halves, until none is a few times the next.
void add_shorter(const RuledSurface& surface, const DepthField& body,
                 Cuts& cuts) {
  constexpr double kShorter = 0.3;
  constexpr double kNarrowest = 1e-5;  // [rad]
  constexpr std::size_t kMost = 200;
  const auto find_length = [&](double u) {
    return body.cut(surface.find_line(u)).length();
  };
  for (std::size_t i = 0; i + 1 < cuts.all().size();) {
    const Span span{cuts.all()[i], cuts.all()[i + 1]};
    const double a = find_length(span.first);
    const double b = find_length(span.last);
    const bool is_even = std::min(a, b) >= kShorter * std::max(a, b);
    if (is_even || span.length() < kNarrowest || cuts.all().size() >= kMost) {
      ++i;
      continue;
    }
    cuts.add() = span.middle();
    std::ranges::sort(cuts.all());
  }
}

}  // namespace

std::optional<TouchedPart> find_touched_part(const RuledSurface& surface,
                                             const DepthField& body) {
  const Search search(surface, body);
  const Span all = surface.u;
  const bool is_closed = surface.is_closed();
  const Peak touching =
      search.find_touching(is_closed ? search.find_sector() : all);
  if (!(touching.depth > 0.0)) return {};
  const double half = 0.5 * all.length();
  const double middle = is_closed ? touching.u : all.middle();
  TouchedPart part;
  part.u = {search.find_end(touching, middle - half),
            search.find_end(touching, middle + half)};
  if (holds_tip(surface, part.u)) {
    const double longest = search.find_longest();
    part.u = {longest - half, longest + half};
  }
  Peak deepest = search.find_deepest(part.u);
  if (touching.depth > deepest.depth) deepest = touching;
  const StraightLine line = surface.find_line(deepest.u);
  part.place = line.at(body.find_deepest(line));
  part.depth = deepest.depth;
  return part;
}

void find_cuts(const RuledSurface& surface, const DepthField& body,
               const Span& part, Cuts& out) {
  Cuts corners;
  add_corners(surface, body, part, corners);
  out.add() = part.first;
  double first = part.first;
  const auto add_part = [&](double last) {
    if (!(last > first)) return;
    add_changes(surface, body, {first, last}, out);
    out.add() = last;
    first = last;
  };
  const bool is_around_tip = holds_tip(surface, part);
  for (const double corner : corners.all()) add_part(corner);
  if (is_around_tip) add_part(part.middle());
  add_part(part.last);
  if (is_around_tip) add_shorter(surface, body, out);
  if (surface.is_closed() && out.all().size() == 2) {
    out.all()[1] = part.middle();
    out.add() = part.last;
  }
}

}  // namespace limber::contact
