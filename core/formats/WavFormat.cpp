#include "core/formats/WavFormat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <sndfile.h>
#include <utility>

#include "core/base/Text.h"
#include "core/formats/ByteFile.h"
#include "core/formats/ChannelOptions.h"
#include "core/measure/CaptureFile.h"

namespace tacto {

namespace {

constexpr std::string_view kOwnComment = "Tactoscope capture";
constexpr int kMaxChannels = 1024;  // libsndfile's
constexpr std::size_t kSamplesAtOnce = 256UL * 1024;

struct CloseSound {
    void operator()(SNDFILE* sound) const noexcept { ::sf_close(sound); }
};
using Sound = std::unique_ptr<SNDFILE, CloseSound>;

std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

/// The chunks that say how to read the samples: those up to the first that holds samples. What stands behind that one
/// is passed over: a second file joined to the first, a second data chunk.
struct Layout {
    std::string format;           ///< the fmt chunk, its first 64 kB
    std::string info;             ///< the INFO list, its first 64 kB; empty where there is none
    std::uint64_t samplesAt = 0;  ///< where the samples begin, in bytes
    std::uint64_t end = 0;        ///< where they end; where that is not announced, the end of the file
    std::uint32_t announced = 0;  ///< bytes of samples, as the file states them
    bool more = false;            ///< a second data chunk or a second file stands behind

    /// Programs that write to a pipe announce all ones; one that is killed while it records leaves 0.
    [[nodiscard]] bool openEnded() const noexcept {
        return announced == 0 || announced == std::numeric_limits<std::uint32_t>::max();
    }
};

/// Errors: ParseError without a data chunk among the first thousand; Io.
Result<Layout> layoutOf(ByteFile& file) {
    constexpr int kMaxChunks = 1000;
    constexpr std::uint32_t kLongest = 65536;
    Layout layout;
    std::uint64_t at = 12;
    for (int n = 0; n < kMaxChunks && at + 8 <= file.size(); ++n) {
        std::string bytes(8, '\0');
        if (auto placed = file.seek(at); !placed) return failure(placed);
        if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
        const auto size = numberAt(bytes, 4, 4);
        const auto begin = at + 8;
        if (bytes.starts_with("data")) {
            layout.samplesAt = begin;
            layout.announced = size;
            layout.end = layout.openEnded() ? file.size() : std::min(file.size(), begin + size);
            const auto next = std::min(file.size(), layout.end + layout.end % 2);
            if (auto placed = file.seek(next); !placed) return failure(placed);
            bytes.assign(4, '\0');
            if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
            layout.more = bytes == "data" || bytes == "RIFF";
            return layout;
        }
        const bool isFormat = bytes.starts_with("fmt ");
        const bool isList = bytes.starts_with("LIST");
        if (isFormat || isList) {
            bytes.resize(std::min<std::uint64_t>({size, kLongest, file.size() - begin}));
            if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
            if (isFormat) layout.format = bytes;
            // Markers ("adtl") are a list, too.
            if (isList && bytes.starts_with("INFO")) layout.info = bytes;
        }
        at = begin + size + size % 2;
    }
    return fail(ErrorCode::ParseError, "{}: it holds no data chunk; RIFF WAVE with samples was expected", file.name());
}

/// A file as libsndfile is to see it: it ends where the samples end, and says so where it was never finished.
class SoundBytes {
public:
    SoundBytes(ByteFile file, const Layout& layout)
        : file_(std::move(file)), size_(layout.end), unfinished_(layout.announced == 0) {}

