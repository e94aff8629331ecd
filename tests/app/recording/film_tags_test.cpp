// Colour tags and key pictures of films, read by FFmpeg's own libraries.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "app/recording/video_file.h"
#include "tests/support/temp_folder.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace arthro::app {
namespace {

constexpr VideoSize kTagSize = {64, 48};
constexpr double kTagRate = 10;

struct FilmTags {
  AVColorRange range{};
  AVColorSpace matrix{};
  AVColorPrimaries primaries{};
  AVColorTransferCharacteristic curve{};
  std::vector<double> key_times;  // s
  int luma = -1;                  // luma in the first picture's middle
};

FilmTags ReadTags(const std::filesystem::path& file) {
  FilmTags tags;
  AVFormatContext* film = nullptr;
  if (avformat_open_input(&film, file.c_str(), nullptr, nullptr) < 0) return tags;
  avformat_find_stream_info(film, nullptr);
  AVStream* stream = film->streams[0];
  const AVCodecParameters& given = *stream->codecpar;
  tags.range = given.color_range;
  tags.matrix = given.color_space;
  tags.primaries = given.color_primaries;
  tags.curve = given.color_trc;
  AVCodecContext* decoder = avcodec_alloc_context3(avcodec_find_decoder(given.codec_id));
  avcodec_parameters_to_context(decoder, &given);
  avcodec_open2(decoder, nullptr, nullptr);
  AVPacket* packet = av_packet_alloc();
  AVFrame* frame = av_frame_alloc();
  while (av_read_frame(film, packet) >= 0) {
    if ((packet->flags & AV_PKT_FLAG_KEY) != 0)
      tags.key_times.push_back(static_cast<double>(packet->pts) * av_q2d(stream->time_base));
    avcodec_send_packet(decoder, packet);
    if (tags.luma < 0 && avcodec_receive_frame(decoder, frame) >= 0)
      tags.luma = frame->data[0][24 * frame->linesize[0] + 32];
    av_packet_unref(packet);
  }
  av_frame_free(&frame);
  av_packet_free(&packet);
  avcodec_free_context(&decoder);
  avformat_close_input(&film);
  return tags;
}

FilmTags TagsOf(const char* name, const std::array<std::uint8_t, 3>& colour, int count) {
  const test::TempFolder folder;
  VideoFile film(folder / name, kTagSize, kTagRate);
  ColourImage picture(kTagSize.width, kTagSize.height);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = colour[i % 3];
  for (int i = 0; i < count; ++i) film.Add(picture);
  film.Finish();
  return ReadTags(folder / name);
}

constexpr std::array<std::uint8_t, 3> kRed{200, 40, 30};

class TaggedFilm : public testing::TestWithParam<const char*> {};

// Limited range holds luma as 16 + 219 Y; a player that reads the tags shows the colours drawn.
TEST_P(TaggedFilm, StatesBt709AndHoldsItsLuma) {
  const FilmTags tags = TagsOf(GetParam(), kRed, 5);
  EXPECT_EQ(tags.range, AVCOL_RANGE_MPEG);
  EXPECT_EQ(tags.matrix, AVCOL_SPC_BT709);
  EXPECT_EQ(tags.primaries, AVCOL_PRI_BT709);
  EXPECT_EQ(tags.curve, AVCOL_TRC_BT709);
  const double luma = (0.2126 * kRed[0] + 0.7152 * kRed[1] + 0.0722 * kRed[2]) / 255;
  EXPECT_NEAR(tags.luma, 16 + 219 * luma, 1.5);
}

TEST_P(TaggedFilm, HasAKeyPictureEveryTwoSeconds) {
  const FilmTags tags = TagsOf(GetParam(), kRed, 75);
  ASSERT_EQ(tags.key_times.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(tags.key_times[i], 2.0 * double(i), 1e-3) << i;
}

INSTANTIATE_TEST_SUITE_P(Formats, TaggedFilm, testing::Values("film.mp4", "film.mkv"));

TEST(JpegFilm, KeepsTheColoursOfJpeg) {
  const FilmTags tags = TagsOf("film.avi", kRed, 3);
  const double luma = 0.299 * kRed[0] + 0.587 * kRed[1] + 0.114 * kRed[2];
  EXPECT_NEAR(tags.luma, luma, 1.5);
}

}  // namespace
}  // namespace arthro::app
