#include "core/formats/CaptureFormat.h"

namespace tacto {

Result<void> keepReading(const ReadWatch& watch, double fraction, std::string_view file) {
    if (watch.stop.stop_requested()) return fail(ErrorCode::Stopped, "reading {} was given up on request", file);
    if (watch.progress) watch.progress(fraction);
    return {};
}

Result<void> CaptureFormat::write(const std::filesystem::path& path, const Capture& /*capture*/) const {
    return fail(ErrorCode::Unsupported, "{}: {} can be read, not written", path.string(), name());
}

}  // namespace tacto
