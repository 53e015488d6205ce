#include "core/formats/CaptureFormat.h"

#include <new>
#include <stdexcept>

namespace tacto {

namespace {
auto doesNotFit(std::string_view file) {
    return fail(ErrorCode::Io,
                "{}: its samples do not fit into memory; a shorter record, or fewer of its channels, was expected",
                file);
}
}  // namespace

Result<void> keepReading(const ReadWatch& watch, double fraction, std::string_view file) {
    if (watch.stop.stop_requested()) return fail(ErrorCode::Stopped, "reading {} was cancelled", file);
    if (watch.progress) watch.progress(fraction);
    return {};
}

Result<CaptureReading> readWithinMemory(std::string_view file, const std::function<Result<CaptureReading>()>& read) {
    try {
        return read();
    } catch (const std::bad_alloc&) {
        return doesNotFit(file);
    } catch (const std::length_error&) {  // more than any memory
        return doesNotFit(file);
    }
}

Result<void> CaptureFormat::write(const std::filesystem::path& path, const Capture& /*capture*/) const {
    return fail(ErrorCode::Unsupported, "{}: {} can be read, not written", path.string(), name());
}

}  // namespace tacto
