#include "simulation/practice/reach/named_portals.h"

#include <cmath>

#include <gtest/gtest.h>

namespace arthro::simulation {
namespace {

TEST(NamedPortals, LieOnOppositeSidesOfTheTwoKnees) {
  const NamedPortals* usual = FindNamedPortals("anterolateral-anteromedial");
  ASSERT_NE(usual, nullptr);
  EXPECT_GT(SpacingOf(*usual, false), 0) << "medial is on the viewer's right of a right knee";
  for (const NamedPortals& portals : EveryNamedPortals()) {
    EXPECT_DOUBLE_EQ(SpacingOf(portals, true), -SpacingOf(portals, false));
    EXPECT_EQ(FindNamedPortals(portals.word), &portals);
    EXPECT_GE(std::abs(portals.medially), 0.01) << "two rods of 4 mm need room";
  }
  EXPECT_EQ(FindNamedPortals("posterior"), nullptr);
}

TEST(NamedPortals, AreFoundByTheirSpacing) {
  for (const bool is_left : {false, true})
    for (std::size_t i = 0; i < EveryNamedPortals().size(); ++i)
      EXPECT_EQ(NamedPortalsAt(SpacingOf(EveryNamedPortals()[i], is_left), is_left),
                static_cast<int>(i));
  EXPECT_FALSE(NamedPortalsAt(0.0333, false));
}

}  // namespace
}  // namespace arthro::simulation
