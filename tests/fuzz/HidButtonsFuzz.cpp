// Whatever a descriptor says, its buttons can be read from any report, or it has none (hazard H10). The input: one byte
// for the descriptor's share of the rest (in 1/256), the descriptor, and a report, read at every length.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/hid_input/HidButtons.h"
#include "tests/fuzz/FuzzTarget.h"

namespace tacto::fuzz::HidButtonsFuzz {

TACTO_FUZZ(HidButtonsFuzz, const std::uint8_t* data, std::size_t size) {
    using namespace tacto::hid;
    if (size < 2) return 0;
    const std::span<const std::uint8_t> rest(data + 1, size - 1);
    const auto cut = rest.size() * (std::size_t{data[0]} + 1) / 256;
    const auto descriptor = parseHidDescriptor(rest.first(cut));
    if (!descriptor) return 0;
    auto buttons = HidButtons::of(*descriptor);
    if (!buttons) {
        if (buttons.error().code != tacto::ErrorCode::Unsupported || buttons.error().message.empty()) std::abort();
        return 0;
    }
    if (buttons->labels().empty() || buttons->labels().size() > HidButtons::kMaxButtons) std::abort();
    const auto report = rest.subspan(cut);
    const auto first = buttons->read(report);
    for (const auto& change : first) {
        if (change.button >= buttons->labels().size() || !change.down) std::abort();  // no button was down before
    }
    if (!buttons->read(report).empty()) std::abort();  // the same state again
    for (std::size_t length = report.size(); length > 0; --length) {
        for (const auto& change : buttons->read(report.first(length))) {
            if (change.button >= buttons->labels().size()) std::abort();
        }
    }
    return 0;
}

}  // namespace tacto::fuzz::HidButtonsFuzz
