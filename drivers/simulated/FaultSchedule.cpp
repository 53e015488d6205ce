#include "drivers/simulated/FaultSchedule.h"

#include <string>

#include "core/base/LocaleFreeText.h"
#include "core/base/Words.h"

namespace tacto::sim {

namespace {
constexpr Word<Fault> kFaults[] = {{"unplug", Fault::Unplug}, {"stale", Fault::Stale},      {"dropout", Fault::Dropout},
                                   {"nan", Fault::Nan},       {"garbage", Fault::Garbage},  {"drift", Fault::Drift},
                                   {"stuck", Fault::Stuck},   {"stuck-on", Fault::StuckOn}, {"open", Fault::Open},
                                   {"short", Fault::Short},   {"late", Fault::Late}};
constexpr double kLongest_s = 1e6;

std::optional<Instant> momentOf(std::string_view text) {
    const auto value = parseQuantity(text, "s");
    if (!value || !(*value >= 0) || !(*value <= kLongest_s)) return std::nullopt;
    return toInstant(*value);
}
}  // namespace

std::string_view nameOf(Fault fault) noexcept { return wordFor(kFaults, fault, "fault"); }

Result<void> FaultSchedule::add(std::string_view text, std::initializer_list<Fault> accepted) {
    const auto at = text.find('@');
    const auto name = text.substr(0, at);
    std::string names;
    for (const auto fault : accepted) {
        names += (names.empty() ? "" : ", ");
        names += nameOf(fault);
        if (nameOf(fault) != name) continue;
        Entry entry{fault, Instant(0), Instant::max()};
        if (at != std::string_view::npos) {
            const auto times = text.substr(at + 1);
            const auto dots = times.find("..");
            const auto from = momentOf(times.substr(0, dots));
            const auto to = dots == std::string_view::npos ? Instant::max() : momentOf(times.substr(dots + 2));
            if (!from || !to || *to <= *from) {
                return fail(ErrorCode::InvalidArgument,
                            "fault \"{}\" has no usable time: write {}@12s, or {}@12s..15s, between 0 and 1e6 s", text,
                            name, name);
            }
            entry.from = *from;
            entry.to = *to;
        }
        entries_.push_back(entry);
        return {};
    }
    return fail(ErrorCode::InvalidArgument, "fault \"{}\" is not one that this device can have: {}", text, names);
}

Result<void> FaultSchedule::plugged(std::string_view device, Instant now) const {
    for (const auto& entry : entries_) {
        if (entry.fault != Fault::Unplug || now < entry.from || now >= entry.to) continue;
        return fail(
            ErrorCode::Device, "the simulated {} is unplugged{}", device,
            entry.to == Instant::max() ? ", and is back when the bench is opened again without this fault" : "");
    }
    return {};
}

std::optional<Instant> FaultSchedule::since(Fault fault, Instant now) const noexcept {
    for (const auto& entry : entries_) {
        if (entry.fault == fault && entry.from <= now && now < entry.to) return entry.from;
    }
    return std::nullopt;
}

}  // namespace tacto::sim
