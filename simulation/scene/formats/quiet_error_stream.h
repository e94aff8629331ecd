// Silences std::cerr for its own lifetime: OpenCV prints there what it catches. Nothing here writes
// to it.
#pragma once

#include <iostream>
#include <mutex>

namespace arthro {

class QuietErrorStream {
 public:
  QuietErrorStream() : lock_(Mutex()) { std::cerr.setstate(std::ios::badbit); }
  ~QuietErrorStream() { std::cerr.clear(); }
  QuietErrorStream(const QuietErrorStream&) = delete;
  QuietErrorStream& operator=(const QuietErrorStream&) = delete;

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  const std::lock_guard<std::mutex> lock_;
};

}  // namespace arthro
