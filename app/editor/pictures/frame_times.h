// Times of the drawn frames, printed when the window ends: median, p99 and longest per mark of the
// script, and how long the program took to its first picture. s.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace arthro::app {

class FrameTimes {
 public:
  FrameTimes() = default;
  ~FrameTimes();  // prints on the error stream
  FrameTimes(const FrameTimes&) = delete;
  FrameTimes& operator=(const FrameTimes&) = delete;

  void Note(const std::string& mark, double seconds);

 private:
  std::map<std::string, std::vector<double>> seconds_;  // s, one list per mark
};

}  // namespace arthro::app
