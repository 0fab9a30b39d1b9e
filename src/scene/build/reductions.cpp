// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/reductions.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/scene/build/expected_impacts.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/link_start.hpp"
#include "limber/scene/build/recipes.hpp"
#include "limber/scene/probes/stress_points.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

class Reduction {
 public:
  Reduction(const Scene& scene, const Reducer& reducer,
            const std::filesystem::path& cache, const KnownBodies& known)
      : scene_(scene), reducer_(reducer), cache_(cache) {
    result_.known = known;
  }

  Reductions run() {
    for (std::size_t i = 0; i < scene_.robot.links.size(); ++i) {
      result_.of_link.push_back(find(static_cast<int>(i)));
      warn(scene_.robot.links[i].name, result_.of_link.back());
    }
    return result_;
  }

 private:
  ReducedPointer find(int index) {
    const Link& link = scene_.robot.links[static_cast<std::size_t>(index)];
    if (!link.flexible) return nullptr;
    try {
      if (!link.flexible->reduced_file.empty()) {
        return read(link);
      }
      flexbody::Recipe recipe =
          make_recipe(scene_.robot, index, scene_.scenario);
      if (recipe.basis.automatic) {
        recipe.basis.automatic->impacts = find_expected_impacts(
            scene_, find_link_motions(scene_.robot, scene_.scenario), index);
      }
      return reduce(recipe, link.name);
    } catch (const InputError& error) {
      std::vector<std::string> texts;
      for (const std::string& text : error.problems()) {
        texts.push_back(fmt::format(
            "{}: link '{}': {}", scene_.robot.file.string(), link.name, text));
      }
      throw InputError(texts);
    }
  }

  ReducedPointer read(const Link& link) {
    ReducedPointer& body = saved_[link.flexible->reduced_file];
    if (!body) {
      body = std::make_shared<const flexbody::ReducedBody>(
          flexbody::read_body(link.flexible->reduced_file));
    }
    if (!link.flexible->clamped_groups.empty() && !body->clamped) {
      throw InputError(
          "it has a <clamp>, but its saved body was made without one; make "
          "that anew by 'limber reduce --clamp GROUP'");
    }
    if (scene_.scenario.level_of(link.name) == dynamics::Fidelity::nonlinear &&
        !body->manifold) {
      throw InputError(
          "level nonlinear needs second-order tables, which its saved body "
          "does not have; make that anew by 'limber reduce --second-order'");
    }
    if (needs_stress_modes(scene_.scenario, link.name)) require_stress(*body);
    if (const LinkStart* start = find_start(scene_.scenario, link.name)) {
      check_saved_fields(*start, *body);
    }
    return body;
  }

  void warn(const std::string& link, const ReducedPointer& body) {
    if (!body) return;
    const auto add = [&](const std::vector<std::string>& texts) {
      for (const std::string& text : texts) {
        result_.warnings.push_back(fmt::format("link '{}': {}", link, text));
      }
    };
    if (body->selection) add(flexbody::describe_shortfalls(*body->selection));
    for (const flexbody::LoadModesRecord& record : body->load_modes) {
      if (const auto text = describe_left_out(record)) add({*text});
    }
    if (const LinkStart* start = find_start(scene_.scenario, link)) {
      add(describe_losses(*start, *body));
    }
  }

  ReducedPointer reduce(const flexbody::Recipe& recipe,
                        const std::string& link) {
    ReducedPointer& known = result_.known[flexbody::recipe_key(recipe)];
    if (known) return known;
    flexbody::CachedBody found =
        flexbody::load_or_reduce(recipe, cache_, reducer_);
    for (const std::string& notice : found.notices) {
      // Links may share a mesh.
      if (!reported_.insert(notice).second) continue;
      result_.warnings.push_back(fmt::format("link '{}': {}", link, notice));
    }
    (found.was_cached ? result_.cached : result_.reduced) += 1;
    known =
        std::make_shared<const flexbody::ReducedBody>(std::move(found.body));
    return known;
  }

  const Scene& scene_;
  const Reducer& reducer_;
  const std::filesystem::path& cache_;
  std::set<std::string> reported_;
  std::map<std::filesystem::path, ReducedPointer> saved_;
  Reductions result_;
};

}  // namespace

Reductions find_reductions(const Scene& scene, const Reducer& reducer,
                           const std::filesystem::path& cache,
                           const KnownBodies& known) {
  return Reduction(scene, reducer, cache, known).run();
}

}  // namespace limber::scene
