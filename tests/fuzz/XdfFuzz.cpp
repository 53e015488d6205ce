// Any bytes as XDF file are read or refused with a sentence, and what was read does not contradict itself (hazard H10).
#include "core/exchange/recordings/OpenRecording.h"
#include "core/exchange/xdf/Gunzip.h"
#include "core/exchange/xdf/XdfFile.h"
#include "tests/fuzz/FuzzTarget.h"
#include "tests/fuzz/InputFile.h"

namespace tacto::fuzz::XdfFuzz {

/// How many times smaller deflate makes its input at most.
constexpr std::size_t kMaxPacked = 1032;

TACTO_FUZZ(XdfFuzz, const std::uint8_t* data, std::size_t size) {
    const auto* text = reinterpret_cast<const char*>(data);
    const auto path = tacto::fuzz::inputFile("input.xdf", {data, size});
    const auto file = tacto::readXdf(path);
    if (!file) {
        tacto::fuzz::require(!file.error().message.empty());
        return 0;
    }
    for (const auto& stream : file->streams) {
        tacto::fuzz::require(stream.channels.size() <= stream.width);
        if (stream.texts) continue;
        tacto::fuzz::require(stream.samples.t_s.size() == stream.count);
        tacto::fuzz::require(stream.samples.values.size() == stream.count * stream.width);
        tacto::fuzz::require(stream.samples.values.size() <= size * (tacto::isGzip({text, size}) ? kMaxPacked : 1));
    }
    const auto recording = tacto::openRecording(path);
    tacto::fuzz::require(recording || !recording.error().message.empty());
    return 0;
}

}  // namespace tacto::fuzz::XdfFuzz
