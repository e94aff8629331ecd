// A recorded practice that is ended by a signal, or whose X server dies: the next start finds its
// film whole up to the last second.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/support/build_paths.h"
#include "tests/support/film_frames.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

void Sleep(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

// `errors`: file of its standard error; empty: none.
pid_t Start(const std::vector<std::string>& words, const std::vector<std::string>& environment,
            const fs::path& errors) {
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::signal(SIGHUP, SIG_DFL);  // a test under nohup has it ignored, and so would the program
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const int none = ::open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) ::dup2(none, stream);
  if (!errors.empty()) ::dup2(::open(errors.c_str(), O_CREAT | O_WRONLY, 0600), 2);
  for (const std::string& one : environment) ::putenv(const_cast<char*>(one.c_str()));
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

// An X server that a test may kill.
struct Display {
  Display() {
    int ends[2];
    if (::pipe2(ends, 0) != 0) return;
    server = Start({"Xvfb", "-displayfd", std::to_string(ends[1]), "-screen", "0", "1280x1024x24",
                    "-nolisten", "tcp"},
                   {}, {});
    ::close(ends[1]);
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) name += c;
    ::close(ends[0]);
  }
  ~Display() {
    ::kill(server, SIGKILL);
    ::waitpid(server, nullptr, 0);
  }
  pid_t server = -1;
  std::string name;
};

std::vector<fs::path> FilmsIn(const fs::path& folder) {
  std::vector<fs::path> films;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".mkv") films.push_back(entry.path());
  return films;
}

class FilmEndsWindow : public testing::TestWithParam<int> {
 protected:
  static constexpr int kDisplay = -1;  // instead of a signal: the X server dies
};

TEST_P(FilmEndsWindow, TheFilmIsThereAfterTheNextStart) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder temp;
  const fs::path scene = test::WriteSmallScene(temp / "knee");
  const Display display;
  ASSERT_FALSE(display.name.empty());
  const fs::path film = temp / "film.mkv";
  const std::string home = "HOME=" + temp.path().string();
  const pid_t practice =
      Start({ARTHRO_PROGRAM, "practise", scene.string(), "--record", film.string()},
            {home, "DISPLAY=:" + display.name, "LIBGL_ALWAYS_SOFTWARE=1", "LP_NUM_THREADS=1",
             "XDG_STATE_HOME=" + (temp / "state").string()},
            temp / "errors.txt");
  int status = 0;
  // Two minutes to begin, on a busy machine; then until it has recorded for two seconds, which is
  // some 20 kB.
  for (int i = 0; i < 2400; ++i) {
    const auto films = FilmsIn(temp.path());
    if (!films.empty() && fs::file_size(films[0]) > 20'000) break;
    ASSERT_EQ(::waitpid(practice, &status, WNOHANG), 0)
        << "it ended with " << status << ": " << ReadWholeFile(temp / "errors.txt");
    Sleep(50);
  }
  ASSERT_EQ(FilmsIn(temp.path()).size(), 1u) << "it is recorded";
  Sleep(700);
  const bool is_display = GetParam() == kDisplay;
  ::kill(is_display ? display.server : practice, is_display ? SIGKILL : GetParam());
  // A program that ignores it goes on, and is killed.
  if (GetParam() == SIGPIPE || GetParam() == SIGXFSZ) {
    Sleep(1000);
    ::kill(practice, SIGKILL);
  }
  ASSERT_EQ(::waitpid(practice, &status, 0), practice);

  // The next start: it need not even find a display, nor record in that folder.
  const auto next = test::RunProgram(
      "practise " + scene.string(),
      "env -u DISPLAY -u WAYLAND_DISPLAY XDG_STATE_HOME=" + (temp / "state").string());
  EXPECT_EQ(FilmsIn(temp.path()), std::vector<fs::path>{film}) << next.err;
  if (GetParam() != SIGTERM && GetParam() != SIGQUIT && !is_display) {
    EXPECT_NE(next.err.find("arthroscene: " + film.string() + ": the program ended while"),
              std::string::npos)
        << next.err;
  }
  const auto frames = test::ReadFilm(film).frames;
  EXPECT_GE(frames.size(), 15u);
  for (const cv::Mat& rgb : frames) EXPECT_GT(cv::mean(rgb)[0], 5.0) << "a picture, not black";
}

// A server whose last client leaves starts anew and refuses connections meanwhile, so the program
// must never close its only one before it has another.
TEST(OnlyClient, OpensItsWindowOnAServerWithoutOtherClients) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder temp;
  for (int i = 0; i < 5; ++i) {
    const Display display;
    ASSERT_FALSE(display.name.empty());
    const auto run = test::RunProgram("edit --frames 1",
                                      "HOME=" + temp.path().string() + " DISPLAY=:" + display.name +
                                          " LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=1");
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Ends, FilmEndsWindow,
                         testing::Values(SIGKILL, SIGSEGV, SIGABRT, SIGQUIT, SIGPIPE, SIGXFSZ,
                                         SIGTERM, -1),
                         [](const auto& one) {
                           return one.param < 0 ? std::string("XServer")
                                                : std::string("SIG") + sigabbrev_np(one.param);
                         });

}  // namespace
}  // namespace arthro
