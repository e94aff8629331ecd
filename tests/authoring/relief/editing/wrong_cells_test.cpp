#include "authoring/relief/editing/wrong_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/authoring/relief/editing/small_relief.h"

namespace arthro::authoring {
namespace {

CellMarks Marks(const glm::dvec2& from, const glm::dvec2& to, double radius) {
  CellMarks marks(test::SmallRelief::kWidth, test::SmallRelief::kHeight);
  MarkAlong(from, to, radius, marks);
  return marks;
}

bool IsMarked(const CellMarks& marks, int x, int y) {
  return marks.is_marked[static_cast<std::size_t>(y * marks.width + x)] != 0;
}

TEST(WrongCells, AreThoseWithinTheBrushAlongItsStroke) {
  CellMarks marks(61, 41);
  EXPECT_EQ(MarkAlong({10, 10}, {10, 10}, 1, marks), 5) << "a cell and its four neighbours";
  EXPECT_EQ(MarkAlong({10, 10}, {10, 10}, 1, marks), 0) << "none is new";
  EXPECT_EQ(MarkAlong({20, 10}, {24, 10}, 0.5, marks), 5);
  EXPECT_TRUE(IsMarked(marks, 24, 10));
  EXPECT_FALSE(IsMarked(marks, 25, 10));
  // Strokes that leave the relief mark what lies inside.
  EXPECT_EQ(MarkAlong({-1e9, 40}, {-1e9, 40}, 3, marks), 0);
  EXPECT_EQ(MarkAlong({60, 40}, {200, 40}, 0.5, marks), 1);
}

TEST(WrongCells, AreClosedByALinearSurroundWithoutAnError) {
  test::SmallRelief made;
  for (int y = 0; y < made.kHeight; ++y)
    for (int x = 0; x < made.kWidth; ++x)
      made.relief.at(x, y) = static_cast<float>(1e-4 * x + 2e-4 * y);
  const DepthMap truth = made.relief;
  const CellMarks marks = Marks({20, 15}, {40, 25}, 7);
  for (std::size_t i = 0; i < marks.is_marked.size(); ++i)
    if (marks.is_marked[i]) made.relief.relief[i] = 0.02f;  // a bump that is not there
  const ClosedRelief closed = CloseMarked(made.view(), marks);
  for (std::size_t i = 0; i < marks.is_marked.size(); ++i) {
    // A linear function is its own membrane; 1e-5 m is a hundredth of a millimetre.
    EXPECT_NEAR(closed.relief.relief[i], truth.relief[i], 1e-5) << i;
    EXPECT_EQ(closed.origin.origin[i] == ReliefOrigin::kInterpolated, marks.is_marked[i] != 0) << i;
  }
}

TEST(WrongCells, GetAnUncertaintyThatGrowsWithTheDistanceFromTheBorder) {
  const test::SmallRelief made;
  const ClosedRelief closed = CloseMarked(made.view(), Marks({30, 20}, {30, 20}, 10));
  EXPECT_EQ(closed.sigma.at(5, 5), made.sigma.at(5, 5));
  float before = 0;
  for (int x = 20; x <= 30; ++x) {
    EXPECT_GT(closed.sigma.at(x, 20), before) << x;
    before = closed.sigma.at(x, 20);
  }
  // Eleven cells of half a degree at 40 mm, times 0.3, beside 0.1 mm.
  EXPECT_NEAR(before, std::hypot(0.3 * 11 * 0.04 * 0.5 * 3.14159 / 180, 1e-4), 2e-5);
}

TEST(WrongCells, ThatWereUnknownStayUnknown) {
  test::SmallRelief made;
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  made.relief.at(30, 20) = unknown;
  made.origin.at(30, 20) = ReliefOrigin::kNone;
  const ClosedRelief closed = CloseMarked(made.view(), Marks({30, 20}, {30, 20}, 3));
  EXPECT_TRUE(std::isnan(closed.relief.at(30, 20)));
  EXPECT_FALSE(std::isnan(closed.relief.at(31, 20)));
  EXPECT_EQ(closed.origin.at(30, 20), ReliefOrigin::kNone);
}

TEST(WrongCells, WithoutAKnownSurroundBecomeUnknown) {
  const test::SmallRelief made;
  const ClosedRelief closed = CloseMarked(made.view(), Marks({30, 20}, {30, 20}, 200));
  EXPECT_TRUE(std::all_of(closed.relief.relief.begin(), closed.relief.relief.end(),
                          [](float h) { return std::isnan(h); }));
  EXPECT_TRUE(std::all_of(closed.origin.origin.begin(), closed.origin.origin.end(),
                          [](ReliefOrigin o) { return o == ReliefOrigin::kNone; }));
}

TEST(WrongCells, OfNoMarkChangeNothing) {
  const test::SmallRelief made;
  const ClosedRelief closed = CloseMarked(made.view(), CellMarks(61, 41));
  EXPECT_EQ(closed.relief.relief, made.relief.relief);
  EXPECT_EQ(closed.sigma.relief, made.sigma.relief);
  EXPECT_EQ(closed.origin.origin, made.origin.origin);
}

}  // namespace
}  // namespace arthro::authoring
