// No job opens a socket of a network unless it is asked to. A filter of the kernel ends the program
// at socket(2) of any family but that of a display on the same machine, whoever calls it.
#include <cstddef>
#include <fstream>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/scene/files/archive_io.h"
#include "tests/support/run_program.h"
#include "tests/support/small_scene.h"

namespace arthro::test {
namespace {

constexpr int kKilled = 128 + 31;  // SIGSYS

// Filters the calling thread and all that it starts.
bool ForbidNetworkSockets() {
  constexpr std::uint32_t kCall = offsetof(seccomp_data, nr);
  constexpr std::uint32_t kFamily = offsetof(seccomp_data, args);
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kCall),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 0, 2),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kFamily),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_UNIX, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
  };
  const sock_fprog program{std::size(filter), filter};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

ProgramResult RunWithoutNetwork(const std::string& arguments, const std::string& environment) {
  ProgramResult result;
  std::thread([&] {
    if (ForbidNetworkSockets())
      result = RunProgram(arguments, environment);
    else
      result.err = "this kernel takes no filter";
  }).join();
  return result;
}

TEST(Sockets, NoJobOpensOneOfTheNetwork) {
  const TempFolder folder;
  const std::string at = folder.path().string() + "/", home = "HOME=" + at + " DISPLAY=";
  const auto scene = WriteSmallScene(folder / "scene");
  PackScene(scene, folder / "scene.arthro");
  std::ofstream(folder / "trace.csv") << "t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons\n"
                                         "0,scope,0,0,-0.18,1,0,0,0,0\n"
                                         "0.1,scope,0,0,-0.18,1,0,0,0,0\n";
  const std::vector<std::string> jobs = {
      "--version",
      "check " + at + "scene.arthro",
      "view " + at + "scene -o " + at + "v.png",
      "replay " + at + "scene " + at + "trace.csv -o " + at + "f.csv --video " + at + "f.mp4",
      "depth " + at + "scene/panorama.png -o " + at + "d.tiff",
      "tetrahedralize " + at + "scene/octahedron.ply --unit m --elements 50 -o " + at + "t.vtu",
      "centres " + at + "scene --view-angle-deg 30 --insertion-mm 5 -o " + at + "c.csv",
      "panorama " + at + "f.mp4 -o " + at + "p.png",
      "devices",
      "records list"};
  for (const std::string& job : jobs) {
    const ProgramResult result = RunWithoutNetwork(job, home);
    EXPECT_LE(result.exit_code, 1) << job << "\n" << result.err;
    EXPECT_GE(result.exit_code, 0) << job << "\n" << result.err;
  }
}

// The filter works: records on a server are the one thing that needs the network.
TEST(Sockets, OnlyANamedServerIsAskedFor) {
  const TempFolder folder;
  const ProgramResult result =
      RunWithoutNetwork("records list --records postgresql://nobody@192.0.2.1/none",
                        "HOME=" + folder.path().string());
  EXPECT_EQ(result.exit_code, kKilled) << result.err;
}

}  // namespace
}  // namespace arthro::test
