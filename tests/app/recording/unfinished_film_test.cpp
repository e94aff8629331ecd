// Films of programs that died while they recorded.
#include "app/recording/unfinished_film.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <fstream>
#include <random>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "app/recording/live_film.h"
#include "app/recording/picture_sequence.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/film_frames.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr VideoSize kFilmSize = {160, 120};
constexpr double kFilmRate = 30.0;
constexpr int kPerSecond = 30;

// The knee with a bar that moves on.
ColourImage FilmFrame(int index) {
  static const ColourImage knee = test::KneePicture(kFilmSize.width, kFilmSize.height);
  ColourImage picture = knee;
  const int bar = index % 26;
  for (int y = 20; y < 100; ++y)
    for (int x = 6 * bar; x < 6 * bar + 6; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 240;
  return picture;
}

// Pictures that the child has given, where its parent sees them.
class SharedCount {
 public:
  SharedCount()
      : count_(static_cast<std::atomic<int>*>(
            ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {
    *count_ = 0;
  }
  ~SharedCount() { ::munmap(count_, 4096); }
  std::atomic<int>& operator*() { return *count_; }

 private:
  std::atomic<int>* count_;
};

// Begins a film in a process of its own, ends the process by `signal` after `pictures` and some
// microseconds, and returns how many pictures it had given.
int DieWhileRecording(const fs::path& file, int signal, int pictures, int microseconds) {
  SharedCount given;
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    for (const int own : {SIGSEGV, SIGQUIT, SIGPIPE, SIGXFSZ, SIGABRT, SIGTERM})
      std::signal(own, SIG_DFL);
    try {
      VideoFile film(file, kFilmSize, kFilmRate);
      for (int i = 0;; ++i) {
        film.Add(FilmFrame(i));
        *given = i + 1;
      }
    } catch (...) {
    }
    ::_exit(1);
  }
  int status = 0;
  while (*given < pictures && ::waitpid(child, &status, WNOHANG) == 0)
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
  ::kill(child, signal);
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
  return *given;
}

std::vector<fs::path> FilesOf(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

// 33 dB tells one picture from the next (video_file_test.cpp). The last `torn` pictures may be cut
// off.
void ExpectBeginsWithFrames(const fs::path& file, int at_least, std::size_t torn = 0) {
  const auto [info, frames] = test::ReadFilm(file);
  EXPECT_NEAR(info.frames_per_second, kFilmRate, 1e-3);
  EXPECT_GE(static_cast<int>(frames.size()), at_least) << file;
  for (std::size_t i = 0; i + torn < frames.size(); ++i)
    EXPECT_GT(test::LumaPsnr(frames[i], FilmFrame(static_cast<int>(i))), 33.0) << file << " " << i;
}

class UnfinishedFilms : public testing::TestWithParam<const char*> {};

TEST_P(UnfinishedFilms, AreWholeToTheLastSecondWhateverEndedTheProgram) {
  std::mt19937 random(7);
  for (const int signal : {SIGKILL, SIGSEGV, SIGQUIT, SIGPIPE, SIGXFSZ, SIGABRT, SIGTERM}) {
    const test::TempFolder folder;
    const auto file = folder / (std::string("a film.of me") + GetParam());
    const int given = DieWhileRecording(file, signal, kPerSecond + static_cast<int>(random() % 40),
                                        static_cast<int>(random() % 5000));
    const std::vector<fs::path> left = FilesOf(folder.path());
    ASSERT_EQ(left.size(), 1u) << signal;
    EXPECT_NE(left[0].filename().string().find(".recording."), std::string::npos) << left[0];
    // The file stays as it is, for whoever finds it first. A kill may cut a write between two
    // pages, and a decoder draws what it has of that picture; the finished film is without it.
    ExpectBeginsWithFrames(left[0], given - kPerSecond, 1);

    const std::vector<std::string> said = FinishFilmsIn(folder.path());
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find(file.string() + ": the program ended while"), std::string::npos)
        << said[0];
    EXPECT_EQ(FilesOf(folder.path()), std::vector<fs::path>{file});
    EXPECT_EQ(static_cast<int>(fs::status(file).permissions()), 0600);
    EXPECT_GE(test::ReadFilm(file).info.frames, given - kPerSecond);
    ExpectBeginsWithFrames(file, given - kPerSecond);
    EXPECT_TRUE(FinishFilmsIn(folder.path()).empty()) << "once";
  }
}

TEST_P(UnfinishedFilms, OfADeadProgramAreFinishedUnderAFreeName) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  std::ofstream(file) << "an older film";
  for (int i = 0; i < 2; ++i) {
    DieWhileRecording(file, SIGKILL, kPerSecond, 0);
    FinishFilmsIn(folder.path());
  }
  EXPECT_EQ(ReadWholeFile(file), "an older film");
  for (const char* name : {"film-recovered", "film-recovered-2"})
    ExpectBeginsWithFrames(folder / (std::string(name) + GetParam()), kPerSecond / 2);
  EXPECT_EQ(FilesOf(folder.path()).size(), 3u);
}

// A torn end of any length, as a machine that loses its power may leave.
TEST_P(UnfinishedFilms, CutAnywhereKeepTheirWholePictures) {
  const test::TempFolder folder;
  const auto file = folder / (std::string("film") + GetParam());
  DieWhileRecording(file, SIGKILL, kPerSecond, 0);
  const std::string whole = ReadWholeFile(FilesOf(folder.path())[0]);
  const auto left = folder / (std::string(".film.999999999.recording") + GetParam());
  fs::remove(FilesOf(folder.path())[0]);
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    std::ofstream(left, std::ios::binary) << whole.substr(0, random() % whole.size());
    const std::vector<std::string> said = FinishFilmsIn(folder.path());
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].find('\n'), std::string::npos) << said[0];
    if (!fs::exists(file)) {
      EXPECT_NE(said[0].find("had a picture"), std::string::npos) << said[0];
      continue;
    }
    ExpectBeginsWithFrames(file, 1);
    fs::remove(file);
  }
  EXPECT_TRUE(FilesOf(folder.path()).empty());
}

