#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/scene/image_io.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

constexpr double kRadius = 0.05, kDegree = std::numbers::pi / 180.0;
constexpr const char* kGnomonic =
    R"({"type": "gnomonic", "centre_px": [2048, 1024], "focal_px": 1500})";
constexpr const char* kEquirectangular =
    R"({"type": "equirectangular", "centre_px": [1800, 900], "px_per_deg": 10})";

void WriteSceneJson(const TempFolder& folder, const char* projection) {
  std::ofstream(folder / "scene.json")
      << R"({"schema": "arthroscene.scene/1", "title": "grid", "backdrop": {"panorama": "grid.png",
"radius": 0.05, "projection": )"
      << projection << R"(}, "scope": {"view_angle_deg": 30, "field_of_view_deg": 90,
"rod_length": 0.2}, "portals": {"incision_spacing": 0.03}})";
}

struct Centre {
  double insertion, roll_deg;
  std::optional<double> u, v;
};

std::vector<Centre> ReadCentres(const std::string& text) {
  std::vector<Centre> centres;
  std::istringstream stream(text);
  std::string line, cell;
  std::getline(stream, line);
  EXPECT_EQ(line, "insertion,roll_deg,u_px,v_px");
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    std::vector<std::string> values;
    while (std::getline(cells, cell, ',')) values.push_back(cell);
    values.resize(4);
    Centre centre{std::stod(values[0]), std::stod(values[1]), {}, {}};
    if (!values[2].empty()) centre.u = std::stod(values[2]);
    if (!values[3].empty()) centre.v = std::stod(values[3]);
    centres.push_back(centre);
  }
  return centres;
}

// The closed form [method.md, Oblique view] once more: the centre lies at the angular distance
// β = α − asin(ρ/D sin α) from the rod's direction, at the bearing γ from north towards east. By
// spherical trigonometry: sin φ' = sin φ cos β + cos φ sin β cos γ,
// λ' = λ + atan2(sin β sin γ, cos φ cos β − sin φ sin β cos γ).
struct Expected {
  double latitude, longitude;
};
Expected ClosedForm(double alpha, double depth, double roll, double latitude, double longitude) {
  const double beta = alpha - std::asin(depth / kRadius * std::sin(alpha));
  const double turn = std::atan2(
      std::sin(beta) * std::sin(roll),
      std::cos(latitude) * std::cos(beta) - std::sin(latitude) * std::sin(beta) * std::cos(roll));
  return {std::asin(std::sin(latitude) * std::cos(beta) +
                    std::cos(latitude) * std::sin(beta) * std::cos(roll)),
          std::remainder(longitude + turn, 2.0 * std::numbers::pi)};  // the panorama's ±180 degrees
}

TEST(CentresJob, PixelsAreTheClosedFormsToAHundredthOfAPixel) {
  double worst = 0.0;
  int compared = 0, empty = 0;
  for (const bool is_gnomonic : {true, false}) {
    const TempFolder folder;
    WriteSceneJson(folder, is_gnomonic ? kGnomonic : kEquirectangular);
    for (const double alpha_deg : {0.0, 30.0, 70.0, 90.0})
      for (const auto& [latitude_deg, longitude_deg] :
           {std::pair{0.0, 0.0}, std::pair{17.0, -23.0}, std::pair{-8.0, 5.0}}) {
        const ProgramResult run = RunProgram(fmt::format(
            "centres {} --view-angle-deg {} --insertion-mm 0,0.5,5,10,15,35,49.9,50 --latitude-deg "
            "{} --longitude-deg {} -o -",
            (folder / "scene.json").string(), alpha_deg, latitude_deg, longitude_deg));
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const std::vector<Centre> centres = ReadCentres(run.out);
        ASSERT_EQ(centres.size(), 8u * 72u);
        for (const Centre& centre : centres) {
          const auto [phi, lambda] =
              ClosedForm(alpha_deg * kDegree, centre.insertion, centre.roll_deg * kDegree,
                         latitude_deg * kDegree, longitude_deg * kDegree);
          double u = 1800 + 10 * lambda / kDegree, v = 900 - 10 * phi / kDegree;
          if (is_gnomonic) {
            const double z = std::cos(phi) * std::cos(lambda);
            if (z < 1e-6) {
              EXPECT_FALSE(centre.u && z < -1e-6);
              ++empty;
              continue;
            }
            u = 2048 + 1500 * std::tan(lambda);
            v = 1024 - 1500 * std::sin(phi) / z;
          }
          ASSERT_TRUE(centre.u && centre.v);
          // Far outside the picture a pixel is known to the ten digits of the table.
          const double tolerance = std::max(1.0, 1e-7 * std::hypot(u, v));
          worst = std::max(worst, std::hypot(*centre.u - u, *centre.v - v) / tolerance);
          ++compared;
        }
      }
  }
  std::printf("%d centres: at most %.1e px from the closed form; %d without a pixel\n", compared,
              worst, empty);
  EXPECT_GT(compared, 10000);
  EXPECT_GT(empty, 0);
  EXPECT_LT(worst, 0.01);
}

