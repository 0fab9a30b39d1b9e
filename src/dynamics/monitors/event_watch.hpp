// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/event.hpp"
#include "dynamics/system_state.hpp"
#include "joints/switches.hpp"

namespace limber::dynamics {

/// Watches the switches of all couplers and transmissions from step to step.
class EventWatch {
 public:
  explicit EventWatch(const SystemModel& model);

  [[nodiscard]] bool is_empty() const { return switches_.empty(); }

  /// Takes the switches as they are. Latches that are within reach close.
  void start(SystemState& state, std::vector<Event>& events);

  /// The first switch whose sign changed since the last accepted state, and
  /// when: of the cubic through its values and rates at both ends.
  struct Crossing {
    std::size_t index = 0;
    double share = 0.0;  ///< of the step, in [0, 1] [-]
  };
  [[nodiscard]] std::optional<Crossing> find_first(const SystemState& after,
                                                   double h);

  /// A switch's sign changes at `state`, which remembers it.
  struct Change {
    bool has_jump = false;     ///< forces may jump
    double energy_lost = 0.0;  ///< that a latch stored when it opened [J]
  };
  Change pass(std::size_t index, SystemState& state,
              std::vector<Event>& events);

  /// Takes the state that find_first saw last, where nothing more changes, as
  /// the start of the next step; or another one.
  void accept();
  void accept(const SystemState& state);

  /// What it knows between steps.
  void exchange_memory(Archive& archive);

 private:
  struct Switch {
    int coupler = -1;       // or
    int transmission = -1;  // and the law of it
    std::size_t law = 0;
    int index = 0;           // of the coupler's or the law's
    std::size_t memory = 0;  // which of the state's
    std::size_t place = 0;   // there
    bool is_up = false;
    joints::SwitchValue last;
    joints::SwitchValue now;
  };
  [[nodiscard]] joints::SwitchValue evaluate(const Switch& s,
                                             const SystemState& state) const;
  [[nodiscard]] bool is_latch(const Switch& s) const;
  void set(Switch& s, bool is_up, SystemState& state) const;

  const SystemModel& model_;
  std::vector<Switch> switches_;
};

}  // namespace limber::dynamics
