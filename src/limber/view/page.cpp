// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/page.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <string>

#include "limber/common/errors.hpp"
#include "limber/common/files/own_data.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/view/page_arrays.hpp"
#include "limber/view/page_data.hpp"

namespace limber::view {
namespace {

namespace fs = std::filesystem;

/// Place of the data; src/limber/view/page/index.html contains it once.
constexpr std::string_view kMark = "LIMBER-DATA-HERE";
constexpr const char* kName = "view.html";

std::string read_template() {
  const fs::path file = find_template();
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.find(kMark) == std::string::npos) {
    throw InputError(
        fmt::format("'{}' is damaged; install Limber again", file.string()));
  }
  return text;
}

}  // namespace

fs::path find_template() {
  fs::path page = find_own_data(kName);
  if (!page.empty()) return page;
  const std::array<fs::path, 3> places = list_data_places(kName);
  throw InputError(fmt::format(
      "the page '{}' was not found; looked for {}, {} and {}. The build makes "
      "it with node and npm and reported what was missing; install them "
      "(scripts/install-deps) and build again",
      kName, places[0].string(), places[1].string(), places[2].string()));
}

void write_page(const fs::path& file, std::span<const Recording> recordings) {
  std::string page = read_template();
  page.replace(page.find(kMark), kMark.size(),
               encode_base64(make_page_data(recordings)));
  write_whole(file, page);
}

}  // namespace limber::view
