// Made.h - makes XDF and EDF files byte by byte, sound ones and others.
//
// Thread-safety: pure functions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

namespace tacto::test {

template <class Number>
std::string littleEndianBytes(Number number) {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

/// Packs a text with gzip, as one member.
inline std::string gzipped(std::string_view text) {
    z_stream stream = {};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY), Z_OK);
    std::string packed(deflateBound(&stream, text.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(packed.size() - stream.avail_out);
    deflateEnd(&stream);
    return packed;
}

inline std::string xdfChunk(std::uint16_t tag, std::string_view content) {
    return "\x04" + littleEndianBytes(static_cast<std::uint32_t>(content.size() + 2)) + littleEndianBytes(tag) +
           std::string(content);
}
inline const std::string kXdfBegin = "XDF:" + xdfChunk(1, "<?xml version=\"1.0\"?><info><version>1.0</version></info>");
inline std::string xdfBoundary() {
    return xdfChunk(5, std::string_view("\x43\xA5\x46\xDC\xCB\xF5\x41\x0F\xB3\x0E\xD5\x46\x73\x83\xCB\xE4", 16));
}
struct XdfChannel {
    std::string label, unit;
};
inline std::string xdfHeader(std::uint32_t id, std::string_view name, std::string_view type, std::string_view format,
                             std::size_t count, double rate, const std::vector<XdfChannel>& channels = {}) {
    std::string described;
    for (const auto& channel : channels)
        described += fmt::format("<channel><label>{}</label><unit>{}</unit></channel>", channel.label, channel.unit);
    return xdfChunk(2, littleEndianBytes(id) +
                           fmt::format("<?xml version=\"1.0\"?><info><name>{}</name><type>{}</type><channel_count>{}"
                                       "</channel_count><nominal_srate>{}</nominal_srate><channel_format>{}"
                                       "</channel_format><desc><channels>{}</channels></desc></info>",
                                       name, type, count, rate, format, described));
}
/// A chunk of float32 samples, each with a stamp; `row(i, channel)` gives the values.
template <class Row>
std::string xdfSamples(std::uint32_t id, const std::vector<double>& stamps, std::size_t channels, Row&& row) {
    auto content = littleEndianBytes(id) + "\x04" + littleEndianBytes(static_cast<std::uint32_t>(stamps.size()));
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        content += "\x08" + littleEndianBytes(stamps[i]);
        for (std::size_t c = 0; c < channels; ++c) content += littleEndianBytes(static_cast<float>(row(i, c)));
    }
    return xdfChunk(3, content);
}
inline std::string xdfOffset(std::uint32_t id, double at_s, double offset_s) {
    return xdfChunk(4, littleEndianBytes(id) + littleEndianBytes(at_s) + littleEndianBytes(offset_s));
}

struct EdfSignal {
    std::string label = "Fz", unit = "mN";
    std::string physicalMin = "-100", physicalMax = "100", digitalMin = "-32768", digitalMax = "32767";
    std::string perRecord = "100";
};
struct EdfMade {
    bool bdf = false;
    std::string reserved = "EDF+C", recording = "Startdate 30-NOV-2026 X X X";
    std::string records = "3", duration = "1", signalCount, headerBytes;  // empty: as they are
    std::vector<EdfSignal> signals{{}};
    /// Returns the file, with the digital values of `value(signal, k)`.
    template <class Value>
    [[nodiscard]] std::string file(Value&& value) const {
        std::string out;
        const auto field = [&](std::string_view text, std::size_t bytes) {
            out += fmt::format("{:<{}}", text, bytes).substr(0, bytes);
        };
        const auto ns = signals.size() + 1;  // with annotations
        if (bdf)
            out +=
                "\xFF"
                "BIOSEMI";
        else
            field("0", 8);
        field("X X X X", 80);
        field(recording, 80);
        field("30.11.26", 8);
        field("08.30.00", 8);
        field(headerBytes.empty() ? fmt::format("{}", 256 * (ns + 1)) : headerBytes, 8);
        field(reserved, 44);
        field(records, 8);
        field(duration, 8);
        field(signalCount.empty() ? fmt::format("{}", ns) : signalCount, 4);
        const auto each = [&](std::string EdfSignal::*member, std::string_view ofNotes, std::size_t bytes) {
            for (const auto& signal : signals) field(signal.*member, bytes);
            field(ofNotes, bytes);
        };
        each(&EdfSignal::label, bdf ? "BDF Annotations" : "EDF Annotations", 16);
        for (std::size_t i = 0; i < ns; ++i) field("", 80);
        each(&EdfSignal::unit, "", 8);
        each(&EdfSignal::physicalMin, "-1", 8);
        each(&EdfSignal::physicalMax, "1", 8);
        each(&EdfSignal::digitalMin, bdf ? "-8388608" : "-32768", 8);
        each(&EdfSignal::digitalMax, bdf ? "8388607" : "32767", 8);
        for (std::size_t i = 0; i < ns; ++i) field("", 80);
        each(&EdfSignal::perRecord, "20", 8);
        for (std::size_t i = 0; i < ns; ++i) field("", 32);
        const int bytes = bdf ? 3 : 2;
        for (int record = 0; record < std::min(std::atoi(records.c_str()), 3); ++record) {
            for (std::size_t s = 0; s < signals.size(); ++s) {
                const int n = std::atoi(signals[s].perRecord.c_str());
                for (int i = 0; i < n && n < 100'000; ++i) {
                    const int digital = value(s, static_cast<std::size_t>(record * n + i));
                    for (int b = 0; b < bytes; ++b) out += static_cast<char>(digital >> 8 * b);
                }
            }
            auto note = fmt::format("+{}\x14\x14", record * std::atof(duration.c_str()));
            note.resize(static_cast<std::size_t>(20 * bytes), '\0');
            out += note;
        }
        return out;
    }
};

}  // namespace tacto::test
