// Unsaved work that is left when the editor is killed, the display goes away, or the window
// manager dies.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "simulation/scene/files/scene_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/own_display.h"
#include "tests/support/run_window.h"
#include "tests/support/small_scene.h"

// Last, because Xlib's macros (None, Bool) break GoogleTest's headers.
// clang-format off
#include <X11/Xlib.h>
#include <X11/Xatom.h>
// clang-format on

namespace arthro {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class EditorEnd : public testing::Test {
 protected:
  void SetUp() override {
    ARTHRO_REQUIRE_XVFB();
    scene = test::WriteSmallScene(temp / "knee");
    server = std::make_unique<test::XServer>(temp / "xvfb.log");
    ASSERT_FALSE(server->name().empty()) << TextOf(temp / "xvfb.log");
  }
  std::unique_ptr<test::Process> Start(const std::string& job, const std::string& script,
                                       const std::vector<std::string>& more = {}) {
    std::ofstream(temp / "script") << script;
    std::vector<std::string> arguments = {ARTHRO_PROGRAM, job, scene.string(), "--script",
                                          (temp / "script").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<test::Process>(
        arguments,
        std::vector<std::string>{"DISPLAY=" + server->name(), "HOME=" + temp.path().string(),
                                 "LIBGL_ALWAYS_SOFTWARE=1", "LP_NUM_THREADS=1"},
        temp / "log");
  }
  std::unique_ptr<test::Process> Edit(const std::string& script) {
    return Start("edit", script, {"--recovery", copies.string()});
  }
  // Copy of the one session; empty: there is none.
  fs::path Copy() const {
    std::error_code ignored;
    for (const auto& session : fs::directory_iterator(copies, ignored))
      if (const fs::path copy = session.path() / "scene/scene.json"; fs::exists(copy)) return copy;
    return {};
  }
  std::string Log() const { return TextOf(temp / "log"); }

  test::TempFolder temp;
  fs::path scene, copies = temp / "state" / "recovery";
  std::unique_ptr<test::XServer> server;
};

constexpr const char* kChangeAndWait = R"(
click Portals
set "Incision spacing" -25
expect value "Incision spacing" "-25.0 mm"
mark changed
wait frames 1000000
)";

TEST_F(EditorEnd, UnsavedWorkOfAKilledEditorIsOfferedAndRestored) {
  {
    const auto editor = Edit(kChangeAndWait);
    ASSERT_TRUE(test::Eventually([&] { return !Copy().empty(); })) << Log();
    editor->Send(SIGKILL);
    editor->Wait(20);
  }
  const fs::path copy = Copy();
  const fs::path session = copy.parent_path().parent_path();
  EXPECT_EQ(fs::status(session).permissions() & fs::perms(0777), fs::perms(0700));
  EXPECT_DOUBLE_EQ(LoadScene(scene).scene.portals.incision_spacing, 0.03) << "not saved";

  const auto next = Edit(R"(
expect "Unsaved work was found"
expect "Small knee"
expect "1 unsaved edit"
expect "Change the incision spacing"
click "Later"
quit
)");
  EXPECT_EQ(next->Wait(60), 0) << Log();
  EXPECT_TRUE(fs::exists(copy)) << "later means later";

  const auto third = Edit(R"(
click "Restore it"
wait frames 5
expect "Restored the unsaved work"
click Portals
expect value "Incision spacing" "-25.0 mm"
expect "• Small knee"
click Save
wait job
expect "Saved in"
wait frames 5
quit
)");
  EXPECT_EQ(third->Wait(60), 0) << Log();
  EXPECT_DOUBLE_EQ(LoadScene(scene).scene.portals.incision_spacing, -0.025);
  EXPECT_TRUE(Copy().empty()) << "saved, so there is nothing to recover";
}

TEST_F(EditorEnd, ACopyOfAnEditorThatStillRunsIsNotOffered) {
  const auto editor = Edit(kChangeAndWait);
  ASSERT_TRUE(test::Eventually([&] { return !Copy().empty(); })) << Log();
  std::ofstream(temp / "other.script") << "expect not \"Unsaved work\"\nquit\n";
  test::Process other({ARTHRO_PROGRAM, "edit", scene.string(), "--recovery", copies.string(),
                       "--script", (temp / "other.script").string()},
                      {"DISPLAY=" + server->name(), "HOME=" + temp.path().string(),
                       "LIBGL_ALWAYS_SOFTWARE=1", "LP_NUM_THREADS=1"},
                      temp / "other.log");
  EXPECT_EQ(other.Wait(600), 0) << TextOf(temp / "other.log");
  EXPECT_FALSE(Copy().empty());
}

TEST_F(EditorEnd, DiscardedChangesLeaveNoCopy) {
  const auto editor = Edit(R"(
click Portals
set "Incision spacing" -25
key ctrl+q
click Discard
)");
  EXPECT_EQ(editor->Wait(60), 0) << Log();
  EXPECT_TRUE(Copy().empty());
}

TEST_F(EditorEnd, ALostDisplayEndsInOneSentenceAndKeepsTheUnsavedWork) {
  const auto editor = Edit("mark begun\n" + std::string(kChangeAndWait));
  // At once: the changes are younger than any copy of them, once the scene has them.
  ASSERT_TRUE(test::Eventually([&] { return !Copy().empty(); })) << Log();
  server->Kill();
  EXPECT_EQ(editor->Wait(60), 1) << Log();
  EXPECT_EQ(Log(),
            "arthroscene: the display was lost; the unsaved work is kept, and is offered at the "
            "next start\n");
  EXPECT_FALSE(Copy().empty());
}

TEST_F(EditorEnd, ASignalKeepsTheUnsavedWork) {
  const auto editor = Edit("click Portals\nset \"Incision spacing\" -25\nwait frames 3\nshot " +
                           (temp / "changed.png").string() + "\nwait frames 1000000\n");
  ASSERT_TRUE(test::Eventually([&] { return fs::exists(temp / "changed.png"); })) << Log();
  editor->Send(SIGTERM);
  EXPECT_EQ(editor->Wait(60), 128 + SIGTERM) << Log();
  EXPECT_FALSE(Copy().empty());
}

TEST_F(EditorEnd, ALostDisplayEndsAPracticeInOneSentence) {
  const auto practice =
      Start("practise", "wait job\nwait frames 5\nshot " + (temp / "runs.png").string() +
                            "\nwait frames 1000000\n");
  ASSERT_TRUE(test::Eventually([&] { return fs::exists(temp / "runs.png"); })) << Log();
  server->Kill();
  EXPECT_EQ(practice->Wait(60), 1) << Log();
  EXPECT_EQ(Log(),
            "arthroscene: the display was lost; start the program again on a display that works\n");
}

// Marks that a killed window manager leaves: the root names a window that is gone, or one that does
// not name itself.
TEST_F(EditorEnd, AMarkOfADeadWindowManagerDoesNotKeepTheWindowFromOpening) {
  Display* display = XOpenDisplay(server->name().c_str());
  ASSERT_NE(display, nullptr);
  const Window root = DefaultRootWindow(display);
  const Atom mark = XInternAtom(display, "_NET_SUPPORTING_WM_CHECK", False);
  const Window alive = XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, 0, 0);
  const Window gone = XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, 0, 0);
  XDestroyWindow(display, gone);
  for (const Window named : {gone, alive, root}) {
    XChangeProperty(display, root, mark, XA_WINDOW, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(&named), 1);
    XSync(display, False);
    EXPECT_EQ(Edit("quit\n")->Wait(60), 0) << Log();
  }
  XCloseDisplay(display);
}

}  // namespace
}  // namespace arthro
