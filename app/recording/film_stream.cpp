#include "app/recording/film_stream.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace arthro::app {
namespace {

// Chosen for the fidelity of OpenCV's writer: 90 pictures of a moving 512 px view, ms of processor
// time per picture, dB of the worst picture: OpenCV H.264 7.3 ms, 39.4 dB; Motion JPEG 2.8, 37.7.
constexpr const char* kRateFactor = "24";  // H.264
constexpr const char* kPreset = "faster";  // loses 0.05 dB to "medium", which takes 7.9 ms
constexpr int kJpegQuantiser = 3;
constexpr double kKeyEvery = 2.0;      // s, at most; a player jumps to the nearest key picture
constexpr int kRowsPerSlice = 270;     // px; a slice per thread, so that larger pictures keep pace
constexpr int kMostSlices = 4;         // whatever the machine has, for the same bytes everywhere
constexpr int kBuffer = 1 << 16;       // bytes
constexpr int kLargestRate = 1001000;  // numerator of a rate; 30000/1001 fits

struct Free {
  void operator()(AVCodecContext* own) const { avcodec_free_context(&own); }
  void operator()(AVFrame* own) const { av_frame_free(&own); }
  void operator()(AVPacket* own) const { av_packet_free(&own); }
  void operator()(SwsContext* own) const { sws_freeContext(own); }
};
using Codec = std::unique_ptr<AVCodecContext, Free>;
using Frame = std::unique_ptr<AVFrame, Free>;
using Packet = std::unique_ptr<AVPacket, Free>;
using Scaler = std::unique_ptr<SwsContext, Free>;

struct FormatNames {
  const char *ending, *muxer, *demuxer;
};
constexpr std::array<FormatNames, 3> kFormats{
    {{".mp4", "mp4", "mov"}, {".mkv", "matroska", "matroska"}, {".avi", "avi", "avi"}}};
const FormatNames& NamesOf(FilmFormat format) { return kFormats[static_cast<std::size_t>(format)]; }

// A file as FFmpeg reads and writes it. Once a write failed all later ones fail, so that nothing
// stands after a gap.
class FilmFile {
 public:
  FilmFile(int descriptor, bool is_written) : descriptor_(descriptor) {
    auto* buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
    context_ = avio_alloc_context(buffer, kBuffer, is_written ? 1 : 0, this, &Read, &Write, &Seek);
    if (context_ == nullptr) av_free(buffer);
  }
  ~FilmFile() {
    if (context_ == nullptr) return;
    av_freep(&context_->buffer);
    avio_context_free(&context_);
  }
  FilmFile(const FilmFile&) = delete;
  FilmFile& operator=(const FilmFile&) = delete;

  AVIOContext* context() { return context_; }
  int error() const { return error_; }
  off_t end() const { return end_; }  // end of all written bytes

 private:
  static int Read(void* opaque, std::uint8_t* bytes, int size) {
    auto& own = *static_cast<FilmFile*>(opaque);
    ssize_t count = 0;
    do count = ::pread(own.descriptor_, bytes, static_cast<std::size_t>(size), own.at_);
    while (count < 0 && errno == EINTR);
    if (count < 0) return AVERROR(errno);
    own.at_ += count;
    return count == 0 ? AVERROR_EOF : static_cast<int>(count);
  }
  static int Write(void* opaque, std::uint8_t* bytes, int size) {
    auto& own = *static_cast<FilmFile*>(opaque);
    for (int done = 0; done < size && own.error_ == 0;) {
      const ssize_t count =
          ::pwrite(own.descriptor_, bytes + done, static_cast<std::size_t>(size - done), own.at_);
      if (count < 0) {
        if (errno != EINTR) own.error_ = errno;
        continue;
      }
      done += static_cast<int>(count);
      own.at_ += count;
      own.end_ = std::max(own.end_, own.at_);
    }
    return own.error_ != 0 ? AVERROR(own.error_) : size;
  }
  static std::int64_t Seek(void* opaque, std::int64_t offset, int whence) {
    auto& own = *static_cast<FilmFile*>(opaque);
    struct stat status {};
    if (::fstat(own.descriptor_, &status) != 0) return AVERROR(errno);
    if ((whence & AVSEEK_SIZE) != 0) return status.st_size;
    const int from = whence & ~AVSEEK_FORCE;
    own.at_ = offset + (from == SEEK_CUR ? own.at_ : from == SEEK_END ? status.st_size : 0);
    return own.at_;
  }

