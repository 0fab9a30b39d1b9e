// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "limber/dynamics/simulation/run_record.hpp"
#include "unit/scene/scene_folder.hpp"

/// Six spheres on two slides close on a box that tumbles, and hold it by
/// friction alone.
namespace limber::scene::grasp_slow {
namespace {

using test::kWorld;
using test::rigid_link;
using test::SceneFolder;
using test::time_table;

// A slide is pushed towards the middle and damped; its three tips are on a
// circle of 30 mm.
std::string make_finger(int number, double x, double inwards) {
  std::string link = rigid_link(fmt::format("finger_{}", number), 0.5, 5e-4);
  std::string tips;
  for (int k = 0; k < 3; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 3.0;
    tips += fmt::format(
        "<collision><origin xyz='0 {} {}'/><geometry><sphere radius='0.01'/>"
        "</geometry></collision>\n",
        0.03 * std::cos(angle), 0.03 * std::sin(angle));
  }
  link.insert(link.find("</link>"), tips);
  return fmt::format(
      "<joint name='slide_{0}' type='prismatic'><parent link='world'/><child "
      "link='finger_{0}'/><origin xyz='{1} 0 0'/><axis xyz='{2} 0 0'/><limit "
      "lower='-1' upper='1' effort='100' velocity='10'/><dynamics "
      "damping='400'/></joint>\n{3}<contact link='finger_{0}' "
      "youngs_modulus='0.91e9' poisson_ratio='0.3'/>\n",
      number, x, inwards, link);
}

std::string make_box() {
  return "<link name='box'><inertial><mass value='2'/><inertia ixx='0.014667' "
         "iyy='0.013333' izz='0.013333' ixy='0' ixz='0' iyz='0'/></inertial>"
         "<collision><geometry><box size='0.2 0.2 0.2'/></geometry>"
         "</collision></link>\n";
}

std::string make_scenario(double step) {
  std::string text =
      time_table(11.0, step) +
      "output_interval = 1.0\n[[robot]]\nname = 'hand'\nfile = 'hand.urdf'\n"
      "[[robot]]\nname = 'target'\nfile = 'box.urdf'\norientation_rpy = [0.1, "
      "0.05, 0.2]\nvelocity = [0.01, 0.01, 0.0]\nangular_velocity = [0.2, 0.3, "
      "0.1]\n[[contact]]\nbetween = ['hand.*', 'target.*']\nfriction = 0.5\n"
      "restitution = 0.5\n[[load]]\nname = 'side'\nlink = 'target.box'\nframe "
      "= 'world'\nforce = [0.0, 1.2, -1.6]\ntime = { kind = 'constant', from = "
      "1.0 }\n[[probe]]\nname = 'box'\nlink = 'target.box'\nquantity = "
      "'position'\n[[probe]]\nname = 'turn'\nlink = 'target.box'\nquantity = "
      "'rotation'\n";
  for (const int finger : {1, 2}) {
    text += fmt::format(
        "[[drive]]\nname = 'push_{0}'\njoint = 'hand.slide_{0}'\nmode = "
        "'effort'\nsignal = {{ kind = 'constant', value = 20.0 }}\n[[probe]]\n"
        "name = 'force_{0}'\ncontact = ['hand.finger_{0}', 'target.box']\n",
        finger);
  }
  return text;
}

Vector3 find(const std::vector<double>& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

struct Held {
  std::vector<std::vector<double>> rows;  // every second
  std::vector<long> halved;               // steps so far, likewise
  dynamics::RunRecord record;
};

Held run(double step) {
  const SceneFolder folder;
  const auto write = [&](const std::string& name, const std::string& links) {
    std::ofstream(folder.path() / name) << "<robot name='r'>\n"
                                        << links << "</robot>\n";
  };
  write("hand.urdf",
        kWorld + make_finger(1, -0.17, 1.0) + make_finger(2, 0.17, -1.0));
  write("box.urdf", make_box());
  std::ofstream(folder.path() / "grasp.toml") << make_scenario(step);
  const BuiltScene built =
      folder.build(load_scene(folder.path() / "grasp.toml"));
  Held held;
  dynamics::SystemState state = built.initial;
  dynamics::SimulationStatistics statistics;
  dynamics::simulate(
      built.model, state, built.settings,
      [&](const dynamics::SystemState& now, const dynamics::EnergyBalance&) {
        held.rows.push_back(evaluate_all(built.probes, built.model, now));
        held.halved.push_back(statistics.halved_steps);
      },
      {}, statistics, {}, {}, held.record);
  EXPECT_EQ(held.rows.size(), 12U);
  held.rows.resize(12, std::vector<double>(12));
  held.halved.resize(12);
  return held;
}

// Its last strikes are before 5 s; of those of less than eight steps the steps
// that gain energy are halved.
TEST(Grasp, HoldsABoxThatTumbledAgainstASideLoad) {
  const auto [rows, halved, record] = run(1e-3);
  EXPECT_EQ(halved[11], halved[5]);
  EXPECT_LT((find(rows[11], 0) - find(rows[6], 0)).norm(), 1e-8);
  EXPECT_LT((find(rows[11], 3) - find(rows[6], 3)).norm(), 1e-8);
  // It rests: what the fingers exert is what the load is.
  const Vector3 held = find(rows[11], 6) + find(rows[11], 9);
  EXPECT_LT((held + Vector3(0.0, 1.2, -1.6)).norm(), 1e-6);
  // It did tumble, and was struck more than once.
  EXPECT_GT(find(rows[11], 3).norm(), 0.05);
  EXPECT_GT(record.contacts.size(), 6U);
}

// Of 48 000 steps at most one in a thousand.
TEST(Grasp, HalvesHardlyAnyStepWhereStepsResolveItsImpacts) {
  EXPECT_LE(run(2.5e-4).halved[11], 48);
}

}  // namespace
}  // namespace limber::scene::grasp_slow
