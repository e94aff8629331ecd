// Runs every fuzz target over its corpus and over mutations of it, always the same ones: inputs
// that were once findings stay mended, and a reader that breaks on a common damage is seen without
// a fuzzer.
#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/hostile/mutation.h"
#include "tests/support/build_paths.h"

#define FUZZ_TARGET(name, format) \
  extern "C" int Fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzz_targets.inc"
#undef FUZZ_TARGET

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

constexpr int kMutations = 300;  // per target; a second or less

struct FuzzTarget {
  const char* name;
  FileFormat format;
  int (*run)(const std::uint8_t* data, std::size_t size);
};

constexpr FuzzTarget kTargets[] = {
#define FUZZ_TARGET(name, format) {#name, FileFormat::format, Fuzz_##name},
#include "fuzz_targets.inc"
#undef FUZZ_TARGET
};

// Input that runs, for the words at a crash.
char running[512];

extern "C" void SayInput(int signal) {
  const auto ignored = ::write(STDERR_FILENO, running, std::strlen(running));
  static_cast<void>(ignored);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

class FuzzCorpus : public testing::TestWithParam<FuzzTarget> {
 protected:
  void SetUp() override {
    for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL})
      std::signal(signal, SayInput);
  }

  static void Run(const std::string& bytes, const std::string& what) {
    std::strncpy(running, ("at the input: " + what + "\n").c_str(), sizeof running - 1);
    try {
      // A copy of the exact size, so that a sanitizer sees a read behind its end.
      const std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
      GetParam().run(copy.data(), copy.size());
    } catch (const std::exception& fault) {
      ADD_FAILURE() << what << ": " << fault.what();
    }
  }
};

TEST_P(FuzzCorpus, EveryInputIsReadOrRefusedInOneSentence) {
  const fs::path folder = fs::path(ARTHRO_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam().name;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  ASSERT_FALSE(files.empty()) << "a target needs a seed";
  std::vector<std::string> inputs;
  for (const fs::path& file : files) {
    inputs.push_back(ReadWholeFile(file));
    Run(inputs.back(), file.filename());
  }
  for (int i = 0; i < kMutations; ++i) {
    const std::size_t which = static_cast<std::size_t>(i) % inputs.size();
    const Mutation mutation =
        Mutate(inputs[which], GetParam().format, static_cast<std::uint64_t>(i));
    Run(mutation.bytes, files[which].filename().string() + ", mutation " + std::to_string(i) +
                            " (" + mutation.what.substr(0, 300) + ")");
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, FuzzCorpus, testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

// The tree is cloned often; a large input belongs into code.
TEST(FuzzCorpora, AreSmall) {
  std::uintmax_t bytes = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(ARTHRO_SOURCE_DIR) / "tests/fuzz/corpus")) {
    if (!entry.is_regular_file()) continue;
    EXPECT_LT(entry.file_size(), 4096u) << entry.path();
    bytes += entry.file_size();
  }
  EXPECT_LT(bytes, 300'000u);
}

}  // namespace
}  // namespace arthro::test
