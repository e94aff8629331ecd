#include "authoring/footage/video_container.h"

#include <algorithm>
#include <array>
#include <string>

#include "simulation/core/error.h"
#include "simulation/core/input_file.h"

namespace arthro::authoring {
namespace {

using namespace std::string_view_literals;

// Signature of a format: these bytes at this offset.
struct Mark {
  std::size_t at;
  std::string_view bytes;
};

constexpr std::array kMarks = {
    Mark{4, "ftyp"sv},              // MP4, QuickTime, 3GP
    Mark{4, "moov"sv},              // QuickTime without a file type
    Mark{4, "mdat"sv},              // the same, media first
    Mark{4, "free"sv},              //
    Mark{4, "skip"sv},              //
    Mark{4, "wide"sv},              //
    Mark{4, "pnot"sv},              //
    Mark{0, "\x1a\x45\xdf\xa3"sv},  // Matroska, WebM
    Mark{8, "AVI "sv},              // RIFF
    Mark{8, "AVIX"sv},              //
    Mark{0, "OggS"sv},              // Ogg
    Mark{0, "FLV\x01"sv},           // Flash
    Mark{0, "\x30\x26\xb2\x75"sv},  // ASF, WMV
    Mark{0, "\0\0\x01"sv},          // MPEG program and elementary streams, H.264, H.265
    Mark{0, "\0\0\0\x01"sv},        // H.264 and H.265 with the longer start code
    Mark{0, "\x06\x0e\x2b\x34"sv},  // MXF
    Mark{0, "DKIF"sv},              // IVF
    Mark{0, "\x1f\x07\0"sv},        // DV
    Mark{0, "\xff\xd8\xff"sv},      // Motion JPEG as bare pictures
    Mark{0, "YUV4MPEG2 "sv},        // uncompressed
    Mark{0, "GIF8"sv},              // animation
};

// Packets of an MPEG transport stream begin with this byte; in a recorder's stream (M2TS) a time
// stamp precedes it.
bool IsTransportStream(std::string_view bytes) {
  constexpr char kSync = 0x47;
  constexpr std::size_t kPackets = 4;
  struct Layout {
    std::size_t first, length;
  };
  for (const auto& [first, length] : {Layout{0, 188}, Layout{4, 192}, Layout{0, 204}}) {
    bool is_regular = bytes.size() > first + (kPackets - 1) * length;
    for (std::size_t i = 0; i < kPackets && is_regular; ++i)
      is_regular = bytes[first + i * length] == kSync;
    if (is_regular) return true;
  }
  return false;
}

bool IsPlaylist(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf"sv)) bytes.remove_prefix(3);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"sv), bytes.size()));
  return bytes.starts_with("#EXTM3U"sv) || bytes.starts_with("ffconcat"sv) ||
         bytes.starts_with("v=0"sv) || bytes.starts_with("[playlist]"sv) ||
         bytes.starts_with("<"sv) || bytes.starts_with("#"sv);
}

}  // namespace

bool IsVideoContainer(std::string_view beginning) {
  const auto has = [&](const Mark& mark) {
    return beginning.size() >= mark.at && beginning.substr(mark.at).starts_with(mark.bytes);
  };
  return std::any_of(kMarks.begin(), kMarks.end(), has) || IsTransportStream(beginning);
}

void RequireVideoContainer(const std::filesystem::path& file) {
  const std::string beginning = ReadBeginning(file, kContainerBytes);
  if (IsVideoContainer(beginning)) return;
  if (IsPlaylist(beginning))
    throw Error(Code::kBadImage,
                "this is a list that names other files, not a video; give the video itself", file);
  throw Error(Code::kBadImage,
              "this video cannot be opened: it is cut off, empty or in a format that is not known; "
              "export it again as MP4, or as a folder of pictures",
              file);
}

}  // namespace arthro::authoring