  int descriptor_, error_ = 0;
  off_t at_ = 0, end_ = 0;
  AVIOContext* context_ = nullptr;
};

// A film that is written: one stream, each packet one picture that stands for 1/rate s.
class Muxer {
 public:
  Muxer(int descriptor, FilmFormat format) : file_(descriptor, true) {
    avformat_alloc_output_context2(&context_, nullptr, NamesOf(format).muxer, nullptr);
    if (context_ == nullptr) return;
    context_->pb = file_.context();
    context_->flags |= AVFMT_FLAG_BITEXACT | AVFMT_FLAG_CUSTOM_IO;
  }
  ~Muxer() { avformat_free_context(context_); }
  Muxer(const Muxer&) = delete;
  Muxer& operator=(const Muxer&) = delete;

  bool WantsGlobalHeader() const {
    return context_ != nullptr && (context_->oformat->flags & AVFMT_GLOBALHEADER) != 0;
  }
  bool Begin(const AVCodecParameters& parameters, AVRational rate, bool has_fragments) {
    if (context_ == nullptr || context_->pb == nullptr) return false;
    AVStream* stream = avformat_new_stream(context_, nullptr);
    if (stream == nullptr || avcodec_parameters_copy(stream->codecpar, &parameters) < 0)
      return false;
    stream->codecpar->codec_tag = 0;
    stream->time_base = per_picture_ = av_inv_q(rate);
    stream->avg_frame_rate = stream->r_frame_rate = rate;
    AVDictionary* options = nullptr;
    if (has_fragments && std::strcmp(context_->oformat->name, "mp4") == 0)
      av_dict_set(&options, "movflags", "frag_custom+empty_moov+default_base_moof", 0);
    const int result = avformat_write_header(context_, &options);
    av_dict_free(&options);
    has_begun_ = result >= 0;
    return has_begun_ && Flush();
  }
  bool Write(AVPacket& packet) {
    packet.stream_index = 0;
    packet.pts = packet.dts = count_++;
    packet.duration = 1;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, per_picture_, context_->streams[0]->time_base);
    return av_write_frame(context_, &packet) >= 0 && IsGood();
  }
  // Ends a fragment or cluster.
  bool Flush() {
    if (av_write_frame(context_, nullptr) < 0) return false;
    avio_flush(context_->pb);
    return IsGood();
  }
  bool End() {
    if (!has_begun_ || av_write_trailer(context_) < 0) return false;
    avio_flush(context_->pb);
    return IsGood();
  }
  int count() const { return count_; }
  off_t end() const { return file_.end(); }
  FilmResult Fault() const { return {false, file_.error()}; }

 private:
  bool IsGood() const { return file_.error() == 0 && context_->pb->error == 0; }

  FilmFile file_;
  AVFormatContext* context_ = nullptr;
  AVRational per_picture_{0, 1};
  bool has_begun_ = false;
  int count_ = 0;
};

// A film that is read, packet by packet, without decoding.
class Demuxer {
 public:
  Demuxer(int descriptor, FilmFormat format) : file_(descriptor, false) {
    AVFormatContext* context = avformat_alloc_context();
    if (context == nullptr || file_.context() == nullptr) {
      avformat_free_context(context);
      return;
    }
    context->pb = file_.context();
    // Takes packets as they are; one that is cut short is left out.
    context->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_DISCARD_CORRUPT | AVFMT_FLAG_NOPARSE |
                      AVFMT_FLAG_NOFILLIN;
    // Frees the context where it fails.
    if (avformat_open_input(&context, "", av_find_input_format(NamesOf(format).demuxer), nullptr) ==
        0)
      context_ = context;
    if (context_ != nullptr && context_->nb_streams == 1 &&
        context_->streams[0]->codecpar->codec_type == AVMEDIA_TYPE_VIDEO)
      stream_ = context_->streams[0];
    has_first_ = stream_ != nullptr && ReadPacket();
  }
  ~Demuxer() { avformat_close_input(&context_); }
  Demuxer(const Demuxer&) = delete;
  Demuxer& operator=(const Demuxer&) = delete;

  bool IsFilm() const { return stream_ != nullptr; }
  const AVCodecParameters& parameters() const { return *stream_->codecpar; }
  // The container's rate, or else that of its first picture's duration.
  AVRational Rate() const {
    if (stream_->avg_frame_rate.num > 0) return stream_->avg_frame_rate;
    AVRational rate{25, 1};
    if (has_first_ && first_duration_ > 0)
      av_reduce(&rate.num, &rate.den, stream_->time_base.den,
                stream_->time_base.num * first_duration_, kLargestRate);
    return rate;
  }
  // Null: there is no more.
  AVPacket* Next() {
    if (has_first_) {
      has_first_ = false;
      return packet_.get();
    }
    return IsFilm() && ReadPacket() ? packet_.get() : nullptr;
  }

