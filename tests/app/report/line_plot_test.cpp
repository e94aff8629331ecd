// Curves keep what a reader looks for in them.
#include "app/plot/line_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

TEST(LinePlot, ThinningKeepsTheLargestAndTheLeastValue) {
  Curve curve{"force", {}};
  for (int i = 0; i < 60000; ++i) curve.points.emplace_back(0.01 * i, std::sin(0.001 * i));
  curve.points[31234].second = 9.1;  // one frame
  curve.points[222].second = -7;
  const Curve thin = Thinned(curve, 1600);
  EXPECT_LE(thin.points.size(), 1600u);
  const auto [least, most] =
      std::minmax_element(thin.points.begin(), thin.points.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; });
  EXPECT_EQ(most->second, 9.1);
  EXPECT_EQ(least->second, -7);
  EXPECT_TRUE(std::is_sorted(thin.points.begin(), thin.points.end()));
  EXPECT_EQ(Thinned({"", {{0, 1}, {1, 2}}}, 1600).points.size(), 2u);
}

TEST(LinePlot, GapsPartACurve) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  LinePlot plot;
  plot.curves = {{"a", {{0, 1}, {1, 2}, {2, none}, {3, 1}, {4, 2}}}};
  const std::string svg = LinePlotSvg(plot);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const std::string path = svg.substr(svg.rfind("<path d=\"M"));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
}

// Number behind the last `key` before the text `words`.
double NumberBefore(const std::string& svg, const std::string& words, const std::string& key) {
  const std::size_t at = svg.rfind(key, svg.find(words));
  return std::stod(svg.substr(at + key.size()));
}

TEST(LinePlot, NamesOfDivisionsCrossNoLimitAndNoneOfItsWords) {
  for (const double limit : {2.0, 7.0, 8.0, 8.4, 8.5}) {
    LinePlot plot;
    plot.begins_at_zero = true;
    plot.curves = {{"a", {{0, 1}, {10, 8.5}}}};
    plot.limits = {{limit, "limit"}};
    plot.divisions = {{1, "step"}};
    const std::string svg = LinePlotSvg(plot);
    const double words = NumberBefore(svg, ">step<", "y=\"");
    const double limit_words = NumberBefore(svg, ">limit<", "y=\"");
    const double line = limit_words + 4;  // the words of a limit stand 4 px above it
    EXPECT_NE(svg.find(" " + std::to_string(static_cast<int>(line)) + "."), std::string::npos);
    // Letters of 11 px: 11 px above their baseline and 3 px below it.
    EXPECT_TRUE(words - 11 >= line || words + 3 <= line) << limit;
    EXPECT_TRUE(words - 11 >= limit_words + 3 || words + 3 <= limit_words - 11) << limit;
  }
}

TEST(LinePlot, SaysThatNothingWasMeasured) {
  EXPECT_NE(LinePlotSvg({}).find("Nothing was measured."), std::string::npos);
  LinePlot one;
  one.curves = {{"a", {{2, 3}}}};
  one.begins_at_zero = true;
  EXPECT_EQ(LinePlotSvg(one).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app
