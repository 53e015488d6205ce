// Any text as recording.json, with valid tables next to it, is opened or refused with a sentence, and never gives a
// stream that contradicts itself (hazard H10).
#include <cstdlib>
#include <string_view>

#include "core/acquisition/Recording.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::RecordingFuzz {

namespace {

std::span<const std::uint8_t> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

TACTO_FUZZ(RecordingFuzz, const std::uint8_t* data, std::size_t size) {
    static const auto tables = [] {
        tacto::fuzz::inputFile("a.csv", bytesOf("time,X,Y,Z\n0,0,0,1\n0.001,0,0.1,1\n0.002,0.2,0,1\n0.003,0,0,1\n"));
        return tacto::fuzz::inputFile("f.csv", bytesOf("time,force\n0,0.1\n5,0.2\n10,0.3\n"));
    }();
    const auto recording = tacto::Recording::open(tacto::fuzz::inputFile("recording.json", {data, size}));
    if (!recording) {
        if (recording.error().message.empty()) std::abort();
        return 0;
    }
    const auto blocks = recording->blocks();
    if (blocks.size() != recording->streams.size()) std::abort();
    const auto extent = recording->extent();
    if (!recording->streams.empty() && !(extent.begin_s <= extent.end_s)) std::abort();
    return 0;
}

}  // namespace tacto::fuzz::RecordingFuzz
