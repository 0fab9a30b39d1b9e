// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/cut_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/piece_names.hpp"

namespace limber::runs {
namespace {

using dynamics::BodyIndex;
using dynamics::ContactRecord;
using dynamics::SystemModel;

/// One side of a contact that is a piece of a link.
struct CutSide {
  std::string link;
  std::string piece;
  BodyIndex other = dynamics::kWorld;
  const ContactRecord* record = nullptr;
};

/// The link of which a body is a piece, or nothing.
std::string find_cut_link(const scene::Robot& robot, const std::string& body) {
  const std::string whole = find_whole(body);
  if (whole == body) return "";
  for (const scene::Link& link : robot.links) {
    if (link.name != whole || !link.flexible) continue;
    return link.flexible->pieces == 1 ? "" : whole;
  }
  return "";
}

std::vector<CutSide> list_sides(const scene::Robot& robot,
                                const SystemModel& model,
                                const std::vector<ContactRecord>& records) {
  std::vector<CutSide> sides;
  for (const ContactRecord& record : records) {
    const auto pair = std::find_if(
        model.pairs.begin(), model.pairs.end(),
        [&](const dynamics::Pair& one) { return one.name == record.pair; });
    if (pair == model.pairs.end()) continue;
    for (const auto& [own, other] : {std::pair(pair->body_A, pair->body_B),
                                     std::pair(pair->body_B, pair->body_A)}) {
      if (own == dynamics::kWorld) continue;
      const std::string& name = model.bodies[index(own)].name;
      const std::string link = find_cut_link(robot, name);
      if (!link.empty()) sides.push_back({link, name, other, &record});
    }
  }
  return sides;
}

bool overlap(const ContactRecord& a, const ContactRecord& b) {
  return a.time <= b.time + b.duration && b.time <= a.time + a.duration;
}

}  // namespace

std::vector<std::string> find_cut_contacts(
    const scene::Robot& robot, const SystemModel& model,
    const std::vector<ContactRecord>& records) {
  const std::vector<CutSide> sides = list_sides(robot, model, records);
  std::set<std::pair<std::string, BodyIndex>> reported;
  std::vector<std::string> warnings;
  for (const CutSide& a : sides) {
    for (const CutSide& b : sides) {
      if (a.link != b.link || a.other != b.other || a.piece >= b.piece ||
          !overlap(*a.record, *b.record) ||
          !reported.insert({a.link, a.other}).second) {
        continue;
      }
      const std::string what =
          a.other == dynamics::kWorld
              ? "the world"
              : fmt::format("'{}'", model.bodies[index(a.other)].name);
      warnings.push_back(fmt::format(
          "pieces '{}' and '{}' of link '{}' touch {} at the same time, at t = "
          "{:.6g} s: at a cut each deforms as if the other did not touch, and "
          "an impact's force may be up to 1.3 times too large; another number "
          "of pieces moves the cut",
          a.piece, b.piece, a.link, what,
          std::max(a.record->time, b.record->time)));
    }
  }
  return warnings;
}

}  // namespace limber::runs
