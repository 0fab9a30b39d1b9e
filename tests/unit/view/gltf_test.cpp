// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/gltf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "flying_recording.hpp"
#include "limber/common/errors.hpp"

namespace limber::view::gltf_test {
namespace {

using nlohmann::json;
using test::add_stranger;
using test::Flight;
using test::kFlightOutputs;
using test::make_flight;

/// A .glb file, with its animation stepped in double precision.
class Scene {
 public:
  explicit Scene(const Recording& recording) {
    const std::string file = ::testing::TempDir() + "scene.glb";
    write_gltf(file, recording, 1.0);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    root_ = json::parse(bytes.substr(20, length));
    values_ = bytes.substr(28 + length);
    const json& nodes = root_["nodes"];
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      by_name_[nodes[n]["name"]] = n;
      for (const json& child : nodes[n].value("children", json::array())) {
        parent_[child] = n;
      }
    }
  }

  [[nodiscard]] const json& root() const { return root_; }
  [[nodiscard]] bool has(const std::string& node) const {
    return by_name_.contains(node);
  }
  [[nodiscard]] const json& node(const std::string& name) const {
    return root_["nodes"][by_name_.at(name)];
  }

  /// Columns.
  [[nodiscard]] MatrixX read(const json& accessor) const {
    const json& a = root_["accessors"][accessor.get<std::size_t>()];
    const json& view = root_["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::map<std::string, int> rows = {
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    Eigen::MatrixXf singles(rows.at(a["type"]), a["count"].get<int>());
    std::memcpy(singles.data(),
                values_.data() + view["byteOffset"].get<std::size_t>(),
                4 * std::size_t(singles.size()));
    return singles.cast<double>();
  }

  [[nodiscard]] VectorX times() const {
    return read(root_["animations"][0]["samplers"][0]["input"]).row(0);
  }

  /// Of a node's channel at output i, or its constant property.
  [[nodiscard]] VectorX at(std::size_t node, const std::string& path,
                           const VectorX& otherwise, int i) const {
    const json& animation = root_["animations"][0];
    for (const json& channel : animation["channels"]) {
      if (channel["target"]["node"] != node) continue;
      if (channel["target"]["path"] != path) continue;
      const json& sampler =
          animation["samplers"][channel["sampler"].get<std::size_t>()];
      return read(sampler["output"]).col(i);
    }
    const json& known = root_["nodes"][node];
    if (!known.contains(path)) return otherwise;
    const std::vector<double> values = known[path];
    return VectorX::Map(values.data(), std::ssize(values));
  }

  /// Origin of a node below the root, which turns z up to y up.
  [[nodiscard]] Vector3 place(const std::string& name, int i) const {
    Vector3 p = Vector3::Zero();
    for (std::size_t n = by_name_.at(name); n != 0; n = parent_.at(n)) {
      p += at(n, "translation", VectorX::Zero(3), i);
    }
    return p;
  }

  /// Nodes of the surface of the body "arm".
  [[nodiscard]] Matrix3X arm(int i) const {
    const std::size_t n = by_name_.at("arm");
    const std::size_t mesh = root_["nodes"][n]["mesh"];
    const json& primitive = root_["meshes"][mesh]["primitives"][0];
    const double eta = at(n, "weights", {}, i)[0];
    const VectorX q = at(n, "rotation", {}, i);
    const Matrix3X y = read(primitive["attributes"]["POSITION"]) +
                       eta * read(primitive["targets"][0]["POSITION"]);
    const Quaternion turn(q[3], q[0], q[1], q[2]);
    return (turn.normalized().toRotationMatrix() * y).colwise() +
           place("arm", i);
  }

 private:
  json root_;
  std::string values_;
  std::map<std::string, std::size_t> by_name_;
  std::map<std::size_t, std::size_t> parent_;
};

constexpr double kMotion = 0.1;  // of bodies relative to each other [m]

// Positions of doubles, which far away are rounded themselves.
void expect_right(const Recording& recording) {
  const Scene scene(recording);
  for (int i = 0; i < kFlightOutputs; ++i) {
    const Matrix3X right = calc_positions(recording, 0, i, Vector3::Zero());
    const double rounding =
        0x1p-51 * right.colwise().norm().maxCoeff();  // of the reference
    const double bound = 1e-6 * kMotion + rounding;
    const Matrix3X gap = scene.arm(i) - right;
    EXPECT_LE(gap.colwise().norm().maxCoeff(), bound) << i;
    for (const Body& body : recording.bodies) {
      const Vector3 p = body.p_WB.row(i);
      EXPECT_LE((scene.place(body.name, i) - p).norm(), bound)
          << body.name << ' ' << i;
    }
    EXPECT_LE((scene.place("post", i) - recording.shapes[0].X_BS.p).norm(),
              bound);
  }
}

TEST(Gltf, MotionIsRightToAMillionthWhereverItIs) {
  for (const Vector3& place :
       {Vector3(0.0, 0.0, 0.0), Vector3(0.0, 1e3, 0.0), Vector3(3e5, -2e5, 5e5),
        Vector3(1e7, 1.7, -3.3e6)}) {
    SCOPED_TRACE(place.transpose());
    expect_right(make_flight({.place = place}));
  }
}

TEST(Gltf, MotionIsRightToAMillionthAt7500MetresASecond) {
  expect_right(make_flight({.velocity = {7500.0, 0.0, -30.0}}));
  expect_right(make_flight({{1e6, 1e6, 0.0}, {0.0, 7500.0, 0.0}}));
}

TEST(Gltf, MotionIsRightToAMillionthBesideAStrangerFarAway) {
  for (const double speed : {0.0, 7500.0}) {
    Recording recording = make_flight({.velocity = {speed, 0.0, 0.0}});
    add_stranger(recording, {0.0, 1e7, 0.0});
    expect_right(recording);
  }
}

TEST(Gltf, NodesForPlacesAreThereWhereTheyAreNeededAlone) {
  const Scene near(make_flight({}));
  EXPECT_FALSE(near.has("offset"));
  EXPECT_FALSE(near.has("common motion"));
  EXPECT_FALSE(near.has("arm (coarse)"));
  const Scene far(make_flight({.place = {1e7, 0.0, 0.0}}));
  EXPECT_EQ(far.node("offset")["translation"], json({1e7, 0.0, 0.0}));
  EXPECT_FALSE(far.has("common motion"));
  EXPECT_FALSE(far.has("arm (coarse)"));
  const Scene fast(make_flight({.velocity = {7500.0, 0.0, 0.0}}));
  EXPECT_TRUE(fast.has("common motion"));
  EXPECT_FALSE(fast.has("arm (coarse)"));
}

TEST(Gltf, TimesCountFromTheStart) {
  const Scene scene(make_flight({.start = 1e5, .interval = 1e-3}));
  const VectorX times = scene.times();
  ASSERT_EQ(times.size(), kFlightOutputs);
  for (int i = 0; i < kFlightOutputs; ++i) {
    EXPECT_NEAR(times[i], 1e-3 * i, 1e-9) << i;
  }
  EXPECT_EQ(scene.root()["nodes"][0]["extras"]["start"], 1e5);
}

TEST(Gltf, OutputsThatSinglePrecisionWouldJoinStayTwo) {
  Recording recording = make_flight({});
  const Eigen::Index end = kFlightOutputs - 1;
  recording.times[end - 1] = recording.times[end] * (1.0 - 1e-12);
  const VectorX times = Scene(recording).times();
  ASSERT_EQ(times.size(), kFlightOutputs);
  EXPECT_GT(times[end], times[end - 1]);
  EXPECT_NEAR(times[end], recording.times[end], 1e-6 * recording.times[end]);
}

TEST(Gltf, OutputsTooCloseForSinglePrecisionAreRefused) {
  Recording recording = make_flight({});
  recording.times[1] = 1e3;
  for (Eigen::Index i = 2; i < kFlightOutputs; ++i) {
    recording.times[i] = 1e3 + 1e-12 * double(i);
  }
  EXPECT_THROW(Scene{recording}, InputError);
}

// Names of scenarios are those of files, which may have any bytes.
TEST(Gltf, BytesThatAreNotUtf8AreEscaped) {
  Recording recording = make_flight({});
  for (const auto& [name, shown] : {std::pair{"\xfc", "\\xfc"},
                                    {"\xe4", "\\xe4"},
                                    {"\xc3\xa4", "\xc3\xa4"}}) {
    recording.name = name;
    EXPECT_EQ(Scene(recording).root()["nodes"][0]["name"], shown);
  }
}

}  // namespace
}  // namespace limber::view::gltf_test