    /// Errors: ParseError with libsndfile's reason; Io. The sound reads from this object.
    Result<Sound> open(SF_INFO& info) {
        if (auto placed = file_.seek(0); !placed) return failure(placed);
        SF_VIRTUAL_IO io{};
        io.get_filelen = [](void* self) { return static_cast<sf_count_t>(of(self).size_); };
        io.seek = [](sf_count_t offset, int whence, void* self) { return of(self).seek(offset, whence); };
        io.read = [](void* into, sf_count_t count, void* self) {
            return of(self).read(static_cast<char*>(into), static_cast<std::uint64_t>(count));
        };
        io.tell = [](void* self) { return static_cast<sf_count_t>(of(self).at_); };
        // libsndfile keeps why it could not open a file in one place for all threads.
        static std::mutex opening;
        const std::lock_guard lock(opening);
        Sound sound(::sf_open_virtual(&io, SFM_READ, &info, this));
        if (sound) return sound;
        return fail(ErrorCode::ParseError, "{}: it cannot be read as WAV: {}", file_.name(), ::sf_strerror(nullptr));
    }

private:
    static SoundBytes& of(void* self) { return *static_cast<SoundBytes*>(self); }
    sf_count_t seek(sf_count_t offset, int whence) {
        const auto from = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? at_ : size_;
        const auto to = static_cast<sf_count_t>(from) + offset;
        if (to < 0 || !file_.seek(static_cast<std::uint64_t>(to))) return -1;
        at_ = static_cast<std::uint64_t>(to);
        return to;
    }
    sf_count_t read(char* into, std::uint64_t count) {
        const auto got = file_.read(into, std::min(count, size_ - std::min(size_, at_)));
        if (!got) return 0;
        // For libsndfile samples without an announced size go to the end if the whole file announces 8 bytes.
        for (std::uint64_t i = 0; unfinished_ && i < *got && at_ + i < 8; ++i) {
            if (at_ + i >= 4) into[i] = at_ + i == 4 ? 8 : 0;
        }
        at_ += *got;
        return static_cast<sf_count_t>(*got);
    }

