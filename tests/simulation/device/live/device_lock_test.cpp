#include "simulation/device/live/device_lock.h"

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

TEST(DeviceLock, HardCase25OneProgramHoldsADeviceAndIsNamed) {
  test::TempFolder folder;
  {
    const DeviceLock first(folder.path(), "space_mouse-A/../../x");
    EXPECT_FALSE(first.is_held_elsewhere());
    const DeviceLock second(folder.path(), "space_mouse-A/../../x");
    EXPECT_TRUE(second.is_held_elsewhere());
    EXPECT_EQ(second.holder(), getpid());
    const DeviceLock other(folder.path(), "space_mouse-B");
    EXPECT_FALSE(other.is_held_elsewhere());
  }
  const DeviceLock again(folder.path(), "space_mouse-A/../../x");
  EXPECT_FALSE(again.is_held_elsewhere());
}

TEST(DeviceLock, ADeadProgramHoldsNoLock) {
  test::TempFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const DeviceLock lock(folder.path(), "A");
    _exit(lock.is_held_elsewhere() ? 1 : 0);  // without unlocking
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  EXPECT_FALSE(DeviceLock(folder.path(), "A").is_held_elsewhere());
}

TEST(DeviceLock, DoesWithoutALockWhereNoFileCanBeMade) {
  EXPECT_FALSE(DeviceLock("/not/there", "A").is_held_elsewhere());
}

}  // namespace
}  // namespace arthro::simulation
