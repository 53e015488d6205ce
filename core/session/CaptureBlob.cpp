#include "core/session/CaptureBlob.h"

#include <cstring>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/base/JsonFields.h"
#include "core/measure/CaptureDescription.h"

namespace tacto {

namespace {

/// Bytes of like significance side by side: codes of a converter repeat in their high bytes, so deflate finds them.
constexpr std::size_t kWidth = sizeof(float);

std::vector<std::byte> planes(const Capture& capture) {
    const std::size_t samples = capture.samples();
    std::vector<std::byte> out(samples * capture.channels.size() * kWidth);
    std::byte* plane = out.data();
    for (const auto& channel : capture.channels) {
        const auto bytes = std::as_bytes(std::span(channel.samples));
        for (std::size_t b = 0; b < kWidth; ++b) {
            for (std::size_t i = 0; i < samples; ++i) plane[i] = bytes[i * kWidth + b];
            plane += samples;
        }
    }
    return out;
}

void fromPlanes(std::span<const std::byte> bytes, Capture& capture, std::size_t samples) {
    const std::byte* plane = bytes.data();
    for (auto& channel : capture.channels) {
        channel.samples.resize(samples);
        const auto out = std::as_writable_bytes(std::span(channel.samples));
        for (std::size_t b = 0; b < kWidth; ++b) {
            for (std::size_t i = 0; i < samples; ++i) out[i * kWidth + b] = plane[i];
            plane += samples;
        }
    }
}

/// A deflated capture cannot unpack to more than this times its size (deflate's own bound is 1032).
constexpr std::size_t kLargestRatio = 1100;

}  // namespace

PackedCapture packSamples(const Capture& capture) {
    PackedCapture packed{planes(capture), false};
    uLongf size = compressBound(static_cast<uLong>(packed.data.size()));
    std::vector<std::byte> smaller(size);
    const int code =
        compress2(reinterpret_cast<Bytef*>(smaller.data()), &size, reinterpret_cast<const Bytef*>(packed.data.data()),
                  static_cast<uLong>(packed.data.size()), Z_BEST_SPEED);
    if (code == Z_OK && size < packed.data.size() - packed.data.size() / 10) {
        smaller.resize(size);
        packed = {std::move(smaller), true};
    }
    return packed;
}

nlohmann::json describe(const Capture& capture, const PackedCapture& packed) {
    auto description = describeCapture(capture);
    description["samples"] = capture.samples();
    description["deflated"] = packed.deflated;
    return description;
}

Result<Capture> unpackCapture(const nlohmann::json& description, std::span<const std::byte> data) {
    auto described = captureDescribed(description);
    if (!described) return fail(ErrorCode::ParseError, "a capture has no list of channels");
    Capture& capture = *described;
    const auto samples = static_cast<std::size_t>(countOr(description, "samples"));
    const bool deflated = flagOr(description, "deflated");
    const std::size_t values = deflated ? data.size() * kLargestRatio / kWidth : data.size() / kWidth;
    if (capture.channels.empty() ? samples != 0 : samples > values / capture.channels.size()) {
        return fail(ErrorCode::ParseError, "a capture says {} samples and holds {} bytes", samples, data.size());
    }
    std::vector<std::byte> bytes;
    const std::size_t expected = samples * capture.channels.size() * kWidth;
    if (deflated) {
        bytes.resize(expected);
        auto size = static_cast<uLongf>(expected);
        const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                    reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(data.size()));
        if (code != Z_OK || size != expected) return fail(ErrorCode::ParseError, "a capture does not unpack");
        data = bytes;
    }
    if (data.size() != expected) {
        return fail(ErrorCode::ParseError, "a capture says {} samples and holds {} bytes", samples, data.size());
    }
    fromPlanes(data, capture, samples);
    return std::move(capture);
}

}  // namespace tacto
