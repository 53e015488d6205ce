#include "core/formats/WavFormat.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/formats/ChannelOptions.h"
#include "core/formats/WavHeader.h"
#include "core/measure/CaptureFile.h"

namespace tacto {

namespace {

constexpr std::size_t kReadAtOnce = 1024 * 1024;

std::uint64_t wordAt(const char* bytes, std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = count; i > 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[i - 1]);
    return value;
}

/// A sample as a fraction of the full scale; floats as they are.
float sampleAt(const char* bytes, const WavHeader& header) {
    const auto word = wordAt(bytes, header.bits / 8);
    if (header.isFloat) {
        return header.bits == 32 ? std::bit_cast<float>(static_cast<std::uint32_t>(word))
                                 : static_cast<float>(std::bit_cast<double>(word));
    }
    if (header.bits == 8) return (static_cast<float>(word) - 128.0F) / 128.0F;
    // Shifted up to 32 bits the sign is where the machine has it.
    const auto full = static_cast<std::int32_t>(static_cast<std::uint32_t>(word << (32 - header.bits)));
    return static_cast<float>(static_cast<double>(full) / 2147483648.0);
}

Result<void> readSamples(ByteFile& file, const WavHeader& header, const ReadWatch& watch, Capture& capture) {
    const std::size_t frame = header.frameBytes();
    const auto frames = static_cast<std::size_t>(header.bytes / frame);
    for (auto& channel : capture.channels) channel.samples.reserve(frames);
    if (auto placed = file.seek(header.begin); !placed) return placed;
    std::vector<char> chunk(std::max(kReadAtOnce / frame, std::size_t{1}) * frame);
    for (std::size_t done = 0; done < frames;) {
        const auto wanted = std::min(chunk.size(), (frames - done) * frame);
        const auto got = file.read(chunk.data(), wanted);
        if (!got) return failure(got);
        if (*got < wanted) return fail(ErrorCode::Io, "{} became shorter while it was read", file.name());
        for (std::size_t i = 0; i < wanted / frame; ++i) {
            const char* at = chunk.data() + i * frame;
            for (auto& channel : capture.channels) {
                channel.samples.push_back(sampleAt(at, header));
                at += header.bits / 8;
            }
        }
        done += wanted / frame;
        const auto fraction = static_cast<double>(done) / static_cast<double>(frames);
        if (auto going = keepReading(watch, fraction, file.name()); !going) return going;
    }
    return {};
}

}  // namespace

bool WavFormat::recognises(const std::filesystem::path& /*path*/, std::string_view head) const { return isWav(head); }

Result<CaptureReading> WavFormat::read(const std::filesystem::path& path, const ReadOptions& options,
                                       const ReadWatch& watch) const {
    auto file = ByteFile::open(path);
    if (!file) return failure(file);
    const auto header = readWavHeader(*file);
    if (!header) return failure(header);
    if (header->bytes / header->frameBytes() < 2) {
        return fail(ErrorCode::ParseError, "{}: {} sample(s) per channel; at least 2 were expected", file->name(),
                    header->bytes / header->frameBytes());
    }
    CaptureReading reading;
    auto& capture = reading.capture;
    std::vector<ChannelPlan> plans;
    for (unsigned c = 0; c < header->channels; ++c) {
        auto& channel = capture.channels.emplace_back();
        channel.name = fmt::format("CH{}", c + 1);
    }
    capture.rate_hz = header->rate_hz;
    capture.trigger_s = std::numeric_limits<double>::quiet_NaN();
    const bool own = header->isFloat && takeOwnComment(header->comment, capture);
    if (header->cutShort) {
        reading.warnings.push_back(
            fmt::format("{}: fewer samples than announced: the file was cut short", file->name()));
    }
    if (auto read = readSamples(*file, *header, watch, capture); !read) return failure(read);
    for (auto& channel : capture.channels) {
        if (!header->isFloat) {
            channel.low = -1;
            channel.lsb = std::exp2(1 - static_cast<double>(header->bits));
            channel.high = 1 - channel.lsb;
        }
        plans.push_back({channel.name, plans.size() + 1, channel.unit, 1, ""});
        if (!own && !options.units.contains(channel.name)) {
            reading.warnings.push_back(fmt::format(
                "{}: a WAV does not say what its full scale is: {} is in parts of it until a unit and a probe factor "
                "are given",
                file->name(), channel.name));
        }
    }
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        capture.rate_hz = *rate;
    }
    if (auto applied = applyChannelOptions(capture, std::move(plans), options, file->name()); !applied) {
        return failure(applied);
    }
    return reading;
}

Result<void> WavFormat::write(const std::filesystem::path& path, const Capture& capture) const {
    if (auto writable = checkWritable(capture); !writable) return writable;
    const double rate = std::round(capture.rate_hz);
    if (!(rate >= 1 && rate <= std::numeric_limits<std::uint32_t>::max()) ||
        std::abs(rate / capture.rate_hz - 1) > 1e-6) {
        return fail(ErrorCode::InvalidArgument,
                    "{}: a WAV holds whole rates from 1 to 4294967295 Hz; the capture has {} Hz", path.string(),
                    capture.rate_hz);
    }
    const auto bytes = static_cast<double>(capture.samples()) * static_cast<double>(capture.channels.size()) * 4;
    if (!(bytes < 4.2e9) || capture.channels.size() > 65535) {
        return fail(ErrorCode::InvalidArgument,
                    "{}: a WAV holds 65535 channels and 4.2 GB; the capture has {} and {:.3g} GB", path.string(),
                    capture.channels.size(), bytes / 1e9);
    }
    static_assert(std::endian::native == std::endian::little, "floats are written as they lie in memory");
    std::ofstream stream(path, std::ios::binary);
    stream << wavHeaderOf(capture, static_cast<std::uint32_t>(rate));
    std::vector<float> frames;
    const std::size_t channels = capture.channels.size();
    const std::size_t atOnce = std::max(kReadAtOnce / (4 * channels), std::size_t{1});
    for (std::size_t i = 0; i < capture.samples() && stream; i += atOnce) {
        const auto count = std::min(atOnce, capture.samples() - i);
        frames.resize(count * channels);
        for (std::size_t c = 0; c < channels; ++c) {
            for (std::size_t k = 0; k < count; ++k) frames[k * channels + c] = capture.channels[c].samples[i + k];
        }
        stream.write(reinterpret_cast<const char*>(frames.data()), static_cast<std::streamsize>(4 * frames.size()));
    }
    stream.flush();
    if (!stream) return fail(ErrorCode::Io, "{} could not be written", path.string());
    return {};
}

}  // namespace tacto
