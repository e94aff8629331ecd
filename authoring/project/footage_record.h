// How the panorama of a scene was made: its clips, what a person chose for them, and the report of
// every frame. Part of the document, so that a frame can be left out or tied in tomorrow. File:
// footage.json in the scene, by resources/schemas/footage-1.schema.json.
//
// A copy of a scene that is handed on keeps the clips' sizes and fingerprints, by which each can be
// recognised, and none of their names and folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "authoring/footage/pixel_box.h"
#include "authoring/panorama/ties/frame_tie.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

struct ClipFile {
  std::string name;         // file or folder, without its path
  std::string file;         // absolute; empty: not known
  std::string beside;       // from the scene's folder; empty: not known
  std::string fingerprint;  // ClipFingerprint
  int frames = 0;
  AssetRights rights;
  friend bool operator==(const ClipFile&, const ClipFile&) = default;
  template <class V>
  void Visit(V&& v) {
    v("name", name, Any{}, "", "Name of the file or folder.");
    v("file", file, Any{}, "", "Where it was when the panorama was made.");
    v("beside", beside, Any{}, "", "The same, from the scene's folder.");
    v("fingerprint", fingerprint, Required{Any{}}, "", "Size and hash of what it holds.");
    v("frames", frames, Range{0, 1e7}, "", "Number of its frames.");
    v("rights", rights, Any{}, "", "Rights in the clip.");
  }
};

struct FootageRecord {
  std::vector<ClipFile> clips;
  std::vector<double> left_out;  // frames, by their number in the report
  std::vector<PixelBox> masked;  // px of the raw pictures
  std::vector<FrameTie> ties;
  std::optional<PixelBox> crop;  // part of the report's panorama; none: all of it
  bool is_mirrored = false;      // the scene shows the mirror image
  std::string report;            // JSON text, arthroscene.panorama/1
  friend bool operator==(const FootageRecord&, const FootageRecord&) = default;
  template <class V>
  void Visit(V&& v) {
    v("clips", clips, Required{Any{}}, "", "The clips, in the order of their frames.");
    v("left_out", left_out, NumberList{}, "", "Numbers of the frames that a person left out.");
    v("masked", masked, Any{}, "", "Rectangles of the raw pictures that show no tissue.");
    v("ties", ties, Any{}, "", "Tie points of frames that did not register.");
    v("crop", crop, Any{}, "", "Part of the panorama that the scene shows.");
    v("mirrored", is_mirrored, LeftOutAt{false, Any{}}, "",
      "Whether the scene shows the mirror image of that part.");
  }
};

// Throws Error(kBadData) with the key and what is wrong.
FootageRecord FootageFromJson(const std::string& text, const std::filesystem::path& file = {});
FootageRecord ReadFootage(const std::filesystem::path& file);
std::string JsonFromFootage(const FootageRecord& record);
std::string FootageSchemaText();

// The record as it is written into `folder`: clips beside the scene are found again when both move.
FootageRecord BesideScene(FootageRecord record, const std::filesystem::path& folder);
// Without names and folders of clips, for a scene that is handed on.
FootageRecord WithoutNames(FootageRecord record);

// Fingerprint of a video, or of all pictures of a folder. A video of more than 64 MB is told by its
// size and 64 pieces of 1 MB. Throws Error(kFile).
std::string ClipFingerprint(const std::filesystem::path& clip);

// Place of a clip now: beside the scene or where it was; "" where neither is there.
std::filesystem::path FindClip(const ClipFile& clip, const std::filesystem::path& scene_folder);
// A sentence for a clip that is gone, with what to do.
std::string WordsOfMissingClip(const ClipFile& clip);

}  // namespace arthro::authoring
