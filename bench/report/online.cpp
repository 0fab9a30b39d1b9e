// SPDX-License-Identifier: BSD-3-Clause
#include "online.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <new>

#include "limber/dynamics/equations/node_motion.hpp"

namespace limber::bench {

namespace {

double read_wall_clock() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

}  // namespace

double read_clock() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<double> list_case_times() {
  std::vector<double> times;
  for (int i = 0; i * kCaseStep < kCaseEnd; ++i) times.push_back(i * kCaseStep);
  times.push_back(kCaseEnd);
  return times;
}

Cost run_case(const Body& body, const StepForces& strike,
              dynamics::IntegratorKind integrator, MatrixX& u) {
  const dynamics::SimulationSettings settings{
      .integrator = integrator,
      .end_time = kCaseEnd,
      .step = kCaseStep,
      .output_times = list_case_times()};
  const double wall = read_wall_clock();
  const double begin = read_clock();
  const auto model =
      make_free_beam(body, dynamics::Fidelity::uncoupled, strike);
  dynamics::SystemState state = make_state(model);
  std::vector<dynamics::SystemState> states(settings.output_times.size(),
                                            state);
  const double projected = read_clock();
  std::size_t next = 0;
  simulate(model, state, settings,
           [&](const dynamics::SystemState& now,
               const dynamics::EnergyBalance&) { states[next++] = now; });
  const double stepped = read_clock();
  calc_node_displacements(model, dynamics::BodyIndex(0), states, {}, u);
  return {projected - begin, stepped - projected, read_clock() - stepped,
          read_wall_clock() - wall};
}

std::vector<Statistics> time_in_turn(
    const std::vector<std::function<double()>>& calls) {
  constexpr int kGroups = 7;
  constexpr int kCalls = 20;
  const auto count = std::ssize(calls);
  MatrixX means = MatrixX::Zero(kGroups, count);
  for (const auto& call : calls) call();  // the first fills caches
  for (Eigen::Index group = 0; group < kGroups; ++group) {
    for (int i = 0; i < kCalls; ++i) {
      for (Eigen::Index c = 0; c < count; ++c) {
        means(group, c) += calls[static_cast<std::size_t>(c)]() / kCalls;
      }
    }
  }
  std::vector<Statistics> statistics;
  for (Eigen::Index c = 0; c < count; ++c) {
    const double mean = means.col(c).mean();
    const double variance = (means.col(c).array() - mean).square().mean();
    statistics.push_back({mean, std::sqrt(variance)});
  }
  return statistics;
}

double time_filling(MatrixX& u) {
  const double begin = read_clock();
  u.setConstant(1.0);
  return read_clock() - begin;
}

double time_filling_fresh(std::size_t bytes) {
  const double begin = read_clock();
  void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  auto* values = static_cast<double*>(pages);
  std::fill(values, values + bytes / sizeof(double), 1.0);
  const double seconds = read_clock() - begin;
  munmap(pages, bytes);
  return seconds;
}

}  // namespace limber::bench
