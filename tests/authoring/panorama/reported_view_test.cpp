// The projection that a report of a panorama names, and one sentence for what lacks it.
#include <string>

#include <gtest/gtest.h>

#include "authoring/panorama/report_io.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

ReportedView Read(const std::string& text) { return ViewFromReport(text, "r.json"); }

std::string Refusal(const std::string& text) {
  try {
    Read(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReportedView, IsTheReportsEntryPanorama) {
  const ReportedView view =
      Read(R"({"panorama":{"width":800,"height":300,"focal_px":500,"cx":1.5,"cy":2},"frames":[]})");
  EXPECT_EQ(view.projection.type, ProjectionType::kGnomonic);
  EXPECT_DOUBLE_EQ(view.projection.focal_px, 500);
  EXPECT_EQ(view.projection.centre_px, glm::dvec2(1.5, 2));
  EXPECT_EQ(view.width, 800);
  EXPECT_EQ(view.height, 300);
}

TEST(ReportedView, OverAReliefIsEquirectangular) {
  const ReportedView view = Read(
      R"({"panorama":{"width":8,"height":3,"projection":{"centre_px":[4,1],"px_per_deg":12.5}}})");
  EXPECT_EQ(view.projection.type, ProjectionType::kEquirectangular);
  EXPECT_DOUBLE_EQ(view.projection.px_per_deg, 12.5);
  EXPECT_EQ(view.projection.centre_px, glm::dvec2(4, 1));
}

TEST(ReportedView, AMissingNumberIsNamed) {
  EXPECT_NE(Refusal(R"({"panorama":{"width":8,"height":3,"cx":1,"cy":2}})").find("\"focal_px\""),
            std::string::npos);
  EXPECT_NE(Refusal(R"({"panorama":{"width":"8","height":3,"focal_px":9,"cx":1,"cy":2}})")
                .find("\"width\""),
            std::string::npos);
  for (const char* centre : {"[4]", "[4,1,2]", "[4,\"1\"]", "4", "null"})
    EXPECT_NE(Refusal(R"({"panorama":{"width":8,"height":3,"projection":{"px_per_deg":12.5,)"
                      R"("centre_px":)" +
                      std::string(centre) + "}}}")
                  .find("\"centre_px\""),
              std::string::npos)
        << centre;
  EXPECT_NE(Refusal("[]").find("\"panorama\""), std::string::npos);
  EXPECT_NE(Refusal("7").find("\"panorama\""), std::string::npos);
}

}  // namespace
}  // namespace arthro::authoring