 private:
  bool ReadPacket() {
    av_packet_unref(packet_.get());
    if (av_read_frame(context_, packet_.get()) < 0) return false;
    if (first_duration_ == 0) first_duration_ = packet_->duration;
    if (stream_->codecpar->codec_id == AV_CODEC_ID_MJPEG) packet_->flags |= AV_PKT_FLAG_KEY;
    return packet_->size > 0;
  }

  FilmFile file_;
  AVFormatContext* context_ = nullptr;
  AVStream* stream_ = nullptr;
  Packet packet_{av_packet_alloc()};
  std::int64_t first_duration_ = 0;
  bool has_first_ = false;
};

// The libraries speak on stderr, where our one sentence belongs.
void QuietLibraries() {
  static std::once_flag once;
  std::call_once(once, [] { av_log_set_level(AV_LOG_QUIET); });
}

// Colours that a player assumes: BT.709 of limited range in H.264, and BT.601 of full range in JPEG
// [JFIF 1.02], which has no other.
struct ColourTags {
  AVColorRange range;
  AVColorSpace matrix;
  int scaler_matrix;
};
ColourTags TagsOf(FilmFormat format) {
  if (format == FilmFormat::kAvi) return {AVCOL_RANGE_JPEG, AVCOL_SPC_BT470BG, SWS_CS_ITU601};
  return {AVCOL_RANGE_MPEG, AVCOL_SPC_BT709, SWS_CS_ITU709};
}

template <class Tagged>  // a codec or a frame
void SetTags(Tagged& tagged, FilmFormat format) {
  const ColourTags tags = TagsOf(format);
  tagged.color_range = tags.range;
  tagged.colorspace = tags.matrix;
  tagged.color_primaries = AVCOL_PRI_BT709;
  tagged.color_trc = AVCOL_TRC_BT709;
}

Codec OpenEncoder(FilmFormat format, VideoSize size, AVRational rate, bool has_global_header) {
  const bool is_jpeg = format == FilmFormat::kAvi;
  const AVCodec* kind =
      is_jpeg ? avcodec_find_encoder(AV_CODEC_ID_MJPEG) : avcodec_find_encoder_by_name("libx264");
  if (kind == nullptr) return nullptr;
  Codec codec(avcodec_alloc_context3(kind));
  if (!codec) return nullptr;
  codec->width = size.width, codec->height = size.height;
  codec->time_base = av_inv_q(rate), codec->framerate = rate;
  codec->pix_fmt = is_jpeg ? AV_PIX_FMT_YUVJ420P : AV_PIX_FMT_YUV420P;
  SetTags(*codec, format);
  codec->flags |= AV_CODEC_FLAG_BITEXACT;
  codec->thread_count = 1;
  if (has_global_header) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  if (is_jpeg) {
    codec->flags |= AV_CODEC_FLAG_QSCALE;
    codec->global_quality = FF_QP2LAMBDA * kJpegQuantiser;
  } else {
    codec->thread_count = std::clamp(size.height / kRowsPerSlice, 1, kMostSlices);
    codec->thread_type = FF_THREAD_SLICE;
    codec->gop_size = std::max(1, static_cast<int>(std::floor(av_q2d(rate) * kKeyEvery)));
    av_opt_set(codec->priv_data, "crf", kRateFactor, 0);
    av_opt_set(codec->priv_data, "preset", kPreset, 0);
    // No picture waits for later ones, so that none is lost with the program.
    av_opt_set(codec->priv_data, "tune", "zerolatency", 0);
  }
  return avcodec_open2(codec.get(), kind, nullptr) == 0 ? std::move(codec) : nullptr;
}

Frame NewFrame(VideoSize size, int format) {
  Frame frame(av_frame_alloc());
  if (!frame) return nullptr;
  frame->width = size.width, frame->height = size.height, frame->format = format;
  return av_frame_get_buffer(frame.get(), 0) == 0 ? std::move(frame) : nullptr;
}

}  // namespace

std::optional<FilmFormat> FilmFormatOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (std::size_t i = 0; i < kFormats.size(); ++i)
    if (ending == kFormats[i].ending) return static_cast<FilmFormat>(i);
  return std::nullopt;
}

struct FilmStream::Parts {
  Muxer muxer;
  FilmFormat format;
  VideoSize size;
  AVRational rate;
  int flush_every;  // pictures
  Codec codec;
  Frame rgb, yuv;
  Scaler scaler;
  Packet packet{av_packet_alloc()};
  int given = 0, whole_pictures = 0;
  off_t whole_bytes = 0;

  Parts(int descriptor, FilmFormat of_format, VideoSize of_size, double of_rate)
      : muxer(descriptor, of_format),
        format(of_format),
        size(of_size),
        rate(av_d2q(of_rate, kLargestRate)),
        flush_every(std::max(1, static_cast<int>(std::floor(of_rate * kFlushEvery)))) {}

