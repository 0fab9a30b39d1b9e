// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/play_page.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "limber/common/errors.hpp"
#include "limber/common/files/own_data.hpp"
#include "limber/common/files/whole_file.hpp"
#include "limber/view/compress.hpp"
#include "limber/view/page.hpp"
#include "limber/view/page_arrays.hpp"
#include "limber/view/playground_digest.hpp"

namespace limber::view {
namespace {

/// src/limber/view/page/play.html contains it once.
constexpr std::string_view kPlayMark = "LIMBER-DATA-HERE";

std::filesystem::path find_part(const std::string& name) {
  std::filesystem::path part = find_own_data(name);
  if (!part.empty()) return part;
  const std::array<std::filesystem::path, 3> places = list_data_places(name);
  throw InputError(fmt::format(
      "a page that simulates needs '{}', which was not found; looked for {}, "
      "{} and {}. scripts/playground makes it with emscripten "
      "(scripts/install-deps --with-playground), after the build, which makes "
      "the page",
      name, places[0].string(), places[1].string(), places[2].string()));
}

std::string read_part(const std::filesystem::path& part) {
  std::ifstream in(part, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in || bytes.empty()) {
    throw InputError(
        fmt::format("'{}' cannot be read; make it again", part.string()));
  }
  return bytes;
}

/// The module's script, whose first line names its sources.
std::string read_glue() {
  const std::filesystem::path part = find_part("playground.js");
  std::string glue = read_part(part);
  if (!glue.starts_with(fmt::format("// {}\n", playground_digest()))) {
    throw InputError(fmt::format(
        "'{}' was compiled from other sources than this command, and might "
        "give other results; scripts/playground makes it again, or install "
        "Limber again",
        part.string()));
  }
  return glue;
}

nlohmann::json describe_control(const PlayControl& control) {
  if (!control.choices.empty()) {
    return {{"label", control.label},
            {"path", control.path},
            {"value", control.choice},
            {"choices", control.choices}};
  }
  return {{"label", control.label},    {"path", control.path},
          {"unit", control.unit},      {"value", control.value},
          {"min", control.least},      {"max", control.most},
          {"whole", control.is_whole}, {"vector", control.vector}};
}

nlohmann::json describe_playground(const Playground& playground) {
  nlohmann::json files = nlohmann::json::object();
  for (const auto& [name, content] : playground.files) {
    files[name] = encode_base64(content);
  }
  nlohmann::json controls = nlohmann::json::array();
  for (const PlayControl& control : playground.controls) {
    controls.push_back(describe_control(control));
  }
  return {{"name", playground.name},
          {"scenario", playground.scenario},
          {"hasRigid", playground.has_rigid},
          {"settings", playground.settings},
          {"files", std::move(files)},
          {"bodies", playground.bodies},
          {"controls", std::move(controls)},
          {"view", read_part(find_template())},
          {"glue", read_glue()},
          {"module", encode_base64(read_part(find_part("playground.wasm")))}};
}

}  // namespace

void find_playground() {
  find_template();
  for (const char* name : {"play.html", "playground.js", "playground.wasm"}) {
    find_part(name);
  }
  (void)read_glue();
}

void write_play_page(const std::filesystem::path& file,
                     const Playground& playground) {
  const std::filesystem::path frame = find_part("play.html");
  std::string page = read_part(frame);
  const std::size_t place = page.find(kPlayMark);
  if (place == std::string::npos) {
    throw InputError(
        fmt::format("'{}' is damaged; install Limber again", frame.string()));
  }
  const std::string setup = describe_playground(playground).dump();
  page.replace(place, kPlayMark.size(), encode_base64(compress(setup)));
  write_whole(file, page);
}

}  // namespace limber::view
