// SPDX-License-Identifier: BSD-3-Clause
// What the worker of the playground calls: a scenario with changed values is
// simulated, and gives the page its data as `limber view` does.
#include <emscripten.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/results/results_file.hpp"
#include "limber/runs/played_scene.hpp"
#include "limber/runs/run.hpp"
#include "limber/view/page_data.hpp"
#include "limber/view/recording.hpp"

// To the worker, which may have no use for it. Not in the unnamed namespace:
// the linker reads it by its name.
EM_JS(void, limber_report_progress, (double fraction), {
  if (globalThis.LimberProgress) globalThis.LimberProgress(fraction);
});

namespace {

using namespace limber;

constexpr const char* kResults = "/results.h5";

// Read by the worker after a call.
std::string answer;
std::map<std::string, std::filesystem::path> body_files;  // of links
std::vector<view::Recording> shown;
std::string page_data;

runs::Reductions refuse_meshes() {
  const auto refuse = [](const flexbody::MeshSource&) -> flexbody::MeshAtHand {
    throw InputError("a page reduces no meshes; its bodies are saved ones");
  };
  return {{"", refuse}, "", {}};
}

nlohmann::json describe_energy(const runs::Run& run) {
  nlohmann::json rows = nlohmann::json::array();
  const auto& history = run.history;
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    const dynamics::EnergyBalance& now = history.energies[i];
    rows.push_back(
        {history.times[i], now.total(), now.elastic, now.work, now.dissipated});
  }
  return rows;
}

void play(const std::string& file, const std::string& settings) {
  const auto start = std::chrono::steady_clock::now();
  const scene::Scene scene = runs::load_played_scene(
      file, runs::parse_play_settings(settings), body_files);
  const runs::Run run = runs::simulate_scene(
      scene, {.reductions = refuse_meshes(),
              .progress = [](std::string_view, double fraction) {
                limber_report_progress(fraction);
              }});
  results::write_results(kResults, run.built.model, run.history, &run.scenery,
                         &run.record);
  if (run.failure) std::rethrow_exception(run.failure);
  shown.push_back(view::read_recording(kResults));
  const std::chrono::duration<double> all =
      std::chrono::steady_clock::now() - start;
  answer = nlohmann::json{{"simulated", run.history.times.back()},
                          {"stepping", run.statistics.seconds},
                          {"seconds", all.count()},
                          {"steps", run.statistics.steps},
                          {"modes", run.built.model.modal_count},
                          {"energy", describe_energy(run)},
                          {"warnings", run.statistics.warnings}}
               .dump();
}

template <typename Work>
int report(const Work& work) {
  try {
    work();
    return 0;
  } catch (const InputError& error) {
    answer = error.what();
    return 2;
  } catch (const std::exception& error) {
    answer = error.what();
    return 3;
  }
}

}  // namespace

extern "C" {

/// A saved body, as a flat file, for a link.
EMSCRIPTEN_KEEPALIVE void limber_give_body(const char* link, const char* file) {
  body_files[link] = file;
}

/// Simulates and adds a result to those shown.
/// @param settings lines PATH=VALUE of runs::parse_play_settings
/// @returns 0 (limber_answer is JSON: seconds, steps, energy), or 2 for
/// wrong input and 3 for a computation that failed (its message)
EMSCRIPTEN_KEEPALIVE int limber_play(const char* file, const char* settings) {
  return report([&] { play(file, settings); });
}

/// Leaves out what was added.
EMSCRIPTEN_KEEPALIVE void limber_forget() { shown.clear(); }

/// Gathers what was added since the last call, the first in front, its ghosts
/// behind, as view::make_page_data does, but not compressed.
EMSCRIPTEN_KEEPALIVE int limber_show() {
  return report([] {
    const auto recordings = std::exchange(shown, {});
    page_data = view::pack_page_data(recordings);
  });
}

EMSCRIPTEN_KEEPALIVE const char* limber_answer() { return answer.c_str(); }
EMSCRIPTEN_KEEPALIVE const char* limber_data() { return page_data.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t limber_size() { return page_data.size(); }

}  // extern "C"
