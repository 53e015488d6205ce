#include "drivers/hid_massager/MassagerTemplate.h"

#include <algorithm>

namespace tacto::hid {

const TemplateDevice* MassagerTemplate::deviceOf(std::uint16_t vendor, std::uint16_t product) const noexcept {
    const auto found = std::ranges::find_if(
        devices, [&](const TemplateDevice& device) { return device.vendor == vendor && device.product == product; });
    return found == devices.end() ? nullptr : &*found;
}

Result<VibrationReports> MassagerTemplate::reports(std::size_t length) const {
    if (std::ranges::find(lengths, length) == lengths.end()) {
        return fail(ErrorCode::InvalidArgument, "a report of {} bytes; {} describes one of {}", length, title,
                    fmt::join(lengths, " or "));
    }
    VibrationReports made;
    made.start.assign(length, 0);
    made.start[0] = report;
    for (const auto& constant : constants) {
        if (constant.byte + constant.value.size() > length) {
            return fail(ErrorCode::InvalidArgument, "the constant at byte {} ends behind the report of {} bytes",
                        constant.byte, length);
        }
        std::ranges::copy(constant.value, made.start.begin() + static_cast<std::ptrdiff_t>(constant.byte));
    }
    made.fields = fields;
    made.keepAlive = keepAlive;
    made.shortestWrite = shortestWrite;
    made.stop = made.start;
    if (stop) {
        if (stop->size() > length) {
            return fail(ErrorCode::InvalidArgument,
                        "the stop report has {} bytes; at most {} are accepted, the length of a report", stop->size(),
                        length);
        }
        std::ranges::fill(made.stop, std::uint8_t{0});
        std::ranges::copy(*stop, made.stop.begin());
    }
    if (auto sound = validate(made); !sound) return failure(sound);
    if (!stop) {
        for (const auto& field : fields) setValue(field, 0, made.stop);
    }
    return made;
}

Result<VibrationReports> MassagerTemplate::reportsFor(const HidDescriptor& descriptor) const {
    const auto length = descriptor.lengthOf(ReportKind::Output, report);
    if (!length) {
        return fail(ErrorCode::Unsupported,
                    "its descriptor has no output report {}, which {} needs; it may be connected another way", report,
                    title);
    }
    if (std::ranges::find(lengths, *length) == lengths.end()) {
        return fail(ErrorCode::Unsupported, "its output report {} has {} bytes; {} describes one of {}", report,
                    *length, title, fmt::join(lengths, " or "));
    }
    return reports(*length);
}

}  // namespace tacto::hid
