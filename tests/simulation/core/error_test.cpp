#include "simulation/core/error.h"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <gtest/gtest.h>

namespace arthro {
namespace {

// Letters of UTF-8.
std::size_t LengthOf(const std::string& text) {
  std::size_t letters = 0;
  for (const char c : text) letters += (c & 0xc0) != 0x80;
  return letters;
}

TEST(PrintableLine, LeavesPlainTextAlone) {
  for (const std::string text :
       {"", "a sentence; with \"names\", 12 µm and Ó Súilleabháin…", "日本"})
    EXPECT_EQ(PrintableLine(text), text);
}

TEST(PrintableLine, EscapesControlAndDirectionCharacters) {
  EXPECT_EQ(PrintableLine("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(PrintableLine("\x1b[31mred\x07\x7f"), "\\x1b[31mred\\x07\\x7f");
  EXPECT_EQ(PrintableLine("\u009b31m"), "\\x9b31m");
  EXPECT_EQ(PrintableLine("ab\u202Egnp.exe\u2028c"), "ab\\u202egnp.exe\\u2028c");
  EXPECT_EQ(PrintableLine(std::string("a\0b", 3)), "a\\x00b");
}

TEST(PrintableLine, ReplacesWhatIsNotUtf8) {
  EXPECT_EQ(PrintableLine("a\xff\xfe z"), "a\uFFFD\uFFFD z");
  EXPECT_EQ(PrintableLine("\xc3"), "\uFFFD");                      // cut off
  EXPECT_EQ(PrintableLine("\xc0\x9b"), "\uFFFD\uFFFD");            // ESC in two bytes
  EXPECT_EQ(PrintableLine("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // half a surrogate pair
}

TEST(PrintableLine, CutsLongNamesAndKeepsTheAdviceBehindThem) {
  const std::string line =
      PrintableLine("\"" + std::string(60000, 'n') + "\" is too long; choose another");
  EXPECT_TRUE(line.ends_with("…\" is too long; choose another")) << line;
  EXPECT_LE(LengthOf(line), 120u);
  EXPECT_LE(LengthOf(PrintableLine(std::string(4 << 20, 'x'))), 240u);
  std::string words;
  for (int i = 0; i < 100000; ++i) words += "word ";
  EXPECT_LE(LengthOf(PrintableLine(words)), 1000u);
}

TEST(PrintableLine, IsTheSameTwice) {
  const std::string once = PrintableLine("\x1b\"" + std::string(300, 'q') + "\"\xff");
  EXPECT_EQ(PrintableLine(once), once);
}

TEST(Error, IsPrintableWhateverItsFileIsCalled) {
  const Error error(Code::kBadScene, "key \"a\x1b[2Jb\nc\" is unknown", "x\x1b]0;t\x07\ny.json");
  const std::string what = error.what();
  EXPECT_EQ(what, "x\\x1b]0;t\\x07\\ny.json: key \"a\\x1b[2Jb\\nc\" is unknown");
  EXPECT_EQ(error.file(), std::filesystem::path("x\x1b]0;t\x07\ny.json"));  // can still be opened
  const Error deep(Code::kFile, "no", "/" + std::string(5000, 'd') + "/scene.json");
  EXPECT_TRUE(std::string(deep.what()).ends_with("d/scene.json: no")) << deep.what();
  EXPECT_LE(LengthOf(deep.what()), 250u);
}

TEST(DescribeFault, HasOurWordsForEveryException) {
  namespace fs = std::filesystem;
  EXPECT_EQ(DescribeFault(Error(Code::kFile, "why", "f")), "f: why");
  EXPECT_NE(DescribeFault(std::bad_alloc()).find("memory"), std::string::npos);
  const auto of = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const std::exception& fault) {
      return DescribeFault(fault);
    }
    return "";
  };
  const std::string too_many = of([] { std::vector<int>().reserve(std::size_t(-1)); });
  EXPECT_NE(too_many.find("memory"), std::string::npos) << too_many;
  const std::string too_long = of([] { static_cast<void>(fs::status(std::string(300, 'a'))); });
  EXPECT_NE(too_long.find("name is too long"), std::string::npos) << too_long;
  EXPECT_EQ(too_long.find("filesystem error"), std::string::npos) << too_long;
  const std::string other =
      of([] { throw std::runtime_error("imdecode_(''): Assertion\nfailed"); });
  EXPECT_EQ(other.find("imdecode"), std::string::npos) << other;
  EXPECT_EQ(other.find('\n'), std::string::npos) << other;
}

}  // namespace
}  // namespace arthro
