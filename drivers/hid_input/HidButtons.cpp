#include "drivers/hid_input/HidButtons.h"

#include <algorithm>
#include <optional>

namespace tacto::hid {

namespace {

constexpr std::uint16_t kButtonPage = 0x09;
constexpr Usage kButtonUsages[] = {usageOf(0x01, 0x04), usageOf(0x01, 0x05), usageOf(0x01, 0x08), usageOf(0x0C, 0x03)};

/// Returns the outermost collection around `collection`, or kNoCollection.
std::uint16_t outermost(const HidDescriptor& descriptor, std::uint16_t collection) {
    while (collection != kNoCollection && descriptor.collections[collection].parent != kNoCollection)
        collection = descriptor.collections[collection].parent;
    return collection;
}

}  // namespace

bool isButtonUsage(Usage usage) noexcept { return std::ranges::find(kButtonUsages, usage) != std::end(kButtonUsages); }

bool hasButtonUsage(const HidDescriptor& descriptor) noexcept {
    return std::ranges::any_of(descriptor.collections, [](const HidCollection& one) {
        return one.parent == kNoCollection && isButtonUsage(one.usage);
    });
}

Result<HidButtons> HidButtons::of(const HidDescriptor& descriptor) {
    struct Button {
        std::uint16_t pad = 0;
        Usage usage = 0;
        bool operator==(const Button&) const = default;
    };
    std::vector<std::uint16_t> pads;
    std::vector<Button> found;
    HidButtons buttons;
    std::size_t others = 0;
    for (const auto& report : descriptor.reports) {
        if (report.number != 0) buttons.numbered_ = true;
    }
    for (const auto& field : descriptor.fields) {
        if (field.kind != ReportKind::Input) continue;
        const auto pad = outermost(descriptor, field.collection);
        if (pad == kNoCollection || !isButtonUsage(descriptor.collections[pad].usage)) continue;
        if (field.bits != 1 || field.array || pageOf(field.usage) != kButtonPage) {
            ++others;
            continue;
        }
        if (std::ranges::find(pads, pad) == pads.end()) pads.push_back(pad);
        const Button button{pad, field.usage};
        auto at = std::ranges::find(found, button);
        if (at == found.end()) {
            if (found.size() == kMaxButtons)
                return fail(ErrorCode::Unsupported, "it has more than {} buttons; 1 to {} are accepted", kMaxButtons,
                            kMaxButtons);
            found.push_back(button);
            at = std::prev(found.end());
            const auto number = std::ranges::find(pads, pad) - pads.begin() + 1;
            buttons.labels_.push_back(number == 1 ? std::to_string(idOf(field.usage))
                                                  : fmt::format("{}-{}", number, idOf(field.usage)));
        }
        buttons.bits_.push_back({field.report, field.bit, static_cast<std::size_t>(at - found.begin())});
    }
    if (found.empty())
        return fail(ErrorCode::Unsupported,
                    "it has {} other inputs and no button; inputs of one bit on the HID page 0x09 are accepted",
                    others);
    for (const auto& report : descriptor.reports) {
        if (report.kind != ReportKind::Input) continue;
        const auto length = descriptor.lengthOf(ReportKind::Input, report.number).value_or(0);
        buttons.lengths_.push_back({report.number, length});
        buttons.longest_ = std::max(buttons.longest_, length);
    }
    buttons.down_.resize(found.size());
    return buttons;
}

std::vector<HidButtons::Change> HidButtons::read(std::span<const std::uint8_t> report) {
    if (report.empty()) return {};
    const std::uint8_t number = numbered_ ? report[0] : 0;
    const std::size_t ahead = numbered_ ? 0 : 8;  // bits of the number byte, which is missing here
    const auto length = std::ranges::find(lengths_, number, &Length::report);
    if (length == lengths_.end() || report.size() + ahead / 8 < length->bytes) return {};
    std::vector<std::optional<bool>> now(down_.size());
    for (const auto& bit : bits_) {
        if (bit.report != number) continue;
        const std::size_t at = bit.bit - ahead;
        const bool set = (report[at / 8] >> (at % 8) & 1) != 0;
        now[bit.button] = set || now[bit.button].value_or(false);
    }
    std::vector<Change> changes;
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (!now[i] || *now[i] == down_[i]) continue;
        down_[i] = *now[i];
        changes.push_back({i, *now[i]});
    }
    return changes;
}

void HidButtons::forget() { down_.assign(down_.size(), false); }

}  // namespace tacto::hid
