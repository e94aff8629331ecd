#include "simulation/core/folders/file_name.h"

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(FileName, HoldsLowerCaseLettersDigitsAndSingleDashes) {
  EXPECT_EQ(FileNameFrom("Medial meniscus", "tissue"), "medial-meniscus");
  EXPECT_EQ(FileNameFrom("  A / ..\\B 2 ", "tissue"), "a-b-2");
}

TEST(FileName, FallsBackWithoutLettersAndDigits) {
  EXPECT_EQ(FileNameFrom("", "tissue"), "tissue");
  EXPECT_EQ(FileNameFrom("../", "tissue"), "tissue");
}

}  // namespace
}  // namespace arthro
