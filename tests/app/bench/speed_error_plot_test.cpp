#include "app/bench/speed_error_plot.h"

#include <cmath>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

struct Label {
  double left, right, baseline;
  std::string text;
};

// Texts of the labels' font size, with the width of an average DejaVu Sans character, 0.6 em.
std::vector<Label> LabelsOf(const std::string& svg, const std::string& word) {
  std::vector<Label> labels;
  const std::regex text(
      R"re(<text x="([-.0-9]+)" y="([-.0-9]+)" font-size="11" text-anchor="(\w+)"[^>]*>([^<]*)<)re");
  for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it) {
    const std::smatch& match = *it;
    if (match[4].str().find(word) == std::string::npos) continue;
    const double x = std::stod(match[1]), width = 0.6 * 11 * match[4].length();
    const double left = match[3] == "start" ? x : match[3] == "end" ? x - width : x - width / 2;
    labels.push_back({left, left + width, std::stod(match[2]), match[4]});
  }
  return labels;
}

std::vector<PlotMark> CrowdedMarks(int count) {
  std::mt19937 random(3);
  std::normal_distribution<double> spread(0, 0.25);
  std::vector<PlotMark> marks;
  for (int i = 0; i < count; ++i)
    marks.push_back({i % 2 ? "odd" : "even", "label number " + std::to_string(i),
                     std::exp(spread(random)), std::exp(spread(random)), 1});
  return marks;
}

TEST(SpeedErrorPlot, LabelsOfACrowdOverlapNoOther) {
  const auto labels = LabelsOf(
      SpeedErrorSvg({"title", "x", "y", "", "the truth"}, CrowdedMarks(60)), "label number");
  EXPECT_GT(labels.size(), 30u);
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const Label &a = labels[i], &b = labels[k];
      const bool overlaps =
          a.left < b.right && b.left < a.right && std::abs(a.baseline - b.baseline) < 11;
      EXPECT_FALSE(overlaps) << a.text << " and " << b.text;
    }
}

TEST(SpeedErrorPlot, CountsTheMarksThatHaveNoRoomForALabel) {
  const auto labels =
      LabelsOf(SpeedErrorSvg({"title", "x", "y", "", ""}, CrowdedMarks(400)), "label number");
  const std::string said = std::to_string(400 - labels.size()) + " of 400 marks have no room";
  EXPECT_NE(SpeedErrorSvg({"title", "x", "y", "", ""}, CrowdedMarks(400)).find(said),
            std::string::npos)
      << said;
}

TEST(SpeedErrorPlot, NamesItsReference) {
  const std::string svg = SpeedErrorSvg({"title", "x", "y", "", "truth & <form>"}, {});
  EXPECT_NE(svg.find("reference: truth &amp; &lt;form&gt;"), std::string::npos);
}

TEST(SpeedErrorPlot, DrawsMarksWithoutAnErrorInsideTheAxes) {
  const std::string svg = SpeedErrorSvg(
      {"title", "x", "y", "", ""}, {{"a", "none right", 5, std::nan(""), 0}, {"a", "b", 7, 0, 1}});
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app
