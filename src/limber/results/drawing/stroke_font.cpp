// SPDX-License-Identifier: BSD-3-Clause
#include "limber/results/drawing/stroke_font.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace limber::results {
namespace {

// The characters from the blank to '~'. Each line of a letter is a list of
// points, two digits a point: right, and up, where 2 is the base line, 7 the
// height of small letters and 9 that of capitals. Blanks separate lines.
constexpr std::array<std::string_view, 95> kGlyphs = {
    "",
    "0904 0202",
    "0907 2927",
    "1318 3338 0444 0747",
    "483919080716364543321203 2921",
    "0249 0919180809 3343423233",
    "420708192938370403122244",
    "0907",
    "19070412",
    "09171402",
    "2824 0745 0547",
    "2327 0545",
    "1201",
    "0535",
    "0202",
    "0139",
    "190803123243483919",
    "072922 1232",
    "08193948460242",
    "08193948473626 364543321203",
    "32390444",
    "490906364543321203",
    "483919080312324345361605",
    "094912",
    "190807163647483919 1605031232434536",
    "031232434839190806153546",
    "0202 0606",
    "1201 1616",
    "480542",
    "0444 0646",
    "084502",
    "08193948472524 2222",
    "43321203081939484535372716152535",
    "022942 1535",
    "02093948473606 3645433202",
    "4839190803123243",
    "02093948433202",
    "49090242 0636",
    "490902 0636",
    "48391908031232434626",
    "0209 4249 0646",
    "0222 1219 0929",
    "0312223339",
    "0209 4905 1642",
    "090242",
    "0209254942",
    "02094249",
    "190803123243483919",
    "02093948463505",
    "190803123243483919 2442",
    "02093948463505 2542",
    "483919080716364543321203",
    "0949 2922",
    "090312324349",
    "092249",
    "0912263249",
    "0249 0942",
    "092549 2522",
    "09490242",
    "19090111",
    "0931",
    "09191101",
    "072947",
    "0141",
    "0918",
    "4742 4637170603123243",
    "0902 0617374643321203",
    "4637170603123243",
    "4942 4637170603123243",
    "05454637170603123243",
    "39291812 0737",
    "4741301001 4637170603123243",
    "0902 0617374642",
    "0702 0909",
    "171100 1919",
    "0902 3704 1532",
    "090312",
    "0702 06172622 26374642",
    "0702 0617374642",
    "170603123243463717",
    "0700 0617374643321203",
    "4740 4637170603123243",
    "0702 051737",
    "46371706153443321203",
    "19132232 0737",
    "0703123243 4742",
    "072247",
    "0712253247",
    "0247 0742",
    "0722 471000",
    "07470242",
    "29181605141221",
    "0901",
    "09181625141201",
    "05163546"};
constexpr double kBase = 2.0;
constexpr double kCapitals = 7.0;  // from the base line
constexpr double kGap = 2.0;       // between letters
constexpr double kBlank = 2.0;     // width of the blank

std::string_view find_glyph(char c) {
  const bool is_known = c >= ' ' && c <= '~';
  return kGlyphs[static_cast<std::size_t>((is_known ? c : '?') - ' ')];
}

// Of several bytes, all but the first.
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U;
}

double find_width(std::string_view glyph) {
  if (glyph.empty()) return kBlank;
  double width = 0.0;
  for (std::size_t i = 0; i < glyph.size(); i += glyph[i] == ' ' ? 1 : 2) {
    if (glyph[i] != ' ') width = std::max(width, double(glyph[i] - '0'));
  }
  return width;
}

}  // namespace

std::vector<Stroke> find_strokes(const std::string& text) {
  std::vector<Stroke> strokes;
  double start = 0.0;
  for (const char c : text) {
    if (is_continuation(c)) continue;
    const std::string_view glyph = find_glyph(c);
    const auto point = [&](std::size_t i) -> Eigen::Vector2d {
      return {(start + glyph[i] - '0') / kCapitals,
              (glyph[i + 1] - '0' - kBase) / kCapitals};
    };
    for (std::size_t i = 0; i < glyph.size(); i += 2) {
      if (glyph[i] == ' ') ++i;
      const bool is_last = i + 2 >= glyph.size() || glyph[i + 2] == ' ';
      const bool is_first = i == 0 || glyph[i - 1] == ' ';
      if (is_last && !is_first) continue;
      strokes.push_back({point(i), point(is_last ? i : i + 2)});
    }
    start += find_width(glyph) + kGap;
  }
  return strokes;
}

double find_text_width(const std::string& text) {
  double width = 0.0;
  for (const char c : text) {
    if (!is_continuation(c)) width += find_width(find_glyph(c)) + kGap;
  }
  return std::max(width - kGap, 0.0) / kCapitals;
}

}  // namespace limber::results
