// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/reductions.hpp"

#include <fmt/format.h>

#include <map>
#include <new>
#include <optional>
#include <set>

#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/flexbody/file/body_file.hpp"
#include "limber/flexbody/file/cache.hpp"
#include "limber/flexbody/modal/piece_check.hpp"
#include "limber/flexbody/model/unlikely_values.hpp"
#include "limber/scene/build/expected_impacts.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/recipes.hpp"
#include "limber/scene/probes/stress_points.hpp"
#include "limber/scene/scenario/link_start.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {
namespace {

// All pieces are of one mesh, which is made when the first is reduced.
Reducer mesh_once(const Reducer& reducer) {
  const auto made = std::make_shared<std::optional<flexbody::MeshAtHand>>();
  return {reducer.mesher, [reducer, made](const flexbody::MeshSource& source) {
            if (!*made) *made = reducer.make_mesh(source);
            return **made;
          }};
}

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
      for (const ReducedPointer& body : result_.of_link.back()) {
        warn(scene_.robot.links[i].name, body);
      }
    }
    return result_;
  }

 private:
  ReducedPieces find(int index) {
    const Link& link = scene_.robot.links[static_cast<std::size_t>(index)];
    if (!link.flexible) return {};
    try {
      if (!link.flexible->reduced_file.empty()) {
        return {read(link)};
      }
      flexbody::Recipe recipe =
          make_recipe(scene_.robot, index, scene_.scenario);
      if (recipe.basis.automatic) {
        recipe.basis.automatic->impacts = find_expected_impacts(
            scene_, find_link_motions(scene_.robot, scene_.scenario), index);
      }
      return reduce_pieces(recipe, link);
    } catch (const InputError& error) {
      std::vector<std::string> texts;
      for (const std::string& text : error.problems()) {
        texts.push_back(
            fmt::format("{}: link '{}': {}", scene_.robot.file.string(),
                        link.name, name_held_joint(scene_.robot, index, text)));
      }
      throw InputError(texts);
    }
  }

  ReducedPieces reduce_pieces(const flexbody::Recipe& recipe,
                              const Link& link) {
    const bool is_cut = takes_pieces(scene_.scenario.level_of(link.name)) &&
                        link.flexible->pieces != 1;
    if (!is_cut) return {reduce(recipe, link.name, reducer_, {})};
    const Reducer once = mesh_once(reducer_);
    const int count = count_pieces(recipe.mesh, link, once);
    if (count > 1) check_start(link);
    ReducedPieces pieces;
    for (int i = 0; i < count; ++i) {
      pieces.push_back(reduce(recipe, link.name, once, {count, i}));
    }
    if (count > 1) check_pieces(recipe, link.name, once, pieces);
    return pieces;
  }

  /// Compares pieces with the whole link, which may need more memory than they.
  void check_pieces(const flexbody::Recipe& recipe, const std::string& link,
                    const Reducer& reducer, const ReducedPieces& pieces) {
    flexbody::PieceCheck check{link, static_cast<int>(pieces.size()), {}, {}};
    try {
      const ReducedPointer whole =
          reduce(flexbody::make_whole_recipe(recipe), link, reducer, {});
      check.differences = flexbody::compare_pieces(whole, pieces);
      warn_of_locking(link, *whole);
      reported_.insert("locking of " + link);
    } catch (const dynamics::Interrupted&) {
      throw;
    } catch (const NumericalError& error) {
      check.obstacle = error.what();
    } catch (const std::bad_alloc&) {
      check.obstacle = "memory runs out";
    }
    if (const auto text = describe_excess(check)) add_warnings(link, {*text});
    result_.piece_checks.push_back(std::move(check));
  }

  int count_pieces(const flexbody::MeshSource& mesh, const Link& link,
                   const Reducer& reducer) {
    if (link.flexible->pieces > 0) return link.flexible->pieces;
    const flexbody::PieceAdvice advice =
        reducer.make_mesh(mesh).advise_pieces();
    if (advice.count == 1) {
      result_.warnings.push_back(fmt::format(
          "link '{}' is left in one piece: {}", link.name, advice.reason));
    }
    return advice.count;
  }

  void check_start(const Link& link) const {
    if (find_start(scene_.scenario, link.name) == nullptr) return;
    throw InputError(fmt::format(
        "[initial.links.{}] deforms it at the start, by modes or fields of the "
        "whole mesh, and it is cut into pieces; leave it in one piece, or "
        "start from an equilibrium",
        link.name));
  }

  ReducedPointer read(const Link& link) {
    ReducedPointer& body = saved_[link.flexible->reduced_file];
    if (!body) {
      body = std::make_shared<const flexbody::ReducedBody>(
          flexbody::read_body(link.flexible->reduced_file));
    }
    for (const flexbody::InterfaceTable& table : body->interfaces) {
      if (!flexbody::is_cut(table.name)) continue;
      throw InputError(fmt::format(
          "its saved body is a piece of a mesh, with the interface '{}' where "
          "it was cut; give the link the mesh and 'pieces'",
          table.name));
    }
    if (!link.flexible->clamped_groups.empty() && !body->clamped) {
      throw InputError(
          "it has a <clamp>, but its saved body was made without one; reduce "
          "it again by 'limber reduce --clamp GROUP'");
    }
    if (scene_.scenario.level_of(link.name) == dynamics::Fidelity::nonlinear &&
        !body->manifold) {
      throw InputError(
          "level nonlinear needs second-order tables, which its saved body "
          "does not have; reduce it again by 'limber reduce --second-order'");
    }
    if (needs_stress_modes(scene_.scenario, link.name)) {
      require_stress(*body, scene_.scenario.level_of(link.name));
    }
    if (const LinkStart* start = find_start(scene_.scenario, link.name)) {
      check_saved_fields(*start, *body);
    }
    return body;
  }

  void add_warnings(const std::string& link,
                    const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      result_.warnings.push_back(fmt::format("link '{}': {}", link, text));
    }
  }

  /// Once for a link. Of pieces that are compared with the whole, the whole's
  /// counts, whose first frequency is the link's.
  void warn_of_locking(const std::string& link,
                       const flexbody::ReducedBody& body) {
    const auto text = describe_locking(body.locking);
    if (text && reported_.insert("locking of " + link).second) {
      add_warnings(link, {*text});
    }
  }

  void warn(const std::string& link, const ReducedPointer& body) {
    const auto add = [&](const std::vector<std::string>& texts) {
      add_warnings(link, texts);
    };
    warn_of_locking(link, *body);
    if (body->selection) add(flexbody::describe_shortfalls(*body->selection));
    for (const flexbody::LoadModesRecord& record : body->load_modes) {
      if (const auto text = describe_left_out(record)) add({*text});
    }
    for (const std::string& text : flexbody::question_body(*body)) {
      if (reported_.insert(link + ": " + text).second) add({text});
    }
    if (const LinkStart* start = find_start(scene_.scenario, link)) {
      add(describe_losses(*start, *body));
    }
  }

  ReducedPointer reduce(const flexbody::Recipe& recipe, const std::string& link,
                        const Reducer& reducer, const flexbody::Piece& piece) {
    ReducedPointer& known = result_.known[flexbody::recipe_key(recipe, piece)];
    if (known) return known;
    flexbody::CachedBody found =
        flexbody::load_or_reduce(recipe, cache_, reducer, piece);
    for (const std::string& notice : found.notices) {
      // Links may share a mesh.
      if (!reported_.insert(notice).second) continue;
      result_.warnings.push_back(fmt::format("link '{}': {}", link, notice));
    }
    for (const std::string& line : found.found) {
      if (!reported_.insert("found " + line).second) continue;
      result_.found.push_back(fmt::format("link '{}': found {}", link, line));
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
