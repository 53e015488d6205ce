#include "core/formats/WavFormat.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <limits>
#include <memory>
#include <sndfile.h>
#include <system_error>
#include <utility>

#include "core/base/LocaleFreeText.h"
#include "core/base/WholeFile.h"
#include "core/formats/ChannelOptions.h"
#include "core/formats/TextBlocks.h"
#include "core/measure/CaptureFile.h"

namespace tacto {

namespace {

constexpr std::string_view kOwnComment = "Tactoscope capture";
constexpr std::size_t kMaxChannels = 1024;  // limit of libsndfile
constexpr std::size_t kSamplesAtOnce = 256UL * 1024;

struct CloseSound {
    void operator()(SNDFILE* sound) const noexcept { ::sf_close(sound); }
};
using Sound = std::unique_ptr<SNDFILE, CloseSound>;

std::uint64_t numberAt(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[at + i - 1]);
    return value;
}

/// RF64 (EBU Tech 3306) and BW64 (ITU-R BS.2088) are RIFF files with 64-bit sizes, which stand in a first chunk ds64.
bool isKindOfFile(std::string_view bytes) noexcept {
    return bytes.starts_with("RIFF") || bytes.starts_with("RF64") || bytes.starts_with("BW64");
}

bool isWav(std::string_view head) noexcept {
    return head.size() >= 12 && isKindOfFile(head) && head.substr(8, 4) == "WAVE";
}

constexpr std::uint64_t kUnstated = 0xFFFFFFFF;  // a size that does not fit into 32 bits, or was not yet known

/// The chunks that describe the samples, up to the first chunk of samples. Later parts are ignored: a second file
/// appended to the first, or a second data chunk.
struct Layout {
    std::string format;           ///< first 64 kB of the fmt chunk
    std::string info;             ///< first 64 kB of the INFO list; empty if there is none
    std::string sizes;            ///< first 64 kB of the ds64 chunk of RF64 and BW64 (EBU Tech 3306)
    std::uint64_t samplesAt = 0;  ///< position of the first sample, in bytes
    std::uint64_t end = 0;        ///< end of the samples, or of the file if their size is not stated
    std::uint64_t announced = 0;  ///< bytes of samples that the file states
    bool more = false;            ///< true if a second data chunk or a second file follows

    /// True if the size is unknown: a writer to a pipe states all ones; a program killed while it records leaves 0.
    [[nodiscard]] bool openEnded() const noexcept { return announced == 0 || announced == kUnstated; }

