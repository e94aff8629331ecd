#include "simulation/core/input_file.h"

#include <filesystem>
#include <functional>
#include <string>
#include <sys/resource.h>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

std::string SentenceOf(const std::function<void()>& read) {
  try {
    read();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kFile);
    return error.sentence();
  }
  return "";
}

std::string Refusal(const fs::path& file) {
  const std::string beginning = SentenceOf([&] { ReadBeginning(file, 4); });
  EXPECT_EQ(beginning, SentenceOf([&] { RequireRegularFile(file); }));
  EXPECT_EQ(beginning, SentenceOf([&] { ReadWholeFile(file); }));
  return beginning;
}

TEST(InputFile, IsReadToItsLastByteThroughLinksToo) {
  const test::TempFolder folder;
  std::string bytes(3'000'000, 'x');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31 + i / 7919);
  WriteAtomically(folder / "a", bytes);
  fs::create_symlink("a", folder / "link");
  EXPECT_EQ(ReadWholeFile(folder / "a"), bytes);
  EXPECT_EQ(ReadWholeFile(folder / "link"), bytes);
  EXPECT_EQ(ReadBeginning(folder / "a", 5), bytes.substr(0, 5));
  EXPECT_EQ(ReadBeginning(folder / "a", 1u << 30), bytes);
  WriteAtomically(folder / "empty", "");
  EXPECT_EQ(ReadWholeFile(folder / "empty"), "");
  EXPECT_FALSE(ReadWholeFile("/proc/self/status").empty()) << "a file whose size is told as 0";
}

TEST(InputFile, ThatIsNoRegularFileIsRefusedByWhatItIs) {
  const test::TempFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", folder / "link");
  fs::create_symlink("loop", folder / "loop");
  fs::create_symlink("/dev/zero", folder / "zero");
  EXPECT_NE(Refusal(folder / "pipe").find("a pipe"), std::string::npos);
  EXPECT_NE(Refusal(folder / "link").find("a pipe"), std::string::npos);
  EXPECT_NE(Refusal(folder / "zero").find("a device"), std::string::npos);
  EXPECT_NE(Refusal("/dev/urandom").find("a device"), std::string::npos);
  EXPECT_NE(Refusal(folder.path()).find("a folder"), std::string::npos);
  EXPECT_NE(Refusal(folder / "none").find("could not be opened"), std::string::npos);
  EXPECT_NE(Refusal(folder / "loop").find("could not be opened"), std::string::npos);
}

TEST(InputFile, OverItsKindsSizeIsRefused) {
  const test::TempFolder folder;
  WriteAtomically(folder / "a", "12345");
  EXPECT_EQ(ReadWholeFile(folder / "a", 5), "12345");
  EXPECT_NE(SentenceOf([&] { ReadWholeFile(folder / "a", 4); }).find("larger than"),
            std::string::npos);
  // One that the kernel makes up says that it has no bytes.
  EXPECT_NE(SentenceOf([] { ReadWholeFile("/proc/self/status", 4); }).find("larger than"),
            std::string::npos);
}

// A limit of the address space stands in for a machine without memory.
TEST(InputFile, ThatMemoryDoesNotHoldIsAnErrorAndNeverCutOff) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "SKIPPED: a sanitizer reserves terabytes of addresses";
#endif
  const test::TempFolder folder;
  WriteAtomically(folder / "a", "");
  std::error_code fault;
  fs::resize_file(folder / "a", std::uintmax_t{1} << 30, fault);
  if (fault) GTEST_SKIP() << "SKIPPED: no sparse file of 1 GB can be made here";
  ::rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  ::rlimit limit = before;
  limit.rlim_cur = std::uintmax_t{512} << 20;
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
  const std::string sentence = SentenceOf([&] { ReadWholeFile(folder / "a"); });
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_NE(sentence.find("not enough memory"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace arthro
