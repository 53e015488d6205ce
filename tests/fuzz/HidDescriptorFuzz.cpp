// Any descriptor of a device is read or refused, every control lies inside its report, and haptic reports made from the
// descriptor are valid (hazard H10). The input: one byte for the descriptor's share of the rest (in 1/256), the
// descriptor, and the waveform list.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/hid_massager/Haptics.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::HidDescriptorFuzz {

TACTO_FUZZ(HidDescriptorFuzz, const std::uint8_t* data, std::size_t size) {
    using namespace tacto::hid;
    if (size < 2) return 0;
    const std::span<const std::uint8_t> rest(data + 1, size - 1);
    const auto cut = rest.size() * (std::size_t{data[0]} + 1) / 256;
    const auto descriptor = parseHidDescriptor(rest.first(cut));
    if (!descriptor) {
        if (descriptor.error().code != tacto::ErrorCode::ParseError || descriptor.error().message.empty()) std::abort();
        return 0;
    }
    if (descriptor->fields.size() > kMaxFields || descriptor->collections.size() > kMaxCollections) std::abort();
    for (const auto& field : descriptor->fields) {
        const auto length = descriptor->lengthOf(field.kind, field.report);
        if (!length || field.bits < 1 || field.bits > 32 || field.bit < 8) std::abort();
        if (std::size_t{field.bit} + field.bits > 8 * *length || field.max < field.min) std::abort();
        static_cast<void>(descriptor->isInside(field.collection, usageOf(0x0E, 0x01)));
    }
    const auto controls = findHaptics(*descriptor);
    if (!controls) return 0;
    const auto reports = hapticReports(*controls, rest.subspan(cut));
    if (!reports) return 0;
    // The shortest burst; a device that ends bursts itself may refuse a longer one.
    if (!validate(*reports) || !startBytes(*reports, 0.5, tacto::Seconds(1e-4)) || startBytes(*reports, 1.5))
        std::abort();
    return 0;
}

}  // namespace tacto::fuzz::HidDescriptorFuzz
