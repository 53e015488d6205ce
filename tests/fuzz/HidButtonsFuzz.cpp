// Whatever a descriptor says, its buttons are read from any report or none are (hazard H10). The input: one byte, how
// much of the rest is the descriptor (in 1/256); what remains is one report, read whole and then byte by byte shorter.
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
        if (change.button >= buttons->labels().size() || !change.down) std::abort();  // all buttons were up
    }
    if (!buttons->read(report).empty()) std::abort();  // the same state once more
    for (std::size_t length = report.size(); length > 0; --length) {
        for (const auto& change : buttons->read(report.first(length))) {
            if (change.button >= buttons->labels().size()) std::abort();
        }
    }
    return 0;
}

}  // namespace tacto::fuzz::HidButtonsFuzz
