// Lock that lets one program at a time use a device, since the system lets two open the same node.
// Holds a lock file per serial number while this lives; the system releases it if the program dies.
#pragma once

#include <filesystem>
#include <string>

namespace arthro::simulation {

// Default folder of lock files: the runtime folder of the user, or the temporary folder.
std::filesystem::path DeviceLockFolder();

class DeviceLock {
 public:
  // `device` is family and serial number. Does without a lock where no file can be made (a
  // read-only system).
  DeviceLock(const std::filesystem::path& folder, const std::string& device);
  ~DeviceLock();
  DeviceLock(const DeviceLock&) = delete;
  DeviceLock& operator=(const DeviceLock&) = delete;

  bool is_held_elsewhere() const noexcept { return is_held_elsewhere_; }
  // Number of the process that holds it; 0: unknown.
  int holder() const noexcept { return holder_; }

 private:
  int file_ = -1, holder_ = 0;
  bool is_held_elsewhere_ = false;
};

}  // namespace arthro::simulation
