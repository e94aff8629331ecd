// Pictures without what they say about a patient, a place or a camera. The compressed pixels stay
// byte for byte, so nothing is compressed a second time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace arthro {

// The same PNG or JPEG file with nothing but what its pixels need: no EXIF, XMP, GPS, IPTC, text,
// comments, thumbnails, colour profiles, further pictures, or bytes after its end.
//   PNG keeps  IHDR PLTE tRNS gAMA cHRM sRGB IDAT IEND
//   JPEG keeps frame, tables and scans, a JFIF header without thumbnail, and Adobe's APP14, which
//              says how the colours are coded
// Nothing for other formats, and for a file whose parts do not follow one another as they must.
//
// EXIF also says how a picture is turned. A decoder that turned the pixels shows another picture
// after this; the caller compares the two and then writes the pixels instead.
std::optional<std::string> PictureWithoutMetadata(std::string_view bytes);

}  // namespace arthro
