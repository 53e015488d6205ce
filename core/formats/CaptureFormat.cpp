#include "core/formats/CaptureFormat.h"

#include <fmt/format.h>
#include <limits>
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

std::string noValueWarning(std::string_view file, std::string_view name, std::size_t count) {
    return fmt::format("{}: {} of '{}' {} 9.9E+37 or the like, SCPI's mark of no value, and so missing", file,
                       count == 1 ? "a sample" : fmt::format("{} samples", count), name, count == 1 ? "is" : "are");
}

void dropNoValues(CaptureReading& reading, std::string_view file) {
    for (auto& channel : reading.capture.channels) {
        std::size_t count = 0;
        for (float& sample : channel.samples) {
            if (!isNoValue(static_cast<double>(sample))) continue;
            sample = std::numeric_limits<float>::quiet_NaN();
            ++count;
        }
        if (count > 0) reading.warnings.push_back(noValueWarning(file, channel.name, count));
    }
}

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
    } catch (const std::length_error&) {  // larger than any memory
        return doesNotFit(file);
    }
}

Result<void> CaptureFormat::write(const std::filesystem::path& path, const Capture& /*capture*/) const {
    return fail(ErrorCode::Unsupported, "{}: {} can be read, not written", path.string(), name());
}

}  // namespace tacto