  bool Flush() {
    if (!muxer.Flush()) return false;
    whole_bytes = muxer.end();
    whole_pictures = muxer.count();
    return true;
  }
  // Null: the film's end.
  bool Encode(const AVFrame* frame) {
    if (avcodec_send_frame(codec.get(), frame) < 0) return false;
    for (;;) {
      const int result = avcodec_receive_packet(codec.get(), packet.get());
      if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return true;
      if (result < 0 || !muxer.Write(*packet)) return false;
      av_packet_unref(packet.get());
      if (muxer.count() % flush_every == 0 && !Flush()) return false;
    }
  }
};

FilmStream::FilmStream(int descriptor, FilmFormat format, VideoSize size, double rate)
    : parts_(std::make_unique<Parts>(descriptor, format, size, rate)) {}
FilmStream::~FilmStream() = default;

off_t FilmStream::whole_bytes() const { return parts_->whole_bytes; }
int FilmStream::whole_pictures() const { return parts_->whole_pictures; }

FilmResult FilmStream::Begin() {
  QuietLibraries();
  Parts& p = *parts_;
  p.codec = OpenEncoder(p.format, p.size, p.rate, p.muxer.WantsGlobalHeader());
  if (!p.codec || !p.packet) return {false, 0};
  p.rgb = NewFrame(p.size, AV_PIX_FMT_RGB24);
  p.yuv = NewFrame(p.size, p.codec->pix_fmt);
  p.scaler.reset(sws_getContext(
      p.size.width, p.size.height, AV_PIX_FMT_RGB24, p.size.width, p.size.height, p.codec->pix_fmt,
      SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr, nullptr, nullptr));
  if (!p.rgb || !p.yuv || !p.scaler) return {false, 0};
  SetTags(*p.yuv, p.format);
  const ColourTags tags = TagsOf(p.format);
  const int* matrix = sws_getCoefficients(tags.scaler_matrix);
  constexpr int kOne = 1 << 16;  // contrast and saturation, in fixed point
  sws_setColorspaceDetails(p.scaler.get(), sws_getCoefficients(SWS_CS_DEFAULT), 1, matrix,
                           tags.range == AVCOL_RANGE_JPEG ? 1 : 0, 0, kOne, kOne);
  AVCodecParameters* parameters = avcodec_parameters_alloc();
  const bool has_begun = parameters != nullptr &&
                         avcodec_parameters_from_context(parameters, p.codec.get()) >= 0 &&
                         p.muxer.Begin(*parameters, p.rate, true) && p.Flush();
  avcodec_parameters_free(&parameters);
  return has_begun ? FilmResult{} : p.muxer.Fault();
}

FilmResult FilmStream::Add(const ColourImage& picture) {
  Parts& p = *parts_;
  if (av_frame_make_writable(p.yuv.get()) < 0) return {false, 0};
  // The frame's rows have room behind them, which the conversion may read.
  av_image_copy_plane(p.rgb->data[0], p.rgb->linesize[0], picture.rgb.data(), 3 * picture.width,
                      3 * picture.width, picture.height);
  sws_scale(p.scaler.get(), p.rgb->data, p.rgb->linesize, 0, p.size.height, p.yuv->data,
            p.yuv->linesize);
  p.yuv->pts = p.given++;
  if (p.format == FilmFormat::kAvi) p.yuv->quality = FF_QP2LAMBDA * kJpegQuantiser;
  return p.Encode(p.yuv.get()) ? FilmResult{} : p.muxer.Fault();
}

FilmResult FilmStream::End() {
  Parts& p = *parts_;
  if (!p.Encode(nullptr) || !p.Flush() || !p.muxer.End()) return p.muxer.Fault();
  p.whole_bytes = p.muxer.end();
  return {};
}

std::optional<FilmContent> ReadFilmContent(int descriptor, FilmFormat format) {
  QuietLibraries();
  Demuxer film(descriptor, format);
  if (!film.IsFilm()) return std::nullopt;
  FilmContent content{{film.parameters().width, film.parameters().height}, av_q2d(film.Rate()), 0};
  while (film.Next() != nullptr) ++content.pictures;
  return content;
}

FilmResult CopyFilm(int from, FilmFormat format, int to, int& copied) {
  QuietLibraries();
  copied = 0;
  Demuxer film(from, format);
  if (!film.IsFilm()) return {false, 0};
  Muxer muxer(to, format);
  if (!muxer.Begin(film.parameters(), film.Rate(), false)) return muxer.Fault();
  while (AVPacket* packet = film.Next()) {
    if (!muxer.Write(*packet)) return muxer.Fault();
    ++copied;
  }
  return muxer.End() ? FilmResult{} : muxer.Fault();
}

}  // namespace arthro::app
