// Files that are not regular are refused wherever a job reads one: a pipe would be waited for for
// ever, and a device fills the memory.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/lens_io.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

// Every job with {0} as each of its inputs, and {1} as a folder for what it writes. A scene, its
// picture, a trace and a lens lie in {1} as well.
constexpr std::array kReaders = {
    "depth {0} -o {1}/d.tiff",
    "depth {1}/panorama.png --options {0} -o {1}/d.tiff",
    "lens {0} --spacing-mm 1 -o {1}/l.json",
    "panorama {0} -o {1}/p.png",
    "panorama {1}/panorama.png --lens {0} -o {1}/p.png",
    "panorama {1}/panorama.png --options {0} -o {1}/p.png",
    "rectify {0} --lens {1}/lens.json -o {1}/frames",
    "rectify {1}/panorama.png --lens {0} -o {1}/frames",
    "tetrahedralize {0} --unit mm -o {1}/t.vtu",
    "pivot {0} -o {1}/pivot.json",
    "pivot {0} --swing scope -o {1}/pivot.json",
    "centres {0} -o {1}/c.csv",
    "check {0}",
    "view {0} -o {1}/v.png",
    "replay {0} {1}/trace.csv -o {1}/f.csv",
    "replay {1} {0} -o {1}/f.csv",
    "solve {0} -o {1}/r.json",
    "practise {1} --hands {0}",
    "practise {1} --rig {0}",
    "run {0}",
};
// These look for a display first.
constexpr std::array kWindowJobs = {
    "practise {0} --frames 3",
    "edit {0} --frames 3",
    "edit --script {0} --frames 3",
};

class IrregularInput : public testing::Test {
 protected:
  void SetUp() override {
    WriteColourImage(At("panorama.png"), ColourImage(64, 48));
    WriteDepthMap(At("depth.tiff"), DepthMap(64, 48, 0.01f));
    WriteScene("panorama.png", "depth.tiff");
    Lens lens;
    lens.width = 64, lens.height = 48;
    lens.focal_px = 40, lens.cx = 32, lens.cy = 24;
    lens.field_of_view = 1.5;
    WriteLens(At("lens.json"), lens);
    WriteAtomically(At("trace.csv"),
                    "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                    "0,scope,0,0,-0.17,1,0,0,0,0\n");
  }

  void WriteScene(const std::string& panorama, const std::string& depth) {
    WriteAtomically(At("scene.json"), fmt::format(R"({{"schema": "arthroscene.scene/1",
      "title": "t", "backdrop": {{"panorama": "{}", "depth": "{}", "radius": 0.05,
      "projection": {{"type": "gnomonic", "centre_px": [32, 24], "focal_px": 40}}}}}})",
                                                  panorama, depth));
  }

  std::string At(const std::string& name) const { return (folder_ / name).string(); }
  std::string Folder() const { return folder_.path().string(); }

  // Exit 1 and one line that holds `kind`; `check` lists what it found in a line before.
  void ExpectRefused(const std::string& arguments, const std::string& kind,
                     const std::string& environment = "DISPLAY= WAYLAND_DISPLAY=") const {
    const auto result = test::RunProgram(arguments, environment + " timeout 100");
    EXPECT_EQ(result.exit_code, 1) << arguments << "\n" << result.err;
    EXPECT_NE(result.err.find(kind), std::string::npos) << arguments << "\n" << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'),
              arguments.starts_with("check") ? 2 : 1)
        << result.err;
  }

  void ExpectRefusedByWindows(const std::string& input, const std::string& kind) const {
    if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "SKIPPED: no display for edit, practise";
    for (const char* job : kWindowJobs)
      ExpectRefused(fmt::format(fmt::runtime(job), input, Folder()), kind, "");
  }

  const test::TempFolder folder_;
};

TEST_F(IrregularInput, APipeIsRefusedByEveryJob) {
  ASSERT_EQ(::mkfifo(At("pipe").c_str(), 0600), 0);
  for (const char* job : kReaders)
    ExpectRefused(fmt::format(fmt::runtime(job), At("pipe"), Folder()), "this is a pipe");
}

TEST_F(IrregularInput, ADeviceWithoutEndIsRefusedByEveryJobThroughALinkToo) {
  fs::create_symlink("/dev/zero", At("zero"));
  for (const char* job : kReaders)
    ExpectRefused(fmt::format(fmt::runtime(job), At("zero"), Folder()), "this is a device");
}

TEST_F(IrregularInput, APipeOrADeviceIsRefusedByEditAndPractise) {
  ASSERT_EQ(::mkfifo(At("pipe").c_str(), 0600), 0);
  ExpectRefusedByWindows(At("pipe"), "this is a pipe");
  ExpectRefusedByWindows("/dev/zero", "this is a device");
}

TEST_F(IrregularInput, ASceneThatNamesAPipeIsRefused) {
  ASSERT_EQ(::mkfifo(At("pipe.png").c_str(), 0600), 0);
  WriteScene("pipe.png", "depth.tiff");
  ExpectRefused("check " + Folder(), "pipe.png");
  ExpectRefused("view " + Folder() + " -o " + At("v.png"), "pipe.png");
  ExpectRefused("centres " + Folder() + " -o - --picture " + At("c.png"), "a pipe");
  fs::create_symlink("/dev/zero", At("zero.tiff"));
  WriteScene("panorama.png", "zero.tiff");
  ExpectRefused("view " + Folder() + " -o " + At("v.png"), "zero.tiff");
}

TEST_F(IrregularInput, ACaseThatNamesADeviceAsItsMeshIsRefused) {
  WriteAtomically(At("case.json"),
                  R"({"mesh": "/dev/zero", "order": 1, "material": {"model": "corotated",
      "young_modulus": 1000, "poisson_ratio": 0.4, "density": 1000}, "mode": "static"})");
  ExpectRefused("solve " + At("case.json") + " -o " + At("r.json"), "a device");
}

TEST_F(IrregularInput, ASocketIsRefused) {
  const int descriptor = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_GE(descriptor, 0);
  ::sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = At("socket");
  ASSERT_LT(name.size(), sizeof address.sun_path);
  name.copy(address.sun_path, name.size());
  ASSERT_EQ(::bind(descriptor, reinterpret_cast<::sockaddr*>(&address), sizeof address), 0);
  ExpectRefused("depth " + name + " -o " + At("d.tiff"), "a socket");
  ::close(descriptor);
}

TEST_F(IrregularInput, ASparseFileOfManyGigabytesIsRefusedAtOnce) {
  std::ofstream(At("large.json")).close();
  std::error_code fault;
  fs::resize_file(At("large.json"), std::uintmax_t{8} << 30, fault);
  if (fault) GTEST_SKIP() << "SKIPPED: no sparse file of 8 GB can be made here";
  ExpectRefused("depth " + At("large.json") + " -o " + At("d.tiff"), "larger than 2048 MB");
  ExpectRefused("solve " + At("large.json") + " -o " + At("r.json"), "larger than 64 MB");
}

TEST_F(IrregularInput, AListOfOtherVideosIsNoVideo) {
  WriteAtomically(At("list.mp4"),
                  "#EXTM3U\n#EXT-X-TARGETDURATION:9\n#EXTINF:9,\nother.mp4\n#EXT-X-ENDLIST\n");
  ExpectRefused("panorama " + At("list.mp4") + " -o " + At("p.png"), "names other files");
}

}  // namespace
}  // namespace arthro
