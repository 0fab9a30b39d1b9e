// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/page_data.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flying_recording.hpp"

namespace limber::view::page_data_test {
namespace {

using nlohmann::json;
using test::Flight;
using test::kFlightOutputs;
using test::make_flight;

/// The data of a page with one result.
class Page {
 public:
  explicit Page(const Recording& recording) {
    const std::string packed = make_page_data({&recording, 1});
    std::string bytes(std::size_t{1} << 20, '\0');
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                         reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
              Z_OK);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    header_ = json::parse(bytes.substr(4, length));
    values_ = bytes.substr((4 + length + 7) / 8 * 8);
  }

  [[nodiscard]] const json& result() const { return header_["results"][0]; }

  /// Of doubles or singles, stored plane by plane.
  template <typename T>
  [[nodiscard]] std::vector<T> read(const json& reference) const {
    EXPECT_EQ(reference["type"], sizeof(T) == 8 ? "f64" : "f32");
    const std::size_t count = reference["count"];
    std::vector<T> values(count);
    auto* out = reinterpret_cast<char*>(values.data());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t b = 0; b < sizeof(T); ++b) {
        out[i * sizeof(T) + b] =
            values_[reference["at"].get<std::size_t>() + b * count + i];
      }
    }
    return values;
  }

 private:
  json header_;
  std::string values_;
};

Vector3 to_vector(const json& list) {
  const std::vector<double> values = list;
  return Vector3::Map(values.data());
}

const std::vector<Flight> kFlights = {
    {},
    {.place = {0.0, 1e3, 0.0}},
    {.place = {1e7, 1.7, -3.3e6}},
    {.velocity = {7500.0, 0.0, -30.0}},
    {.place = {1e6, 0.0, 0.0}, .velocity = {0.0, 7500.0, 0.0}}};

TEST(PageData, PlacesOfBodiesAreThoseOfTheResultsToTheBit) {
  for (const Flight& flight : kFlights) {
    const Recording recording = make_flight(flight);
    const Page page(recording);
    for (std::size_t b = 0; b < recording.bodies.size(); ++b) {
      const auto p = page.read<double>(page.result()["bodies"][b]["p"]);
      ASSERT_EQ(p.size(), 3U * kFlightOutputs);
      for (Eigen::Index i = 0; i < kFlightOutputs; ++i) {
        for (Eigen::Index c = 0; c < 3; ++c) {
          EXPECT_EQ(p[std::size_t(3 * i + c)], recording.bodies[b].p_WB(i, c));
        }
      }
    }
  }
}

// What the page frames: about as large as the scene at rest near the origin.
TEST(PageData, TheBoxIsThatOfTheSceneWithoutItsPlaceAndCommonMotion) {
  for (const Flight& flight : kFlights) {
    const Page page(make_flight(flight));
    const Vector3 lower = to_vector(page.result()["box"][0]);
    const Vector3 upper = to_vector(page.result()["box"][1]);
    EXPECT_LT(lower.cwiseAbs().maxCoeff(), 2.0);
    EXPECT_LT(upper.cwiseAbs().maxCoeff(), 2.0);
    EXPECT_GT((upper - lower).minCoeff(), 0.3);
    EXPECT_EQ(page.result()["travels"], flight.velocity.norm() > 0.0);
  }
}

TEST(PageData, TouchesCountFromTheOffsetAndTheCommonMotion) {
  for (const Flight& flight : kFlights) {
    Recording recording = make_flight(flight);
    MatrixX touch(kFlightOutputs, 6);
    const Vector3 beside(0.125, 0.0, -0.25);
    MatrixX mean = MatrixX::Zero(kFlightOutputs, 3);
    for (const Body& body : recording.bodies) mean += 0.5 * body.p_WB;
    touch.leftCols(3) = mean.rowwise() + beside.transpose();
    touch.rightCols(3).setConstant(5.0);
    const MatrixX patch = MatrixX::Constant(kFlightOutputs, 10, 0.25);
    recording.contacts = {{"pair", touch, patch}};
    const Page page(recording);
    const auto values = page.read<float>(page.result()["contacts"][0]["touch"]);
    EXPECT_THAT(page.read<float>(page.result()["contacts"][0]["patch"]),
                ::testing::Each(0.25F));
    const Vector3 offset = to_vector(page.result()["offset"]);
    const double rounding = 0x1p-51 * mean.cwiseAbs().maxCoeff() + 1e-7;
    for (Eigen::Index i = 0; i < kFlightOutputs; ++i) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        const double home = page.result()["travels"] ? mean(i, c) : offset[c];
        EXPECT_NEAR(home + double(values[std::size_t(6 * i + c)]), touch(i, c),
                    rounding);
        EXPECT_EQ(values[std::size_t(6 * i + 3 + c)], 5.0F);
      }
    }
  }
}

TEST(PageData, ErrorsAreWithTheProbesThatHaveSome) {
  Recording recording = make_flight({});
  recording.probes = {{"tip.ux", "m", VectorX::Zero(kFlightOutputs)},
                      {"tip.uy", "m", VectorX::Zero(kFlightOutputs)}};
  recording.probes[1].error = 0.25;
  const Page page(recording);
  EXPECT_FALSE(page.result()["probes"][0].contains("error"));
  EXPECT_EQ(page.result()["probes"][1]["error"], 0.25);
}

TEST(PageData, BytesOfNamesThatAreNotUtf8AreEscaped) {
  Recording recording = make_flight({});
  for (const auto& [name, shown] : {std::pair{"\xfc", "\\xfc"},
                                    {"\xe4", "\\xe4"},
                                    {"\xc3\xa4", "\xc3\xa4"}}) {
    recording.name = name;
    EXPECT_EQ(Page(recording).result()["name"], shown);
  }
}

}  // namespace
}  // namespace limber::view::page_data_test