    ByteFile file_;
    std::uint64_t size_;
    std::uint64_t at_ = 0;
    bool unfinished_;
};

/// INFO ICMT. Read here because libsndfile passes over texts of 2 kB, and so over the names of some 70 channels.
std::string commentIn(std::string_view info) {
    for (std::size_t at = 4; at + 8 <= info.size();) {
        const std::size_t size = numberAt(info, at + 4, 4);
        if (info.substr(at, 4) == "ICMT") {
            const auto text = info.substr(at + 8, size);
            return std::string(text.substr(0, text.find('\0')));
        }
        at += 8 + size + size % 2;
    }
    return {};
}

std::string ownComment(const Capture& capture) {
    std::string text(kOwnComment);
    text += fmt::format("\nstart_s={}", capture.start_s);
    for (const auto& channel : capture.channels) {
        std::string name = channel.name;
        std::ranges::replace_if(
            name, [](char c) { return c == '\n' || c == '\0'; }, ' ');
        text += fmt::format("\nchannel={};{}", channel.unit, name);
    }
    return text;
}

/// Names, units and start as our own comment keeps them; `capture` has its channels. False for another's comment.
bool takeOwnComment(std::string_view comment, Capture& capture) {
    const auto lines = split(comment, '\n');
    if (lines.empty() || lines.front() != kOwnComment) return false;
    std::size_t next = 0;
    for (const auto line : lines) {
        if (line.starts_with("start_s=")) {
            const auto start = parseNumber(line.substr(8));
            if (start && std::isfinite(*start)) capture.start_s = *start;
        }
        if (line.starts_with("channel=") && next < capture.channels.size()) {
            const auto text = line.substr(8);
            const auto semicolon = std::min(text.find(';'), text.size());
            const auto unit = text.substr(0, semicolon);
            auto& channel = capture.channels[next++];
            if (unit == "V" || unit == "A") channel.unit = unit;
            if (semicolon + 1 < text.size()) channel.name = text.substr(semicolon + 1);
        }
    }
    return next == capture.channels.size();
}

/// The bits of a sample. Errors: ParseError for what is neither linear PCM nor floats.
Result<unsigned> bitsOf(std::string_view format, bool isFloat, const std::string& file) {
    constexpr std::uint32_t kExtensible = 0xFFFE;
    const bool whole = format.size() >= 16;
    auto kind = whole ? numberAt(format, 0, 2) : 0;
    // The extensible form carries the old number at the beginning of an identifier.
    if (kind == kExtensible && format.size() >= 26) kind = numberAt(format, 24, 2);
    const auto bits = whole ? numberAt(format, 14, 2) : 0;
    const bool known =
        isFloat ? kind == 3 && (bits == 32 || bits == 64) : kind == 1 && bits <= 32 && bits > 0 && bits % 8 == 0;
    if (known) return bits;
    return fail(ErrorCode::ParseError,
                "{}: samples of kind {} with {} bits; PCM of 8, 16, 24 or 32 or floats of 32 or 64 were expected", file,
                kind, bits);
}

Result<void> readSamples(SNDFILE* sound, std::size_t frames, const ReadWatch& watch, const std::string& file,
                         Capture& capture) {
    const std::size_t channels = capture.channels.size();
    for (auto& channel : capture.channels) channel.samples.reserve(frames);
    const std::size_t atOnce = kSamplesAtOnce / channels;
    std::vector<float> chunk(atOnce * channels);
    for (std::size_t done = 0; done < frames;) {
        const auto wanted = std::min(atOnce, frames - done);
        if (::sf_readf_float(sound, chunk.data(), static_cast<sf_count_t>(wanted)) != static_cast<sf_count_t>(wanted)) {
            return fail(ErrorCode::Io, "{} became shorter while it was read", file);
        }
        for (std::size_t i = 0; i < wanted * channels; ++i) {
            capture.channels[i % channels].samples.push_back(chunk[i]);
        }
        done += wanted;
        const auto fraction = static_cast<double>(done) / static_cast<double>(frames);
        if (auto going = keepReading(watch, fraction, file); !going) return going;
    }
    return {};
}

bool isWav(std::string_view head) noexcept {
    return head.size() >= 12 && head.starts_with("RIFF") && head.substr(8, 4) == "WAVE";
}

}  // namespace

bool WavFormat::recognises(const std::filesystem::path& /*path*/, std::string_view head) const { return isWav(head); }

Result<CaptureReading> WavFormat::read(const std::filesystem::path& path, const ReadOptions& options,
                                       const ReadWatch& watch) const {
    const auto head = readHead(path);
    if (!head) return failure(head);
    const auto file = path.string();
    if (!isWav(*head)) return fail(ErrorCode::ParseError, "{}: no RIFF WAVE at its beginning", file);
    auto opened = ByteFile::open(path);
    if (!opened) return failure(opened);
    const auto layout = layoutOf(*opened);
    if (!layout) return failure(layout);
    SoundBytes bytes(std::move(*opened), *layout);
    SF_INFO info{};
    const auto sound = bytes.open(info);
    if (!sound) return failure(sound);
    const int subtype = info.format & SF_FORMAT_SUBMASK;
    const bool isFloat = subtype == SF_FORMAT_FLOAT || subtype == SF_FORMAT_DOUBLE;
    const auto bits = bitsOf(layout->format, isFloat, file);
    if (!bits) return failure(bits);
    if (info.frames < 2) {
        return fail(ErrorCode::ParseError, "{}: {} sample(s) per channel; at least 2 were expected", file, info.frames);
    }
    CaptureReading reading;
    auto& capture = reading.capture;
    std::vector<ChannelPlan> plans;
    for (int c = 0; c < info.channels; ++c) {
        auto& channel = capture.channels.emplace_back();
        channel.name = fmt::format("CH{}", c + 1);
    }
    capture.rate_hz = info.samplerate;
    capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    const bool own = isFloat && takeOwnComment(commentIn(layout->info), capture);
    if (layout->announced == 0) {
        reading.warnings.push_back(
            fmt::format("{}: it was never finished (it announces no samples): all that it holds were read", file));
    } else if (!layout->openEnded() && layout->samplesAt + layout->announced > layout->end) {
        reading.warnings.push_back(fmt::format("{}: fewer samples than announced: the file was cut short", file));
    }
    if (layout->more) {
        reading.warnings.push_back(
            fmt::format("{}: a second recording stands behind the first; it was not read", file));
    }
    if (auto read = readSamples(sound->get(), static_cast<std::size_t>(info.frames), watch, file, capture); !read)
        return failure(read);
    if (isFloat) dropNoValues(reading, file);
    for (auto& channel : capture.channels) {
        if (!isFloat) {
            channel.low = -1;
            channel.lsb = std::exp2(1 - static_cast<double>(*bits));
            channel.high = 1 - channel.lsb;
        }
        plans.push_back({channel.name, plans.size() + 1, channel.unit, 1, ""});
        if (!own && !options.units.contains(channel.name)) {
            reading.warnings.push_back(fmt::format(
                "{}: a WAV does not say what its full scale is: {} is in parts of it until a unit and a probe factor "
                "are given",
                file, channel.name));
        }
    }
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        capture.rate_hz = *rate;
    }
    if (auto applied = applyChannelOptions(capture, std::move(plans), options, file); !applied) {
        return failure(applied);
    }
    return reading;
}

