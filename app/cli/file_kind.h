// Kind of result that an existing file holds, judged by its content and never by its name, so that
// a job replaces its own earlier result and nothing else.
#pragma once

#include <filesystem>
#include <string>

namespace arthro::app {

enum class FileForm {
  kPicture,   // PNG, JPEG, TIFF, BMP or WebP
  kDepthMap,  // TIFF of 32-bit floating-point samples
  kTable,     // CSV whose first line begins with `mark`
  kJson,      // JSON object whose "schema" begins with `mark`
  kVolume,    // VTK's XML format of an unstructured grid
  kPlot,      // SVG
  kUnique,    // film, log or scene: made by a person, so no existing file is replaceable
};

struct FileKind {
  const char* words;  // "a depth map"
  FileForm form = FileForm::kPicture;
  const char* mark = "";
};

// An empty file is of every kind but kUnique: nothing is lost with it. False where `file` cannot be
// read.
bool IsOfKind(const std::filesystem::path& file, const FileKind& kind);

}  // namespace arthro::app
