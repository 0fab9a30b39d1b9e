// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/start_touches.hpp"

#include "limber/dynamics/equations/pair_forces.hpp"

namespace limber::app {

std::vector<StartTouch> find_start_touches(const scene::BuiltScene& built) {
  std::vector<StartTouch> touches;
  for (const dynamics::Pair& pair : built.model.pairs) {
    const joints::Touching* law = pair.law->touching();
    if (law == nullptr) continue;
    const dynamics::PairMotion motion =
        dynamics::find_pair_motion(built.model, pair, built.initial);
    joints::PairResponse scratch = dynamics::make_response(built.model, pair);
    StartTouch start{&pair, law, law->find_touch(motion.bodies(), scratch)};
    start.gap = start.has_place() ? -start.touch.depth
                                  : law->find_clearance(motion.bodies());
    touches.push_back(start);
  }
  return touches;
}

}  // namespace limber::app
