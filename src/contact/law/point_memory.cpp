// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/point_memory.hpp"

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// Visits all numbers in order.
template <typename Memory, typename Visit>
void visit_numbers(Memory& memory, const Visit& visit) {
  const auto visit_vector = [&](auto& vector) {
    for (int i = 0; i < 3; ++i) visit(vector[i]);
  };
  const auto visit_place = [&](auto& place) {
    visit_vector(place.x_B);
    visit(place.face);
    visit(place.u);
    visit(place.v);
  };
  visit(memory.speed);
  visit(memory.time);
  visit_place(memory.on_A);
  visit_place(memory.on_B);
  visit_friction(memory.friction, visit);
}

}  // namespace

PointMemory load_memory(std::span<const double> numbers) {
  LIMBER_EXPECT(numbers.size() == kPointNumbers);
  PointMemory memory;
  std::size_t next = 0;
  visit_numbers(memory, [&](double& value) { value = numbers[next++]; });
  return memory;
}

void save_memory(const PointMemory& memory, std::span<double> numbers) {
  LIMBER_EXPECT(numbers.size() == kPointNumbers);
  std::size_t next = 0;
  visit_numbers(memory, [&](const double& value) { numbers[next++] = value; });
}

}  // namespace limber::contact
