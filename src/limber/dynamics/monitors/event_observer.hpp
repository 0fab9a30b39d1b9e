// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/monitors/event.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/coupler_law.hpp"

namespace limber::dynamics {

/// Monitors the switches of all couplers and transmissions from step to step.
class EventObserver {
 public:
  explicit EventObserver(const SystemModel& model);

  [[nodiscard]] bool is_empty() const { return switches_.empty(); }

  /// Initialises the switches. Latches within reach close.
  void start(SystemState& state, std::vector<Event>& events);

  /// The first switch whose sign changed since the last accepted state and its
  /// time, by the cubic through the values and rates at both ends.
  struct Crossing {
    std::size_t index = 0;  ///< index of the switch
    double fraction = 0.0;  ///< fraction of the step, in [0, 1] [-]
  };
  /// Also of those whose sign has changed back by the step's end, or only of
  /// those that differ there.
  enum class Changes { within, at_end };
  /// @param after state at the step's end
  /// @param h length of the step [s]
  [[nodiscard]] std::optional<Crossing> find_first(
      const SystemState& after, double h, Changes changes = Changes::within);

  /// Changes a switch's sign at `state`, in its memory.
  struct Change {
    bool has_jump = false;     ///< forces may jump
    double energy_lost = 0.0;  ///< stored in a latch that opened [J]
    CouplerIndex coupler{-1};  ///< of that latch
  };
  Change pass(std::size_t index, SystemState& state,
              std::vector<Event>& events);

  /// Starts the next step from the state last seen by find_first, which has no
  /// further change, or from another one.
  void accept();
  void accept(const SystemState& state);

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  struct Switch {
    CouplerIndex coupler;            // or
    TransmissionIndex transmission;  // and the law of it
    std::size_t law = 0;
    int index = 0;           // of the coupler's or the law's switches
    std::size_t memory = 0;  // index into the state's memory
    std::size_t place = 0;   // index within it
    bool is_up = false;
    joints::SwitchValue last;
    joints::SwitchValue now;
  };
  [[nodiscard]] joints::SwitchValue evaluate(const Switch& s,
                                             const SystemState& state) const;
  [[nodiscard]] bool is_trigger(const Switch& s) const;
  void set(Switch& s, bool is_up, SystemState& state) const;

  const SystemModel& model_;
  std::vector<Switch> switches_;
};

}  // namespace limber::dynamics
