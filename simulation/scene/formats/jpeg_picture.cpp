// JPEG through libjpeg itself, which OpenCV uses too: only so can its words be kept off stderr and
// a damaged picture be told from a whole one.
#include <csetjmp>
#include <cstdio>
#include <jerror.h>
#include <jpeglib.h>
#include <string>

#include <fmt/format.h>

#include "simulation/core/error.h"
#include "simulation/scene/formats/picture_formats.h"

namespace arthro {
namespace {

// A progressive picture of 16k x 16k would take 1.6 GB; scans without end would take hours.
constexpr long kMostMemory = 600L << 20;  // bytes
constexpr int kMostScans = 100;

// All that lives across a jump out of libjpeg.
struct JpegReading {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr faults{};
  jpeg_progress_mgr progress{};
  std::jmp_buf on_fault;
  bool is_damaged = false;
  ColourImage image;
  std::vector<JSAMPLE> cmyk;  // a row, where the file has four channels
  std::string exif;

  ~JpegReading() { jpeg_destroy_decompress(&jpeg); }
};

JpegReading& ReadingOf(j_common_ptr jpeg) { return *static_cast<JpegReading*>(jpeg->client_data); }

[[noreturn]] void OnFault(j_common_ptr jpeg) { std::longjmp(ReadingOf(jpeg).on_fault, 1); }

void OnMessage(j_common_ptr jpeg, int level) {
  if (level >= 0) return;  // a trace
  const int code = jpeg->err->msg_code;
  // Warnings that leave the pixels as they are. Cameras write a few bytes before the end mark.
  constexpr int kEndMark = 0xd9, kFewBytes = 8;
  const bool is_harmless = code == JWRN_ADOBE_XFORM || code == JWRN_BOGUS_ICC ||
                           (code == JWRN_EXTRANEOUS_DATA && jpeg->err->msg_parm.i[0] <= kFewBytes &&
                            jpeg->err->msg_parm.i[1] == kEndMark);
  if (!is_harmless) ReadingOf(jpeg).is_damaged = true;
}

void OnProgress(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMostScans) OnFault(jpeg);
}

bool ReadHead(JpegReading& reading, std::string_view bytes) {
  if (setjmp(reading.on_fault)) return false;
  jpeg_create_decompress(&reading.jpeg);
  reading.jpeg.client_data = &reading;
  reading.jpeg.progress = &reading.progress;
  reading.jpeg.mem->max_memory_to_use = kMostMemory;
  jpeg_save_markers(&reading.jpeg, JPEG_APP0 + 1, 0xffff);  // EXIF
  jpeg_mem_src(&reading.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&reading.jpeg, TRUE);
  return true;
}

// Inks as Adobe writes them: 255 is none.
void RgbFromCmyk(const std::vector<JSAMPLE>& cmyk, std::uint8_t* rgb) {
  for (std::size_t i = 0; i + 3 < cmyk.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) {
      const int black = cmyk[i + 3];
      *rgb++ = static_cast<std::uint8_t>(black - ((255 - cmyk[i + c]) * black >> 8));
    }
}

// Rows one by one, so that a file that ends early has not taken the memory of a whole picture.
bool ReadPixels(JpegReading& reading) {
  if (setjmp(reading.on_fault)) return false;
  jpeg_decompress_struct& jpeg = reading.jpeg;
  const bool is_cmyk = jpeg.num_components == 4;
  jpeg.out_color_space = is_cmyk ? JCS_CMYK : JCS_RGB;
  jpeg_start_decompress(&jpeg);
  const std::size_t stride = 3 * static_cast<std::size_t>(jpeg.output_width);
  reading.image.rgb.reserve(stride * jpeg.output_height);
  if (is_cmyk) reading.cmyk.resize(4 * static_cast<std::size_t>(jpeg.output_width));
  while (jpeg.output_scanline < jpeg.output_height && !reading.is_damaged) {
    const std::size_t begin = reading.image.rgb.size();
    reading.image.rgb.resize(begin + stride);
    JSAMPROW row = is_cmyk ? reading.cmyk.data() : &reading.image.rgb[begin];
    if (jpeg_read_scanlines(&jpeg, &row, 1) != 1) return false;
    if (is_cmyk) RgbFromCmyk(reading.cmyk, &reading.image.rgb[begin]);
  }
  if (reading.is_damaged) return false;
  for (auto marker = jpeg.marker_list; marker; marker = marker->next) {
    const std::string_view data(reinterpret_cast<const char*>(marker->data), marker->data_length);
    constexpr std::string_view kExif("Exif\0\0", 6);
    if (data.starts_with(kExif) && reading.exif.empty()) reading.exif = data.substr(kExif.size());
  }
  jpeg_finish_decompress(&jpeg);  // frees the markers
  return true;
}

}  // namespace

ColourImage DecodeJpeg(std::string_view bytes, const std::filesystem::path& file) {
  if (bytes.rfind("\xff\xd9") == bytes.npos) RefuseCutOff(file);  // bytes may follow the end mark
  JpegReading reading;
  reading.jpeg.err = jpeg_std_error(&reading.faults);
  reading.faults.error_exit = OnFault;
  reading.faults.emit_message = OnMessage;
  reading.progress.progress_monitor = OnProgress;
  reading.jpeg.client_data = &reading;
  if (!ReadHead(reading, bytes)) RefuseDamagedPicture(file);
  RequireSize(reading.jpeg.image_width, reading.jpeg.image_height, bytes, file);
  reading.image.width = static_cast<int>(reading.jpeg.image_width);
  reading.image.height = static_cast<int>(reading.jpeg.image_height);
  const bool is_read = ReadPixels(reading);
  if (!is_read && reading.faults.msg_code == JERR_NO_BACKING_STORE)
    throw Error(Code::kBadImage,
                fmt::format("this progressive JPEG of {} x {} pixels takes too much memory; save "
                            "it as PNG",
                            reading.image.width, reading.image.height),
                file);
  if (!is_read || reading.is_damaged) RefuseDamagedPicture(file);
  ApplyExifOrientation(reading.exif, reading.image);
  return std::move(reading.image);
}

}  // namespace arthro
