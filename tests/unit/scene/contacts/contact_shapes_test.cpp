// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/contact_shapes.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"

namespace limber::scene::contact_shapes_test {
namespace {

// Files give whole lengths, as URDF does, shapes have halves.
TEST(ContactShapes, HalveLengthsAndKeepRadii) {
  EXPECT_EQ(std::get<contact::Sphere>(make_shape(SphereGeometry{2.0})).radius,
            2.0);
  EXPECT_EQ(std::get<contact::Box>(make_shape(BoxGeometry{Vector3(2, 4, 6)}))
                .half_size,
            Vector3(1, 2, 3));
  const auto cylinder =
      std::get<contact::Cylinder>(make_shape(CylinderGeometry{2.0, 6.0}));
  EXPECT_EQ(cylinder.radius, 2.0);
  EXPECT_EQ(cylinder.half_length, 3.0);
  const auto cone = std::get<contact::Cone>(make_shape(ConeGeometry{2.0, 6.0}));
  EXPECT_EQ(cone.radius, 2.0);
  EXPECT_EQ(cone.half_length, 3.0);
  const Vector3 radii(1.0, 2.0, 3.0);
  EXPECT_EQ(
      std::get<contact::Ellipsoid>(make_shape(EllipsoidGeometry{radii})).radii,
      radii);
  const auto capsule =
      std::get<contact::Capsule>(make_shape(CapsuleGeometry{2.0, 6.0}));
  EXPECT_EQ(capsule.radius, 2.0);
  EXPECT_EQ(capsule.half_length, 3.0);
  EXPECT_TRUE(
      std::holds_alternative<contact::HalfSpace>(make_shape(PlaneGeometry{})));
  EXPECT_THROW((void)make_shape(OtherGeometry{"mesh"}), ContractError);
}

TEST(ContactShapes, ParametersOfAContactAreItsOptions) {
  ContactOptions options;
  options.friction = 0.3;
  options.static_friction = 0.5;
  options.stribeck_speed = 0.02;
  options.restitution = 0.6;
  options.radius = 0.01;
  options.stiffness = 1e9;
  const contact::ContactParameters parameters = make_parameters(options);
  EXPECT_EQ(contact::find_coefficient(parameters.friction, 0.0).value, 0.5);
  EXPECT_NEAR(contact::find_coefficient(parameters.friction, 1.0).value, 0.3,
              1e-12);
  EXPECT_EQ(parameters.friction.speed, 0.02);
  EXPECT_EQ(parameters.restitution, 0.6);
  EXPECT_EQ(parameters.radius, 0.01);
  EXPECT_EQ(parameters.stiffness, 1e9);
  EXPECT_FALSE(parameters.damping);
}

TEST(ContactShapes, WithoutOptionsThereIsNeitherFrictionNorLoss) {
  const contact::ContactParameters parameters = make_parameters({});
  EXPECT_EQ(contact::find_coefficient(parameters.friction, 0.0).value, 0.0);
  EXPECT_EQ(parameters.restitution, 1.0);
  ContactOptions alike;
  alike.friction = 0.3;
  EXPECT_EQ(make_parameters(alike).friction.excess, 0.0);
}

}  // namespace
}  // namespace limber::scene::contact_shapes_test
