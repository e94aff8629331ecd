#include "tests/hostile/complaints.h"

#include <array>
#include <regex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace arthro::test {
namespace {

constexpr std::size_t kLongestLine = 1200;  // bytes; a sentence and the paths in it

// Words of libraries, of the C++ runtime and of its exceptions.
constexpr std::array<const char*, 35> kForeign = {"libpng",
                                                  "imdecode",
                                                  "OpenCV",
                                                  "cv::",
                                                  "FFmpeg",
                                                  "ffmpeg",
                                                  "libav",
                                                  "[mov,",
                                                  "[matroska",
                                                  "[avi @",
                                                  "[h264",
                                                  "[mjpeg",
                                                  "[swscaler",
                                                  "std::",
                                                  "filesystem error",
                                                  "ssertion",
                                                  "_M_",
                                                  "basic_string",
                                                  "bad_alloc",
                                                  "terminate called",
                                                  "what():",
                                                  "nlohmann",
                                                  "json.exception",
                                                  "libjpeg",
                                                  "Corrupt JPEG",
                                                  "Premature end",
                                                  "TIFFRead",
                                                  "TIFFFetch",
                                                  "libtiff",
                                                  "ERROR: In ",
                                                  "Generic Warning",
                                                  "Unexpected element",
                                                  "CHOLMOD",
                                                  "GStreamer",
                                                  "stod"};

bool IsValidUtf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int more = lead < 0x80       ? 0
                     : lead >> 5 == 6  ? 1
                     : lead >> 4 == 14 ? 2
                     : lead >> 3 == 30 ? 3
                                       : -1;
    if (more < 0 || i + static_cast<std::size_t>(more) >= text.size()) return false;
    for (int k = 1; k <= more; ++k)
      if ((static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0xc0) != 0x80)
        return false;
    i += static_cast<std::size_t>(more) + 1;
  }
  return true;
}

bool HasControl(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte < 0x20 && byte != '\n') || byte == 0x7f) return true;
    // U+0080 to U+009F
    if (byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0)
      return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> MessageComplaints(const std::string& err, bool is_refusal) {
  std::vector<std::string> found;
  for (const char* word : kForeign)
    if (err.find(word) != std::string::npos)
      found.push_back(fmt::format("a library's word on stderr: {}", word));
  static const std::regex vtk_class("vtk[A-Z][A-Za-z]+ ?\\(");
  if (std::regex_search(err.substr(0, 4000), vtk_class)) found.push_back("VTK's words on stderr");
  if (HasControl(err)) found.push_back("control characters on stderr");
  if (!IsValidUtf8(err)) found.push_back("stderr is not UTF-8");
  int sentences = 0, errors = 0;
  for (std::size_t at = 0; at < err.size();) {
    const std::size_t end = std::min(err.find('\n', at), err.size());
    const std::string line = err.substr(at, end - at);
    if (line.size() > kLongestLine)
      found.push_back(fmt::format("a line of {} bytes on stderr", line.size()));
    if (line.starts_with("arthroscene: "))
      ++sentences;
    else if (line.starts_with("error: "))
      ++errors;
    else if (!line.starts_with("warning: ") && !line.starts_with("note: "))
      found.push_back("a line on stderr without a prefix");
    at = end + 1;
  }
  if (sentences > 1) found.push_back("more than one sentence on stderr");
  if (is_refusal && sentences + errors == 0) found.push_back("refused without a sentence");
  return found;
}

std::vector<std::string> RunComplaints(const ChildRun& run, const RunLimits& limits) {
  std::vector<std::string> found;
  if (run.was_too_long)
    found.push_back(
        fmt::format("hangs: {:.1f} s of processor time in {:.0f} s", run.cpu_s, run.wall_s));
  else if (run.exit_code < 0)
    found.push_back(fmt::format("ended by signal {}", run.signal));
  else if (run.exit_code > 1)
    found.push_back(fmt::format("exit code {}", run.exit_code));
  if (run.cpu_s > limits.cpu_s)
    found.push_back(fmt::format("{:.1f} s of processor time", run.cpu_s));
  if (run.peak_mb > limits.peak_mb) found.push_back(fmt::format("{:.0f} MB", run.peak_mb));
  const auto said = MessageComplaints(run.err, run.exit_code == 1);
  found.insert(found.end(), said.begin(), said.end());
  if (HasControl(run.out.substr(0, 100000))) found.push_back("control characters on stdout");
  return found;
}

std::string NotWhole(const std::string& name, const std::string& bytes) {
  if (bytes.empty()) return "is empty";
  if (name.ends_with(".json") && nlohmann::json::parse(bytes, nullptr, false).is_discarded())
    return "is no JSON";
  if (name.ends_with(".csv") && !bytes.ends_with("\n")) return "has no end of line at its end";
  if (name.ends_with(".png") && bytes.find("IEND") + 8 != bytes.size()) return "has no IEND";
  if (name.ends_with(".vtu") && !bytes.ends_with("</VTKFile>\n") && !bytes.ends_with("</VTKFile>"))
    return "has no </VTKFile>";
  return "";
}

}  // namespace arthro::test
