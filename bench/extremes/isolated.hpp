// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace limber::bench {

/// Outcome of work in a separate process.
struct Ending {
  enum class Kind {
    done,
    crashed,  ///< by a signal, or without a message
    hung,     ///< longer than it was given, or waiting
  };
  Kind kind = Kind::done;
  std::string answer;    ///< of work that was done
  double seconds = 0.0;  ///< wall time
};

/// Runs tasks, each in its own process, a limited number at a time, and returns
/// their outcomes in order.
/// @param limit processor time for each, and a tenth of its wall time [s]
/// @param tell called after each, with how many are done; may be empty
[[nodiscard]] std::vector<Ending> do_isolated(
    const std::vector<std::function<std::string()>>& work, double limit,
    int at_a_time, const std::function<void(std::size_t)>& tell);

}  // namespace limber::bench
