// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/view_page.hpp"

#include <fmt/format.h>

#include "limber/view/page.hpp"

namespace limber::app {

std::vector<view::Recording> read_recordings(
    const std::vector<std::filesystem::path>& results) {
  std::vector<view::Recording> recordings;
  recordings.reserve(results.size());
  for (const std::filesystem::path& one : results) {
    recordings.push_back(view::read_recording(one));
  }
  return recordings;
}

std::filesystem::path add_view_to(
    const OutputFolder& folder,
    const std::vector<view::Recording>& recordings) {
  view::find_template();  // before anything is written
  folder.add([&](const std::filesystem::path& place) {
    view::write_page(place / "view.html", recordings);
  });
  return folder.path() / "view.html";
}

std::string describe_view(const std::filesystem::path& page) {
  constexpr double kMebibyte = 1024.0 * 1024.0;
  return fmt::format(
      "{} ({:.1f} MiB): open it in a browser", page.string(),
      static_cast<double>(std::filesystem::file_size(page)) / kMebibyte);
}

}  // namespace limber::app
