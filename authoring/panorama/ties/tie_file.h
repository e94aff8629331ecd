// File of tie points for `arthroscene panorama --ties`: arthroscene.ties/1.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "authoring/panorama/ties/frame_tie.h"

namespace arthro::authoring {

// Throws Error(kBadData) with the key and what is wrong.
std::vector<FrameTie> ParseTies(const std::string& text, const std::filesystem::path& file = {});
std::vector<FrameTie> ReadTies(const std::filesystem::path& file);
std::string TiesSchemaText();

}  // namespace arthro::authoring
