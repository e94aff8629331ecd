// Recognises a video by its first bytes. Playlists (HLS, DASH, concat, SDP) are refused: they name
// other files or addresses, which the decoder would open whatever the playlist itself is called.
#pragma once

#include <filesystem>
#include <string_view>

namespace arthro::authoring {

inline constexpr std::size_t kContainerBytes = 1024;  // bytes that IsVideoContainer reads

// `beginning`: the file's first kContainerBytes, or the whole of a shorter file.
bool IsVideoContainer(std::string_view beginning);

// Throws Error(kBadImage) for a file that is not a video, and Error(kFile) for one that is not a
// regular file. Call it before a video library opens the file by its name.
void RequireVideoContainer(const std::filesystem::path& file);

}  // namespace arthro::authoring