Result<void> WavFormat::write(const std::filesystem::path& path, const Capture& capture) const {
    if (auto writable = checkWritable(capture); !writable) return writable;
    const double rate = std::round(capture.rate_hz);
    constexpr int kMaxRate = std::numeric_limits<int>::max();
    if (!(rate >= 1 && rate <= kMaxRate) || std::abs(rate / capture.rate_hz - 1) > 1e-6) {
        return fail(ErrorCode::InvalidArgument, "{}: a WAV holds whole rates from 1 to {} Hz; the capture has {} Hz",
                    path.string(), kMaxRate, capture.rate_hz);
    }
    const auto bytes = static_cast<double>(capture.samples()) * static_cast<double>(capture.channels.size()) * 4;
    if (!(bytes < 4.2e9) || capture.channels.size() > kMaxChannels) {
        return fail(ErrorCode::InvalidArgument,
                    "{}: a WAV holds {} channels and 4.2 GB; the capture has {} and {:.3g} GB", path.string(),
                    kMaxChannels, capture.channels.size(), bytes / 1e9);
    }
    SF_INFO info{};
    info.samplerate = static_cast<int>(rate);
    info.channels = static_cast<int>(capture.channels.size());
    info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
    Sound sound(::sf_open(path.c_str(), SFM_WRITE, &info));
    // The PEAK chunk would hold the time of writing: the same capture gives the same bytes.
    bool whole = sound && ::sf_command(sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE) == SF_FALSE &&
                 ::sf_set_string(sound.get(), SF_STR_COMMENT, ownComment(capture).c_str()) == SF_ERR_NO_ERROR;
    std::vector<float> frames;
    const std::size_t channels = capture.channels.size();
    const std::size_t atOnce = kSamplesAtOnce / channels;
    for (std::size_t i = 0; i < capture.samples() && whole; i += atOnce) {
        const auto count = std::min(atOnce, capture.samples() - i);
        frames.resize(count * channels);
        for (std::size_t c = 0; c < channels; ++c) {
            for (std::size_t k = 0; k < count; ++k) frames[k * channels + c] = capture.channels[c].samples[i + k];
        }
        const auto wanted = static_cast<sf_count_t>(count);
        whole = ::sf_writef_float(sound.get(), frames.data(), wanted) == wanted;
    }
    whole = ::sf_close(sound.release()) == SF_ERR_NO_ERROR && whole;
    if (!whole) return fail(ErrorCode::Io, "{} could not be written", path.string());
    return {};
}

}  // namespace tacto
