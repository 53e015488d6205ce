#include "drivers/sigrok/session_file/SigrokFormat.h"

#include "core/formats/ChannelOptions.h"
#include "core/measure/CaptureFile.h"
#include "drivers/sigrok/session_file/SrReader.h"
#include "drivers/sigrok/session_file/SrWriter.h"

namespace tacto {

bool SigrokFormat::recognises(const std::filesystem::path& path, std::string_view head) const {
    if (!head.starts_with("PK\3\4") || head.size() < 37) return false;
    // Every .sr begins with an entry called "version".
    return path.extension() == ".sr" || head.substr(30, 7) == "version";
}

Result<CaptureReading> SigrokFormat::read(const std::filesystem::path& path, const ReadOptions& options,
                                          const ReadWatch& watch) const {
    const auto layout = sigrok_driver::readSrLayout(path);
    if (!layout) return failure(layout);
    if (!layout->samplerateIsSensible && !options.rate) {
        return fail(
            ErrorCode::ParseError,
            "{}: its sampling rate is '{}'; a frequency above 0 was expected, as in 1 MHz; --sample-rate HZ reads "
            "it, where HZ is the instrument's rate",
            path.string(), layout->samplerate.substr(0, 40));
    }
    auto read = sigrok_driver::readSr(*layout, watch, path.string());
    if (!read) return failure(read);
    auto& reading = *read;
    if (options.rate) {
        const auto rate = rateFrom(options);
        if (!rate) return failure(rate);
        reading.capture.rate_hz = *rate;
    }
    if (!(reading.capture.rate_hz > 0)) {
        return fail(ErrorCode::ParseError,
                    "{}: it states no sampling rate; --sample-rate HZ reads it, where HZ is the instrument's rate",
                    path.string());
    }
    if (reading.capture.samples() < 2) {
        return fail(ErrorCode::ParseError, "{}: {} sample(s) per channel; at least 2 were expected", path.string(),
                    reading.capture.samples());
    }
    dropNoValues(reading, path.string());
    std::vector<ChannelPlan> plans;
    for (const auto& channel : reading.capture.channels) {
        plans.push_back({channel.name, plans.size() + 1, channel.unit, 1, ""});
    }
    if (auto applied = applyChannelOptions(reading.capture, std::move(plans), options, path.string()); !applied) {
        return failure(applied);
    }
    return read;
}

Result<void> SigrokFormat::write(const std::filesystem::path& path, const Capture& capture) const {
    if (auto writable = checkWritable(capture); !writable) return writable;
    return sigrok_driver::writeSr(path, capture);
}

}  // namespace tacto
