// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/evaluation_time.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"

namespace limber {

InputValue find_input(const EvaluationTime& now, int input) {
  LIMBER_EXPECT(input >= 0 && index(input) < now.inputs.size());
  const InputState& line = now.inputs[index(input)];
  const bool is_past =
      now.t > line.since || (now.t == line.since && now.side == Side::right);
  const double rate = is_past ? line.rate : line.rate_before;
  const double from = is_past ? line.value : line.value_before;
  return {rate == 0.0 ? from : from + rate * (now.t - line.since), rate};
}

}  // namespace limber
