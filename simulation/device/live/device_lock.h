// One program at a time has a device: the system itself would let two open the same node. A lock
// file for each serial number, held as long as this lives and let go by the system if the program
// dies.
#pragma once

#include <filesystem>
#include <string>

namespace arthro::simulation {

// Where lock files lie unless somebody says otherwise: the user's runtime folder, or the temporary
// one.
std::filesystem::path DeviceLockFolder();

class DeviceLock {
 public:
  // `device`: family and serial number. Where no file can be made (a read-only system) it goes
  // without.
  DeviceLock(const std::filesystem::path& folder, const std::string& device);
  ~DeviceLock();
  DeviceLock(const DeviceLock&) = delete;
  DeviceLock& operator=(const DeviceLock&) = delete;

  bool is_held_elsewhere() const noexcept { return is_held_elsewhere_; }
  // Number of the process that holds it; 0: not known.
  int holder() const noexcept { return holder_; }

 private:
  int file_ = -1, holder_ = 0;
  bool is_held_elsewhere_ = false;
};

}  // namespace arthro::simulation