    /// Returns the size stated with chunk `id`. If it does not fit there, reads it from ds64, which holds the size of
    /// the file, the size of the samples, the number of samples and a table for other chunks.
    [[nodiscard]] std::uint64_t sizeOf(std::string_view id, std::uint64_t stated) const {
        constexpr std::size_t kTable = 28, kEntry = 12;
        if (stated != kUnstated || sizes.size() < kTable) return stated;
        if (id == "data") return numberAt(sizes, 8, 8);
        for (std::size_t at = kTable; at + kEntry <= sizes.size(); at += kEntry)
            if (std::string_view(sizes).substr(at, 4) == id) return numberAt(sizes, at + 4, 8);
        return stated;
    }
};

/// Finds the chunks. Errors: ParseError if none of the first thousand is a data chunk; Io.
Result<Layout> layoutOf(ByteFile& file) {
    constexpr int kMaxChunks = 1000;
    constexpr std::uint64_t kLongest = 65536;
    Layout layout;
    std::uint64_t at = 12;
    for (int n = 0; n < kMaxChunks && at + 8 <= file.size(); ++n) {
        std::string bytes(8, '\0');
        if (auto placed = file.seek(at); !placed) return failure(placed);
        if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
        const auto id = bytes.substr(0, 4);
        const auto begin = at + 8;
        const auto size = layout.sizeOf(id, numberAt(bytes, 4, 4));
        const auto end = begin + std::min(size, file.size() - begin);
        if (id == "data") {
            layout.samplesAt = begin;
            layout.announced = size;
            layout.end = layout.openEnded() ? file.size() : end;
            const auto next = std::min(file.size(), layout.end + layout.end % 2);
            if (auto placed = file.seek(next); !placed) return failure(placed);
            bytes.assign(4, '\0');
            if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
            layout.more = bytes == "data" || isKindOfFile(bytes);
            return layout;
        }
        if (id == "fmt " || id == "LIST" || id == "ds64") {
            bytes.resize(std::min(end - begin, kLongest));
            if (auto got = file.read(bytes.data(), bytes.size()); !got) return failure(got);
            if (id == "fmt ") layout.format = bytes;
            if (id == "ds64") layout.sizes = bytes;
            // Markers ("adtl") are also a list.
            if (id == "LIST" && bytes.starts_with("INFO")) layout.info = bytes;
        }
        at = end + size % 2;
    }
    return fail(ErrorCode::ParseError, "{}: it holds no data chunk; RIFF WAVE with samples was expected", file.name());
}

/// Returns the comment, INFO ICMT. libsndfile skips texts above 2 kB, which hold the names of about 70 channels.
std::string commentIn(std::string_view info) {
    for (std::size_t at = 4; at + 8 <= info.size();) {
        const auto size = static_cast<std::size_t>(numberAt(info, at + 4, 4));
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

/// Takes names, units and start from a comment of this program for `capture`, which has its channels. False for others.
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

/// The sample layout stated in the fmt chunk.
struct Samples {
    std::uint64_t channels = 0;
    double rate_hz = 0;
    std::uint64_t bits = 0;
    bool isFloat = false;

    /// Returns one sample: a float unchanged, PCM as a fraction of full scale (8-bit PCM is unsigned).
    [[nodiscard]] float at(const char* bytes) const noexcept {
        const auto raw = numberAt({bytes, static_cast<std::size_t>(bits / 8)}, 0, static_cast<std::size_t>(bits / 8));
        if (isFloat && bits == 32) return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
        if (isFloat) return static_cast<float>(std::bit_cast<double>(raw));
        const auto half = std::int64_t{1} << (bits - 1);
        auto value = static_cast<std::int64_t>(raw);
        if (bits == 8 || value >= half) value -= bits == 8 ? half : 2 * half;
        return static_cast<float>(static_cast<double>(value) / static_cast<double>(half));
    }
};

/// Errors: ParseError if samples are not linear PCM or float, if the rate is 0, or for no or too many channels.
Result<Samples> samplesIn(std::string_view format, const std::string& file) {
    constexpr std::uint64_t kPcm = 1, kFloat = 3, kExtensible = 0xFFFE;
    const bool whole = format.size() >= 16;
    auto kind = whole ? numberAt(format, 0, 2) : 0;
    // The extensible form holds the format number at the beginning of an identifier.
    if (kind == kExtensible && format.size() >= 26) kind = numberAt(format, 24, 2);
    const auto bits = whole ? numberAt(format, 14, 2) : 0;
    const bool known =
        kind == kFloat ? bits == 32 || bits == 64 : kind == kPcm && bits <= 32 && bits > 0 && bits % 8 == 0;
    if (!known) {
        return fail(ErrorCode::ParseError,
                    "{}: samples of kind {} with {} bits; PCM of 8, 16, 24 or 32 or floats of 32 or 64 were expected",
                    file, kind, bits);
    }
    const Samples samples{numberAt(format, 2, 2), static_cast<double>(numberAt(format, 4, 4)), bits, kind == kFloat};
    if (samples.channels < 1 || samples.channels > kMaxChannels || !(samples.rate_hz > 0)) {
        return fail(ErrorCode::ParseError, "{}: {} channels at {} Hz; 1 to {} and a rate above 0 were expected", file,
                    samples.channels, samples.rate_hz, kMaxChannels);
    }
    return samples;
}

Result<void> readSamples(ByteFile& file, const Layout& layout, const Samples& samples, const ReadWatch& watch,
                         Capture& capture) {
    const auto width = static_cast<std::size_t>(samples.bits / 8);
    const std::size_t channels = capture.channels.size();
    const auto frames = static_cast<std::size_t>((layout.end - layout.samplesAt) / (width * channels));
    for (auto& channel : capture.channels) channel.samples.reserve(frames);
    const std::size_t atOnce = std::max<std::size_t>(kSamplesAtOnce / channels, 1);
    std::vector<char> chunk(atOnce * channels * width);
    if (auto placed = file.seek(layout.samplesAt); !placed) return placed;
    for (std::size_t done = 0; done < frames;) {
        const auto wanted = std::min(atOnce, frames - done);
        const auto got = file.read(chunk.data(), wanted * channels * width);
        if (!got) return failure(got);
        if (*got < wanted * channels * width)
            return fail(ErrorCode::Io, "{} became shorter while it was read", file.name());
        for (std::size_t i = 0; i < wanted * channels; ++i)
            capture.channels[i % channels].samples.push_back(samples.at(chunk.data() + i * width));
        done += wanted;
        const auto fraction = static_cast<double>(done) / static_cast<double>(frames);
        if (auto going = keepReading(watch, fraction, file.name()); !going) return going;
    }
    return {};
}

/// Errors: Io with the reason of the system, or else of libsndfile.
Result<void> writeSamples(const std::filesystem::path& path, const Capture& capture, int rate) {
    auto file = FileOut::create(path);
    if (!file) return failure(file);
    SF_INFO info{};
    info.samplerate = rate;
    info.channels = static_cast<int>(capture.channels.size());
    info.format = SF_FORMAT_WAV | SF_FORMAT_FLOAT;
    errno = 0;
    Sound sound(::sf_open_fd(file->descriptor(), SFM_WRITE, &info, SF_FALSE));
    // Without the PEAK chunk, which holds the time of writing, equal captures give equal files.
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
    int reason = whole ? 0 : errno;
    // Closing writes the header again and reports pending write errors.
    if (::sf_close(sound.release()) != SF_ERR_NO_ERROR || !whole) {
        if (reason == 0) reason = errno;
        return fail(ErrorCode::Io, "{}",
                    reason != 0 ? std::generic_category().message(reason) : std::string(::sf_strerror(nullptr)));
    }
    return {};
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
    const auto samples = samplesIn(layout->format, file);
    if (!samples) return failure(samples);
    const auto frames = (layout->end - layout->samplesAt) / (samples->channels * samples->bits / 8);
    if (frames < 2) {
        return fail(ErrorCode::ParseError, "{}: {} sample(s) per channel; at least 2 were expected", file, frames);
    }
    CaptureReading reading;
    auto& capture = reading.capture;
    std::vector<ChannelPlan> plans;
    for (std::uint64_t c = 0; c < samples->channels; ++c) {
        auto& channel = capture.channels.emplace_back();
        channel.name = fmt::format("CH{}", c + 1);
    }
    capture.rate_hz = samples->rate_hz;
    capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    const bool own = samples->isFloat && takeOwnComment(commentIn(layout->info), capture);
    if (layout->announced == 0) {
        reading.warnings.push_back(
            fmt::format("{}: it was never finished (it announces no samples): all that it holds were read", file));
    } else if (!layout->openEnded() && layout->announced > layout->end - layout->samplesAt) {
        reading.warnings.push_back(fmt::format("{}: fewer samples than announced: the file was cut short", file));
    }
    if (layout->more) {
        reading.warnings.push_back(
            fmt::format("{}: a second recording stands behind the first; it was not read", file));
    }
    if (auto read = readSamples(*opened, *layout, *samples, watch, capture); !read) return failure(read);
    if (samples->isFloat) dropNoValues(reading, file);
    for (auto& channel : capture.channels) {
        if (!samples->isFloat) {
            channel.low = -1;
            channel.lsb = std::exp2(1 - static_cast<double>(samples->bits));
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
        return invalid("{}: a WAV holds whole rates from 1 to {} Hz; the capture has {} Hz", path.string(), kMaxRate,
                       capture.rate_hz);
    }
    const auto bytes = static_cast<double>(capture.samples()) * static_cast<double>(capture.channels.size()) * 4;
    if (!(bytes < 4.2e9) || capture.channels.size() > kMaxChannels) {
        return invalid("{}: a WAV holds {} channels and 4.2 GB; the capture has {} and {:.3g} GB", path.string(),
                       kMaxChannels, capture.channels.size(), bytes / 1e9);
    }
    return namedAs(path, replaceWholeFile(path, [&](const std::filesystem::path& draft) {
                       return writeSamples(draft, capture, static_cast<int>(rate));
                   }));
}

}  // namespace tacto
