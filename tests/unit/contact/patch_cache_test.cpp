// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_cache.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/patches/patch_pair.hpp"

/// Patches that are kept: those that were found, and no others.
namespace limber::contact::patch_cache_test {
namespace {

joints::PairBody place_at(double z) {
  joints::PairBody body;
  body.p_WB.z() = z;
  return body;
}

// A patch of the energy z, and how often it was found.
struct Counted {
  PatchCache cache{1};
  int count = 0;

  double find(double z, bool has_derivatives = false) {
    const joints::PairBody A;
    const joints::PairBody B = place_at(z);
    return cache
        .find(0, {A, B}, has_derivatives,
              [&] {
                ++count;
                return Patch{.touches = true, .energy = z};
              })
        .energy;
  }
};

TEST(PatchCache, FindsEachOfTwoPosesOnce) {
  Counted counted;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(counted.find(1.0), 1.0);
    EXPECT_EQ(counted.find(2.0), 2.0);
  }
  EXPECT_EQ(counted.count, 2);
}

TEST(PatchCache, KeepsTheTwoThatWereAskedForLast) {
  Counted counted;
  counted.find(1.0);
  counted.find(2.0);
  counted.find(1.0);
  counted.find(3.0);  // in place of 2
  counted.find(1.0);
  EXPECT_EQ(counted.count, 3);
  EXPECT_EQ(counted.find(2.0), 2.0);
  EXPECT_EQ(counted.count, 4);
}

TEST(PatchCache, FindsAgainWhatLacksDerivatives) {
  Counted counted;
  counted.find(1.0, false);
  counted.find(1.0, true);
  EXPECT_EQ(counted.count, 2);
  counted.find(1.0, false);
  EXPECT_EQ(counted.count, 2);
}

TEST(PatchCache, TellsPosesByAllOfTheirBits) {
  Counted counted;
  counted.find(0.0);
  counted.find(-0.0);
  EXPECT_EQ(counted.count, 2);
}

// A ball on a cylinder, as deep as z is low.
std::unique_ptr<PatchPair> make_pair() {
  const SurfaceMaterial material{1e7, 0.3};
  return std::make_unique<PatchPair>(
      ContactSide{Shape{Cylinder{0.07, 0.1}, {}}, material, 1.0,
                  Matrix3::Identity()},
      ContactSide{Shape{Sphere{0.015}, {}}, material, 1.0, Matrix3::Identity()},
      ContactParameters{});
}

double find_force(const PatchPair& pair, double depth) {
  joints::PairBody ball = place_at(0.01);
  ball.p_WB.x() = 0.085 - depth;
  joints::PairResponse scratch;
  const std::vector<double> memory(pair.memory_size(), 0.0);
  return pair.read({{}, ball}, {}, memory, scratch).normal_force;
}

TEST(PatchCache, OfAPairThatThreadsShareIsThatOfTheirOwn) {
  const auto shared = make_pair();
  std::vector<std::thread> threads;
  std::vector<int> differing(2, 0);
  for (int& own_differing : differing) {
    threads.emplace_back([&own_differing, &shared] {
      for (int i = 0; i < 200; ++i) {
        const double depth = 1e-5 * (1 + i % 5);
        const double found = find_force(*shared, depth);
        if (!(found > 0.0) || found != find_force(*make_pair(), depth)) {
          ++own_differing;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(differing, std::vector<int>(2, 0));
}

}  // namespace
}  // namespace limber::contact::patch_cache_test
