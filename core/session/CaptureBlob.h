// CaptureBlob.h - an oscilloscope record as it lies in the file: a description in JSON, and the channels' float32
// samples one channel after the other, deflated where that helps.
//
// Thread-safety: pure functions.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/Result.h"
#include "core/measure/Capture.h"

namespace tacto {

struct PackedCapture {
    std::vector<std::byte> data;
    bool deflated = false;
};

/// Deflates at the fastest level and keeps it when it saves at least a tenth.
[[nodiscard]] PackedCapture packSamples(const Capture& capture);
/// The capture without its samples, as the log row's JSON ("trial" and checksums apart). NaN becomes null.
[[nodiscard]] nlohmann::json describe(const Capture& capture, const PackedCapture& packed);

/// Errors: ParseError when the description is not one or the samples do not fit it.
[[nodiscard]] Result<Capture> unpackCapture(const nlohmann::json& description, std::span<const std::byte> data);

}  // namespace tacto
