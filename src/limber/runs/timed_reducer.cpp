// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/timed_reducer.hpp"

#include <chrono>

namespace limber::runs {

scene::Reducer time_reductions(const scene::Reducer& reducer,
                               const NoteSeconds& note) {
  using Clock = std::chrono::steady_clock;
  const auto time_from = [note](const flexbody::MeshAtHand& mesh,
                                Clock::time_point start) {
    flexbody::MeshAtHand timed = mesh;
    timed.reduce = [mesh, start, note](const flexbody::Recipe& recipe) {
      flexbody::ReducedBody body = mesh.reduce(recipe);
      const std::chrono::duration<double> taken = Clock::now() - start;
      note(flexbody::content_key(recipe, mesh.record.content), taken.count());
      return body;
    };
    return timed;
  };
  const auto make_mesh = [reducer,
                          time_from](const flexbody::MeshSource& source) {
    const Clock::time_point start = Clock::now();
    const flexbody::MeshAtHand mesh = reducer.make_mesh(source);
    flexbody::MeshAtHand timed = time_from(mesh, start);
    if (mesh.take_piece) {
      timed.take_piece = [mesh, time_from](const flexbody::Piece& piece) {
        return time_from(mesh.take_piece(piece), Clock::now());
      };
    }
    return timed;
  };
  return {reducer.mesher, make_mesh};
}

}  // namespace limber::runs
