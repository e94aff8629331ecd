#include "authoring/depth/imaged_area.h"

#include <string>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

// '.' tissue, 'd' dark, 'b' black (which is dark too).
std::vector<std::uint8_t> Flags(const std::vector<std::string>& rows) {
  std::vector<std::uint8_t> flags;
  for (const std::string& row : rows)
    for (const char c : row)
      flags.push_back(c == 'd' ? kDark : c == 'b' ? std::uint8_t(kDark | kBlack) : 0);
  return flags;
}

std::vector<std::string> SurroundOfPicture(const std::vector<std::string>& rows, int margin = 0) {
  const int width = static_cast<int>(rows[0].size()), height = static_cast<int>(rows.size());
  const auto flags = Flags(rows);
  const auto grown = Grow(SurroundOf(RunsOf(flags, width, height, kDark), flags, width, height),
                          width, height, margin);
  std::vector<std::string> shown;
  for (int y = 0; y < height; ++y) {
    shown.emplace_back();
    for (int x = 0; x < width; ++x) shown[y] += grown[y * width + x] ? '#' : '.';
  }
  return shown;
}

TEST(ImagedArea, SurroundIsDarkAndJoinedToTheEdge) {
  EXPECT_EQ(SurroundOfPicture({"ddbdd...",  //
                               "d......d",  //
                               "...dd..d",  // a dark recess inside: tissue
                               "...d....",  //
                               ".......d"}),
            (std::vector<std::string>{"#####...",  //
                                      "#......#",  //
                                      ".......#",  //
                                      "........",  //
                                      ".......#"}));
}

TEST(ImagedArea, SurroundRunsRoundCornersButNotDiagonally) {
  EXPECT_EQ(SurroundOfPicture({"........",  //
                               ".dddddd.",  // connected to the bottom by its right leg
                               ".d....d.",  //
                               ".dd...d.",  //
                               "...d..d."}),
            (std::vector<std::string>{"........",  //
                                      ".######.",  //
                                      ".#....#.",  //
                                      ".##...#.",  //
                                      "...#..#."}));
  EXPECT_EQ(SurroundOfPicture({"d...",  //
                               ".d..",  // touches the surround at a corner only
                               "...."}),
            (std::vector<std::string>{"#...", "....", "...."}));
}

TEST(ImagedArea, AHoleThatAMosaicLeftIsSurroundButASpeckIsNot) {
  std::vector<std::string> rows(14, std::string(16, '.'));
  for (int y = 3; y < 11; ++y) rows[y].replace(2, 8, "bbbbbbbb");  // 64 px of pure black
  rows[12].replace(12, 2, "bb");
  auto expected = std::vector<std::string>(14, std::string(16, '.'));
  for (int y = 3; y < 11; ++y) expected[y].replace(2, 8, "########");
  EXPECT_EQ(SurroundOfPicture(rows), expected);
  rows[5][5] = 'd';  // one dim pixel makes it a dark recess
  EXPECT_EQ(SurroundOfPicture(rows), std::vector<std::string>(14, std::string(16, '.')));
}

TEST(ImagedArea, MarginGrowsTheSurroundOnAllSides) {
  EXPECT_EQ(SurroundOfPicture({"......",  //
                               "......",  //
                               "d.....",  //
                               "......",  //
                               "......"},
                              1),
            (std::vector<std::string>{"......", "##....", "##....", "##....", "......"}));
}

}  // namespace
}  // namespace arthro::authoring
