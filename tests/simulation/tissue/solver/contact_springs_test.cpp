// Contact forces are derivatives of their energy at every position relative to the bar, and a tool
// ends in equilibrium. A line search along the energy relies on both.
#include "simulation/tissue/solver/contact_springs.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/random.h"

namespace arthro::simulation {
namespace {

constexpr double kRadius = 5e-4;  // m, bar at the side of a punch

glm::dvec3 AnyVector(Random& random, double size) {
  const auto u = [&] { return random.Uniform(-size, size); };
  return {u(), u(), u()};
}

// Bar along x that keeps out the skin below it, at −z.
ContactPoint BarOver(Random& random) {
  ContactPoint contact;
  contact.count = 1;
  contact.weight[0] = 1.0;
  contact.is_round = true;
  contact.a = {-1e-3, 0, 0};
  contact.b = {1e-3, 0, 0};
  contact.radius = kRadius;
  contact.normal = glm::normalize(glm::dvec3(0, 0, -1) + AnyVector(random, 0.2));
  contact.stiffness = 5e3;
  contact.friction = 0.3;
  contact.owner = 0;
  contact.start = AnyVector(random, 1e-3);
  return contact;
}

// Points all around the bar: outside, inside, past its axis, beyond its ends.
TEST(ContactSpring, ForceIsTheDerivativeOfTheEnergyAroundABar) {
  Random random(5);
  constexpr double kStep = 1e-9;  // m
  int past = 0, inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const ContactPoint contact = BarOver(random);
    const glm::dvec3 point = AnyVector(random, 1.2e-3) * glm::dvec3(1, 0.5, 0.5);
    const glm::dvec3 pressing = AnyVector(random, 2.0);
    const ContactSpring spring = SpringAt(contact, point, glm::dvec3(0.0), pressing);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = kStep;
      const double after = SpringAt(contact, point + step, glm::dvec3(0.0), pressing).energy;
      const double before = SpringAt(contact, point - step, glm::dvec3(0.0), pressing).energy;
      // Error of central differences over 1e-9 m: a stiffness of at most 1e8 N/m changes the force
      // by 0.1 N in between, for forces up to 1e3 N.
      EXPECT_NEAR(-(after - before) / (2 * kStep), spring.force[axis],
                  1e-4 * (1.0 + glm::length(spring.force)))
          << "point " << point.x << " " << point.y << " " << point.z;
    }
    inside += spring.gap < 0;
    past += spring.gap < 0 && glm::dot(point, contact.normal) < 0;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(past, 200);
}

TEST(ContactSpring, EnergyIsContinuousAcrossTheAxis) {
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    const ContactPoint contact = BarOver(random);
    const glm::dvec3 beside =
        random.Uniform(0, kRadius) *
        glm::normalize(glm::cross(contact.normal, glm::dvec3(1, 0, 0) + AnyVector(random, 0.3)));
    const double x = random.Uniform(-8e-4, 8e-4);
    const auto energy = [&](double side) {
      return SpringAt(contact, glm::dvec3(x, 0, 0) + beside + side * contact.normal,
                      glm::dvec3(0.0), glm::dvec3(0.0))
          .energy;
    };
    // Force of at most 1e3 N over 2e-9 m.
    EXPECT_NEAR(energy(1e-9), energy(-1e-9), 2e-6);
  }
}

// Random skin inside a tool's bars: for any hand position the forces on the tool balance, and
// another solve from there changes nothing.
TEST(ContactSpring, ToolReachesItsEquilibrium) {
  Random random(11);
  for (int round = 0; round < 200; ++round) {
    std::vector<ContactPoint> contacts;
    std::vector<glm::dvec3> x;
    for (int i = 0; i < 40; ++i) {
      ContactPoint contact = BarOver(random);
      contact.friction = 0.03;
      contact.node[0] = i;
      contact.hold = 500.0;
      contacts.push_back(contact);
      x.push_back(
          {random.Uniform(-1e-3, 1e-3), random.Uniform(-3e-4, 3e-4), random.Uniform(-6e-4, -1e-4)});
    }
    std::vector<ToolHold> holds;
    FindHolds(contacts, holds);
    std::vector<glm::dvec3> pressing(contacts.size(), glm::dvec3(0.0));
    std::vector<ContactSpring> springs(contacts.size());
    SetSprings(contacts, x, true, true, pressing, holds, springs);
    ASSERT_EQ(holds.size(), 1u);
    glm::dvec3 left = holds[0].stiffness * holds[0].offset;
    double size = 0.0;
    for (const ContactSpring& spring : springs) {
      left += spring.force;
      size += glm::length(spring.force);
    }
    // The last iteration moves 1e-9 m; the contacts' total stiffness is below 1e6 N/m.
    EXPECT_LT(glm::length(left), 1e-3 + 1e-6 * size) << "round " << round;
  }
}

// Skin below, which the tool penetrates, and skin above, which it does not touch yet. Pushed out of
// the first it ends between both, so skin that was not touched at first also bears.
TEST(ContactSpring, ToolFeelsSkinItIsPushedInto) {
  Random random(13);
  int met = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<ContactPoint> contacts;
    std::vector<glm::dvec3> x;
    for (int i = 0; i < 40; ++i) {
      ContactPoint contact = BarOver(random);
      const double side = i % 2 == 0 ? -1.0 : 1.0;
      contact.normal = {0, 0, side};
      contact.node[0] = i;
      contact.hold = 500.0;
      contacts.push_back(contact);
      const double low = side < 0 ? 1e-4 : kRadius + 1e-5, high = side < 0 ? 3e-4 : kRadius + 2e-4;
      x.push_back({random.Uniform(-1e-3, 1e-3), random.Uniform(-1e-4, 1e-4),
                   side * random.Uniform(low, high)});
    }
    std::vector<ToolHold> holds;
    FindHolds(contacts, holds);
    std::vector<glm::dvec3> pressing(contacts.size(), glm::dvec3(0.0));
    std::vector<ContactSpring> springs(contacts.size());
    SetSprings(contacts, x, false, true, pressing, holds, springs);
    glm::dvec3 left = holds[0].stiffness * holds[0].offset;
    double size = 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ContactSpring alone = SpringAt(contacts[i], x[i], holds[0].offset, glm::dvec3(0.0));
      EXPECT_EQ(springs[i].force, alone.force);
      left += alone.force;
      size += glm::length(alone.force);
      met += i % 2 == 1 && alone.gap < 0;
    }
    // The same bound as above.
    EXPECT_LT(glm::length(left), 1e-3 + 1e-6 * size) << "round " << round;
  }
  EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace arthro::simulation
