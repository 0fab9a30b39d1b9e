// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/contact_probe_reader.hpp"

#include <gmock/gmock.h>

#include "limber/scene/scenario/scenario_reader.hpp"
#include "unit/scene/temporary_file.hpp"

namespace limber::scene::contact_probe_reader_test {
namespace {

using test::input_error;
using test::TemporaryFile;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kProbe = "[[probe]]\nname='p'\ncontact=['a', 'b']\n";

Scenario read(const std::string& text) {
  const TemporaryFile file("scenario.toml",
                           "robot = \"r.urdf\"\n[time]\nduration = 1.0\n"
                           "step = 0.1\n" +
                               text);
  return read_scenario(file.path());
}

ContactProbeSpec read_one(const std::string& text) {
  return std::get<ContactProbeSpec>(read(text).probes.at(0).of);
}

std::string error_of(const std::string& text) {
  return input_error([&] { (void)read(text); });
}

TEST(ContactProbeReader, ReadsTheForceUnlessAskedForAnother) {
  const ContactProbeSpec probe = read_one(kProbe);
  EXPECT_THAT(probe.bodies, ElementsAre("a", "b"));
  EXPECT_EQ(probe.quantity, ContactQuantity::force);
}

TEST(ContactProbeReader, ReadsEveryQuantity) {
  const auto quantity = [](const std::string& name) {
    return read_one(kProbe + "quantity='" + name + "'\n").quantity;
  };
  EXPECT_EQ(quantity("force"), ContactQuantity::force);
  EXPECT_EQ(quantity("normal_force"), ContactQuantity::normal_force);
  EXPECT_EQ(quantity("friction_force"), ContactQuantity::friction_force);
  EXPECT_EQ(quantity("place"), ContactQuantity::place);
  EXPECT_EQ(quantity("depth"), ContactQuantity::depth);
  EXPECT_EQ(quantity("area"), ContactQuantity::area);
  EXPECT_EQ(quantity("energy"), ContactQuantity::energy);
  EXPECT_EQ(quantity("touching"), ContactQuantity::touching);
  EXPECT_EQ(quantity("slipping"), ContactQuantity::slipping);
}

TEST(ContactProbeReader, RefusesKeysThatContactsDoNotHave) {
  EXPECT_THAT(error_of(kProbe + "quantity='froce'\n"),
              HasSubstr("did you mean 'force'"));
  EXPECT_THAT(
      error_of(kProbe + "side='M'\n"),
      HasSubstr("applies only to couplers; a contact's force is that on "
                "the second body of 'contact'"));
  EXPECT_THAT(error_of(kProbe + "frame='world'\n"),
              HasSubstr("vectors of a contact are in the world frame"));
  EXPECT_THAT(error_of(kProbe + "link='a'\ncoupler='c'\n"),
              AllOf(HasSubstr("both 'link' and 'contact'"),
                    HasSubstr("both 'coupler' and 'contact'")));
  EXPECT_THAT(error_of(kProbe + "point=[0.0, 0.0, 0.0]\n"),
              HasSubstr("unknown key 'point'"));
}

TEST(ContactProbeReader, NeedsTheNamesOfTwoBodies) {
  const auto error = [](const std::string& contact) {
    return error_of("[[probe]]\nname='p'\ncontact=" + contact + "\n");
  };
  EXPECT_THAT(error("['a']"),
              HasSubstr("has 1 names; expected those of two bodies"));
  EXPECT_THAT(error("['a', 'b', 'c']"), HasSubstr("has 3 names"));
  EXPECT_THAT(error("'a'"), HasSubstr("contact"));
}

}  // namespace
}  // namespace limber::scene::contact_probe_reader_test