TEST(CentresJob, AnglesAndDepthsDefaultToTheScene) {
  const TempFolder folder;
  WriteSceneJson(folder, kGnomonic);
  const std::string scene = folder.path().string();
  const ProgramResult plain = RunProgram("centres " + scene + " -o -");
  const ProgramResult same =
      RunProgram("centres " + scene + " --view-angle-deg 30 --insertion-mm 5,10,15 -o -");
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(plain.out, same.out);
  EXPECT_NE(plain.out.find("\n0.005,0,"), std::string::npos) << "insertion is in metres";
  const ProgramResult steps = RunProgram("centres " + scene + " --roll-steps 4 -o -");
  EXPECT_EQ(ReadCentres(steps.out).size(), 12u);
}

TEST(CentresJob, CentreWithoutAPixelIsEmptyAndSaid) {
  const TempFolder folder;
  WriteSceneJson(folder, kGnomonic);
  const ProgramResult run = RunProgram("centres " + folder.path().string() +
                                       " --view-angle-deg 90 --insertion-mm 0 -o -");
  EXPECT_EQ(run.exit_code, 0);
  for (const Centre& centre : ReadCentres(run.out)) EXPECT_FALSE(centre.u || centre.v);
  EXPECT_NE(run.err.find("72 of 72"), std::string::npos) << run.err;
}

// Fig. 7 of the paper, on the panorama and on a grid.
TEST(CentresJob, ThePictureShowsTheCentresOfTheTable) {
  const TempFolder folder;
  WriteSceneJson(folder, kGnomonic);
  const std::string scene = folder.path().string(), picture = (folder / "fig7.png").string();
  const std::string job = "centres " + scene + " --roll-steps 24 -o - --picture " + picture;
  const ProgramResult without = RunProgram(job);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.err.find("grid.png"), std::string::npos) << without.err;
  EXPECT_FALSE(std::filesystem::exists(picture));

  ColourImage panorama(4096, 2048);
  std::fill(panorama.rgb.begin(), panorama.rgb.end(), std::uint8_t{90});
  WriteColourImage(folder / "grid.png", panorama);
  const auto colour_at = [](const ColourImage& image, double x, double y) {
    const std::uint8_t* p =
        image.at(static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y)));
    return std::array{p[0], p[1], p[2]};
  };
  for (const bool on_grid : {false, true}) {
    const ProgramResult run = RunProgram(job + (on_grid ? " --on-grid" : ""));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.out, RunProgram("centres " + scene + " --roll-steps 24 -o -").out);
    const ColourImage shown = ReadColourImage(picture);
    ASSERT_EQ(shown.width, 4096);
    // A line has one colour, and each of the three its own.
    std::map<double, std::array<std::uint8_t, 3>> colours;
    for (const Centre& centre : ReadCentres(run.out)) {
      ASSERT_TRUE(centre.u && centre.v);
      const auto colour = colour_at(shown, *centre.u, *centre.v);
      EXPECT_EQ(colours.emplace(centre.insertion, colour).first->second, colour) << centre.roll_deg;
    }
    ASSERT_EQ(colours.size(), 3u);
    std::set<std::array<std::uint8_t, 3>> different;
    for (const auto& [insertion, colour] : colours) different.insert(colour);
    EXPECT_EQ(different.size(), 3u);
    // The cross where the rod points, and the ground below.
    EXPECT_EQ(colour_at(shown, 2048, 1024), (std::array<std::uint8_t, 3>{0, 0, 0}));
    const std::uint8_t line = on_grid ? 160 : 90, ground = on_grid ? 255 : 90;
    EXPECT_EQ(colour_at(shown, 128, 1990)[0], line);
    EXPECT_EQ(colour_at(shown, 190, 1990)[0], ground);
  }
}

TEST(CentresJob, WhatCannotBeIsRefused) {
  const TempFolder folder;
  WriteSceneJson(folder, kGnomonic);
  const std::string output = (folder / "centres.csv").string();
  const auto run = [&](const std::string& arguments) {
    return RunProgram("centres " + arguments + " -o " + output).exit_code;
  };
  EXPECT_EQ(run(folder.path().string() + " --insertion-mm 50.1"), 1);
  EXPECT_EQ(run(folder.path().string() + " --insertion-mm=-1"), 1);
  EXPECT_EQ(run(folder.path().string() + " --insertion-mm nan"), 2);
  EXPECT_EQ(run(folder.path().string() + " --insertion-mm 1,,5"), 2);
  EXPECT_EQ(run(folder.path().string() + " --insertion-mm '1;5'"), 2);
  EXPECT_EQ(run(folder.path().string() + " --latitude-deg nan"), 2);
  EXPECT_EQ(run((folder / "nothing").string()), 1);
  EXPECT_EQ(run(folder.path().string() + " --view-angle-deg 120"), 2);
  EXPECT_EQ(run(folder.path().string() + " --roll-steps 0"), 2);
  EXPECT_FALSE(std::filesystem::exists(output));
}

}  // namespace
}  // namespace arthro::test
