// SPDX-License-Identifier: BSD-3-Clause
// Numbers mean the same wherever the program runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <locale>

#include "limber/scene/robot/akantu_material.hpp"
#include "limber/scene/robot/robot_reader.hpp"
#include "limber/scene/scenario/scenario_reader.hpp"
#include "limber/scene/text/force_file.hpp"
#include "limber/scene/text/series_file.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::reading_test {
namespace {

using test::TemporaryFile;
using ::testing::ElementsAre;

class CommaForPoint : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// 1.5 is written 1,5 while it lives, by C++ and, where the system has such a
/// locale, by C.
class GermanLocale {
 public:
  GermanLocale()
      : before_(std::locale::global(
            std::locale(std::locale::classic(), new CommaForPoint))) {
    std::setlocale(LC_ALL, "de_DE.UTF-8");
  }
  GermanLocale(const GermanLocale&) = delete;
  GermanLocale& operator=(const GermanLocale&) = delete;
  ~GermanLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");
  }

 private:
  std::locale before_;
};

TEST(Reading, KnowsNoLocale) {
  const TemporaryFile series("s.csv", "t;v\n0.5;1234.5\n1.5,2.25\n");
  const TemporaryFile forces("f.txt", "0 0.5\n1.25 -2.5e3\n");
  const TemporaryFile material(
      "m.dat", "material elastic [ rho = 7800.5 E = 2.1e11 nu = 0.25 ]");
  const TemporaryFile robot(
      "r.urdf",
      "<robot name='r'><link name='a'><inertial><origin xyz='0.5 0 0'/>"
      "<mass value='1.5'/><inertia ixx='1.5' iyy='1.5' izz='1.5' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link><link name='b'/><joint name='j' "
      "type='continuous'><parent link='a'/><child link='b'/><origin "
      "xyz='0 0 0.25'/><axis xyz='0 0 1'/><dynamics damping='0.75'/></joint>"
      "</robot>");
  const TemporaryFile scenario(
      "s.toml", "robot = 'r.urdf'\n[time]\nduration = 2.5\nstep = 1.25e-3\n");
  const GermanLocale german;
  EXPECT_THAT(read_series(series.path()).values, ElementsAre(1234.5, 2.25));
  EXPECT_EQ(read_force_file(forces.path()).forces(0, 1), -2500.0);
  EXPECT_EQ(read_akantu_materials(material.path())[0].material.density, 7800.5);
  const Robot read = read_robot(robot.path());
  EXPECT_EQ(read.links[0].inertia->mass, 1.5);
  EXPECT_EQ(read.joints[0].X_PJ.p.z(), 0.25);
  EXPECT_EQ(read.joints[0].coupler.free_damping, 0.75);
  EXPECT_EQ(read_scenario(scenario.path()).settings.end_time, 2.5);
}

}  // namespace
}  // namespace limber::scene::reading_test
