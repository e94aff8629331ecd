#include "authoring/panorama/ties/tie_file.h"

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"

namespace arthro::authoring {
namespace {

std::string SentenceOf(const std::string& text) {
  try {
    ParseTies(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.sentence();
  }
  return "";
}

std::string With(const std::string& pairs) {
  return R"({"schema": "arthroscene.ties/1", "ties": [)" + pairs + "]}";
}

TEST(TieFile, HoldsPairsWithAFrameOrWithThePanorama) {
  const auto ties = ParseTies(With(
      R"({"frame": 7, "pixel": [10.5, 20], "other": {"frame": 3, "pixel": [30, 40]}},
         {"frame": 7, "pixel": [50, 60], "panorama": {"pixel": [700, 800.25]}})"));
  ASSERT_EQ(ties.size(), 2u);
  EXPECT_EQ(ties[0].other->frame, 3);
  EXPECT_EQ(ties[0].pixel, glm::dvec2(10.5, 20));
  EXPECT_EQ(ties[1].panorama->pixel, glm::dvec2(700, 800.25));
}

TEST(TieFile, RefusesInOneSentence) {
  EXPECT_NE(SentenceOf("[]").find("must be a JSON object"), std::string::npos);
  EXPECT_NE(SentenceOf(R"({"schema": "arthroscene.pairs/1", "ties": []})").find("its schema is"),
            std::string::npos);
  EXPECT_NE(SentenceOf(With(R"({"frame": 7, "pixel": [1, 2]})")).find("one partner"),
            std::string::npos);
  EXPECT_NE(
      SentenceOf(With(R"({"frame": 7, "pixel": [1, 2], "other": {"frame": 7, "pixel": [1, 2]}})"))
          .find("joins a frame to itself"),
      std::string::npos);
  EXPECT_NE(SentenceOf(With(R"({"frame": -1, "pixel": [1, 2], "panorama": {"pixel": [1, 2]}})"))
                .find("ties[0].frame"),
            std::string::npos);
  EXPECT_NE(SentenceOf(With(R"({"frame": 1, "pixel": [1], "panorama": {"pixel": [1, 2]}})"))
                .find("ties[0].pixel"),
            std::string::npos);
}

TEST(TieFile, SchemaThatIsShippedIsTheOneThatTheProgramPrints) {
  const std::filesystem::path copy =
      std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/schemas/ties-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), TiesSchemaText())
      << "run: build/release/bin/arthroscene check --ties-schema > "
         "resources/schemas/ties-1.schema.json";
}

}  // namespace
}  // namespace arthro::authoring