INSTANTIATE_TEST_SUITE_P(Endings, UnfinishedFilms, testing::Values(".mp4", ".mkv", ".avi"),
                         [](const auto& one) { return std::string(one.param + 1); });

TEST(UnfinishedFilm, OneThatIsRecordedIsLeftAlone) {
  const test::TempFolder folder;
  VideoFile film(folder / "film.mp4", kFilmSize, kFilmRate);
  for (int i = 0; i < kPerSecond; ++i) film.Add(FilmFrame(i));
  EXPECT_TRUE(FinishFilmsIn(folder.path()).empty());
  EXPECT_THROW(VideoFile(folder / "film.mp4", kFilmSize, kFilmRate), Error)
      << "recorded there already";
  film.Finish();
  EXPECT_EQ(FilesOf(folder.path()), std::vector<fs::path>{folder / "film.mp4"});
}

// --overwrite does not mean a film that was saved a moment ago.
TEST(UnfinishedFilm, OneThatIsAboutToBeRecordedAgainDoesNotTakeItsName) {
  const test::TempFolder folder;
  DieWhileRecording(folder / "film.mkv", SIGKILL, kPerSecond, 0);
  EXPECT_EQ(FinishFilmsIn(folder.path(), folder / "." / "film.mkv").size(), 1u);
  EXPECT_EQ(FilesOf(folder.path()), std::vector<fs::path>{folder / "film-recovered.mkv"});
}

TEST(UnfinishedFilm, FilesOfOthersAreLeftAlone) {
  const test::TempFolder folder;
  for (const char* name :
       {".film.12.partial.mp4", "film.12.recording.mp4", ".film.recording.mp4",
        ".film.12x.recording.mp4", ".film.12.recording.png", ".12.recording.mp4"})
    std::ofstream(folder / name) << "mine";
  // A file of that name that is something else is not removed.
  std::ofstream(folder / "large") << std::string(200'000, 'x');
  fs::create_symlink(folder / "large", folder / ".link.999999999.recording.mp4");
  ASSERT_EQ(::mkfifo((folder / ".pipe.999999999.recording.mp4").c_str(), 0600), 0);
  fs::create_directory(folder / ".folder.999999999.recording.mp4");
  const auto before = FilesOf(folder.path());
  EXPECT_TRUE(FinishFilmsIn(folder.path()).empty());
  EXPECT_EQ(FilesOf(folder.path()), before);
  fs::copy(folder / "large", folder / ".large.999999999.recording.mp4");
  const auto said = FinishFilmsIn(folder.path());
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("cannot be read as a film"), std::string::npos);
  EXPECT_EQ(FilesOf(folder.path()).size(), before.size() + 1);
  EXPECT_TRUE(FinishFilmsIn(folder / "no such folder").empty());
}

TEST(UnfinishedFilm, FoldersAreRememberedWhileSomethingIsRecordedThere) {
  const test::TempFolder folder, home, state;
  ASSERT_EQ(::setenv("XDG_STATE_HOME", state.path().c_str(), 1), 0);
  EXPECT_TRUE(FinishFilmsEverywhere().empty());
  {
    VideoFile film(folder / "film.mp4", kFilmSize, kFilmRate);
    NoteRecordingFolder(folder.path());
    NoteRecordingFolder(home.path());
    EXPECT_TRUE(FinishFilmsEverywhere().empty());
    EXPECT_EQ(ReadWholeFile(state / "arthroscene" / "recordings"),
              fs::canonical(folder.path()).string() + "\n");
  }
  DieWhileRecording(folder / "film.mkv", SIGKILL, kPerSecond, 0);
  const auto said = FinishFilmsEverywhere();
  ASSERT_EQ(said.size(), 1u);
  ExpectBeginsWithFrames(folder / "film.mkv", kPerSecond / 2);
  EXPECT_EQ(ReadWholeFile(state / "arthroscene" / "recordings"), "");
  ::unsetenv("XDG_STATE_HOME");
}

// A practice that dies leaves whole pictures, the mark, and nobody else may read them.
TEST(UnfinishedFilm, NumberedPicturesArePrivateToo) {
  const test::TempFolder folder;
  PictureSequence sequence(*PictureNamesOf((folder / "new/").string()));
  sequence.Add(FilmFrame(0));
  for (const fs::path& file : FilesOf(folder / "new"))
    EXPECT_EQ(static_cast<int>(fs::status(file).permissions()), 0600) << file;
}

}  // namespace
}  // namespace arthro::app
