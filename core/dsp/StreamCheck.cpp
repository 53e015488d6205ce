#include "core/dsp/StreamCheck.h"

#include "core/dsp/Butterworth.h"

namespace tacto {

namespace {

Result<void> checkStream(const StreamInfo& info) {
    if (!(info.rate_hz > 0 && info.rate_hz <= 1e6)) {
        return fail(ErrorCode::InvalidArgument, "{}: its rate is {} Hz; above 0 to 1 MHz was expected",
                    nameOf(info.kind), info.rate_hz);
    }
    switch (info.kind) {
        case StreamKind::Acceleration:
            // Measured rates miss a nominal 100 Hz or 20 kHz by a little.
            if (!(info.rate_hz >= 99 && info.rate_hz <= 20'200)) {
                return fail(ErrorCode::InvalidArgument,
                            "acceleration: its rate is {:.6g} Hz; 100 Hz to 20 kHz was expected", info.rate_hz);
            }
            if (info.channels < 1 || info.channels > AxesBandpass::kMaxAxes) {
                return fail(ErrorCode::InvalidArgument, "acceleration: it has {} axes; 1 to 3 were expected",
                            info.channels);
            }
            return {};
        case StreamKind::Force:
            if (info.channels == 1) return {};
            return fail(ErrorCode::InvalidArgument, "force: it has {} channels; 1 was expected", info.channels);
        case StreamKind::Taxels:
            if (info.channels >= 2) return {};
            return fail(ErrorCode::InvalidArgument, "taxels: there are {}; at least 2 were expected", info.channels);
    }
    return {};
}

}  // namespace

Result<void> checkStreams(std::span<const StreamInfo> streams) {
    if (streams.empty()) {
        return fail(ErrorCode::InvalidArgument,
                    "roughness: there is no stream; acceleration, force or taxels was expected");
    }
    for (std::size_t i = 0; i < streams.size(); ++i) {
        if (const auto good = checkStream(streams[i]); !good) return failure(good);
        for (std::size_t j = 0; j < i; ++j) {
            if (streams[i].kind != streams[j].kind) continue;
            return fail(ErrorCode::InvalidArgument, "roughness: there are two {} streams; one was expected",
                        nameOf(streams[i].kind));
        }
    }
    return {};
}

}  // namespace tacto
