// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/drive_reader.hpp"

#include <fmt/format.h>

namespace limber::scene {
namespace {

using joints::Drive;
using joints::DriveMode;

void read_target(TomlTable& table, DriveSpec& spec) {
  spec.joint = table.text("joint").value_or("");
  spec.tendon = table.text("tendon").value_or("");
  spec.name = table.text("name").value_or(spec.joint + spec.tendon);
  if (table.has("joint") == table.has("tendon")) {
    table.fail("needs one of 'joint' and 'tendon'");
  }
  spec.coordinate = table.integer("coordinate", 1, joints::kMaxCoordinates)
                        .value_or(spec.coordinate);
  if (table.has("coordinate") && !spec.tendon.empty()) {
    table.fail("coordinate",
               "applies to a joint; a tendon has only its length");
  }
}

// A number that only some modes have.
double read_gain(TomlTable& table, const std::string& key, bool has,
                 bool needs) {
  if (table.has(key) && !has) {
    table.fail(key, "does not apply in this mode; leave it out");
  }
  if (needs) return table.required_number(key, kPositive);
  return table.number(key, kNonNegative).value_or(0.0);
}

void read_gains(TomlTable& table, Drive::Parameters& drive) {
  drive.mode = read_choice<DriveMode>(table, "mode",
                                      {{"position", DriveMode::position},
                                       {"velocity", DriveMode::velocity},
                                       {"effort", DriveMode::effort}},
                                      DriveMode::position);
  if (!table.has("mode")) {
    table.fail("needs 'mode', 'position', 'velocity' or 'effort'");
  }
  const bool is_position = drive.mode == DriveMode::position;
  const bool is_velocity = drive.mode == DriveMode::velocity;
  drive.stiffness = read_gain(table, "stiffness", is_position, is_position);
  drive.damping =
      read_gain(table, "damping", is_position || is_velocity, is_velocity);
  drive.max_effort =
      table.number("max_effort", kPositive).value_or(drive.max_effort);
  drive.max_speed =
      table.number("max_speed", kPositive).value_or(drive.max_speed);
}

}  // namespace

DriveSpec read_drive(TomlTable& table, const SignalContext& context) {
  DriveSpec spec;
  read_target(table, spec);
  read_gains(table, spec.drive);
  spec.drive.pulls_only = !spec.tendon.empty();
  spec.drive.signal = read_signal(table, context);
  if (!table.problems().empty()) return spec;
  try {
    (void)Drive(spec.drive);
  } catch (const InputError& error) {
    for (const std::string& problem : error.problems()) table.fail(problem);
  }
  return spec;
}

void read_release(TomlTable& table, std::map<std::string, double>& releases) {
  const std::string latch = table.required_text("latch");
  const double time = table.required_number("time", kNonNegative);
  if (!releases.emplace(latch, time).second) {
    table.fail(fmt::format("latch '{}' is released twice", latch));
  }
}

}  // namespace limber::scene
