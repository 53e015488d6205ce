#include "drivers/hid_massager/Haptics.h"

#include <algorithm>
#include <cmath>

namespace tacto::hid {

namespace {

constexpr std::uint16_t kHapticsPage = 0x0E;
constexpr std::uint16_t kOrdinalPage = 0x0A;
constexpr Usage kController = usageOf(kHapticsPage, 0x01);
constexpr Usage kWaveformList = usageOf(kHapticsPage, 0x10);
constexpr Usage kDurationList = usageOf(kHapticsPage, 0x11);
constexpr Usage kManualTrigger = usageOf(kHapticsPage, 0x21);
constexpr Usage kIntensity = usageOf(kHapticsPage, 0x23);
constexpr Usage kRepeatCount = usageOf(kHapticsPage, 0x24);
constexpr Usage kRetriggerPeriod = usageOf(kHapticsPage, 0x25);
constexpr Usage kCutoffTime = usageOf(kHapticsPage, 0x28);

constexpr std::int64_t kStopOrdinal = 2;
constexpr std::uint16_t kFirstOwnOrdinal = 3;
constexpr std::int64_t kStopWaveform = 0x1002;  // the waveform that stops; 0x1001 is "none"
constexpr std::int64_t kBuzzContinuous = 0x1004;
constexpr std::int64_t kRumbleContinuous = 0x1005;
constexpr std::int64_t kFirstInkContinuous = 0x100B;  // up to 0x1011: pen waveforms, which also last until stopped
constexpr std::int64_t kLastInkContinuous = 0x1011;
constexpr Seconds kMillisecond{0.001};
constexpr std::int64_t kMaxPlay_ms = 1000;  // the longest burst

ReportField plain(const HidField& field) {
    return {field.bit, field.bits, ByteOrder::Little, field.min, field.max, VibrationRole::Intensity};
}

bool holds(const HidField& field, std::int64_t value) noexcept {
    const bool isSigned = field.min < 0;
    const std::int64_t high = (std::int64_t{1} << (field.bits - (isSigned ? 1 : 0))) - 1;
    return value >= 0 && value <= high;
}

bool lasts(std::int64_t waveform) noexcept { return waveform == kBuzzContinuous || waveform == kRumbleContinuous; }

/// True for a waveform that ends by itself.
bool isFinite(std::int64_t waveform) noexcept {
    return waveform > kStopWaveform && !lasts(waveform) &&
           !(waveform >= kFirstInkContinuous && waveform <= kLastInkContinuous);
}

/// Collects the controls of one controller.
std::optional<HapticControls> controlsOf(const HidDescriptor& descriptor, std::uint16_t controller) {
    const auto ours = [&](const HidField& field) {
        return !field.array && descriptor.enclosing(field.collection, kController) == controller;
    };
    const auto output = [&](Usage usage, std::optional<std::uint8_t> report) -> std::optional<HidField> {
        for (const auto& field : descriptor.fields) {
            if (ours(field) && field.kind == ReportKind::Output && field.usage == usage &&
                (!report || field.report == *report)) {
                return field;
            }
        }
        return std::nullopt;
    };
    const auto trigger = output(kManualTrigger, std::nullopt);
    if (!trigger) return std::nullopt;
    const auto intensity = output(kIntensity, trigger->report);
    if (!intensity) return std::nullopt;
    HapticControls found;
    found.report = trigger->report;
    found.length = *descriptor.lengthOf(ReportKind::Output, found.report);
    found.trigger = *trigger;
    found.intensity = *intensity;
    found.repeatCount = output(kRepeatCount, found.report);
    found.retriggerPeriod = output(kRetriggerPeriod, found.report);
    found.cutoffTime = output(kCutoffTime, found.report);
    for (const auto& field : descriptor.fields) {
        if (!ours(field) || field.kind != ReportKind::Feature || pageOf(field.usage) != kOrdinalPage) continue;
        if (!descriptor.isInside(field.collection, kWaveformList) || idOf(field.usage) < kFirstOwnOrdinal) continue;
        if (found.waveforms.empty()) found.listReport = field.report;
        if (field.report == found.listReport) found.waveforms.push_back({idOf(field.usage), field, std::nullopt});
    }
    for (const auto& field : descriptor.fields) {
        if (!ours(field) || field.kind != ReportKind::Feature || field.report != found.listReport) continue;
        if (pageOf(field.usage) != kOrdinalPage || !descriptor.isInside(field.collection, kDurationList)) continue;
        const auto entry = std::ranges::find(found.waveforms, idOf(field.usage), &HapticControls::Entry::ordinal);
        if (entry != found.waveforms.end()) entry->duration = field;
    }
    if (found.waveforms.empty()) return std::nullopt;
    std::ranges::stable_sort(found.waveforms, {}, &HapticControls::Entry::ordinal);
    found.listLength = *descriptor.lengthOf(ReportKind::Feature, found.listReport);
    return found;
}

}  // namespace

Result<HapticControls> findHaptics(const HidDescriptor& descriptor) {
    bool any = false;
    for (std::size_t i = 0; i < descriptor.collections.size(); ++i) {
        if (descriptor.collections[i].usage != kController) continue;
        any = true;
        if (auto found = controlsOf(descriptor, static_cast<std::uint16_t>(i))) return std::move(*found);
    }
    if (!any) return fail(ErrorCode::Unsupported, "its report descriptor has no haptic controller (usage 0E:01)");
    return fail(ErrorCode::Unsupported,
                "its haptic controller has no output report with manual trigger (0E:21) and intensity (0E:23), or no "
                "waveform list (0E:10) with ordinals from 3");
}

Result<VibrationReports> hapticReports(const HapticControls& controls, std::span<const std::uint8_t> list) {
    if (list.size() < controls.listLength) {
        return fail(ErrorCode::ParseError, "its waveform list came with {} bytes; {} were expected", list.size(),
                    controls.listLength);
    }
    const HapticControls::Entry* lasting = nullptr;
    const HapticControls::Entry* finite = nullptr;
    Seconds playTime{0};  // time for which the device plays the finite effect
    std::vector<std::string> present;
    for (const auto& entry : controls.waveforms) {
        const auto waveform = valueOf(plain(entry.waveform), list);
        present.push_back(fmt::format("{:04x}", waveform));
        if (!holds(controls.trigger, entry.ordinal)) continue;
        if (lasts(waveform) && lasting == nullptr) lasting = &entry;
        if (!isFinite(waveform) || finite != nullptr || !entry.duration) continue;
        if (!controls.repeatCount || controls.repeatCount->max < 0) continue;
        const auto milliseconds = valueOf(plain(*entry.duration), list);
        if (milliseconds <= 0 || milliseconds > kMaxPlay_ms ||
            (controls.retriggerPeriod && !holds(*controls.retriggerPeriod, milliseconds)))
            continue;
        finite = &entry;
        playTime = kMillisecond * static_cast<double>(milliseconds);
    }
    if (lasting == nullptr && finite == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "its waveforms are {}; one that lasts until it is stopped is needed, 1004 (buzz) or 1005 (rumble), "
                    "or one with a duration that can be repeated",
                    fmt::join(present, ", "));
    }
    if (!holds(controls.trigger, kStopOrdinal)) {
        return fail(ErrorCode::Unsupported, "its manual trigger has {} bits, too few for the stop (ordinal 2)",
                    controls.trigger.bits);
    }
    VibrationReports reports;
    reports.start.assign(controls.length, 0);
    reports.start[0] = controls.report;
    reports.stop = reports.start;
    if (lasting != nullptr && controls.cutoffTime && controls.cutoffTime->max > 0) {
        setValue(plain(controls.trigger), lasting->ordinal, reports.start);
        reports.ends = DurationField{plain(*controls.cutoffTime), kMillisecond, 0};
    } else if (finite != nullptr) {
        setValue(plain(controls.trigger), finite->ordinal, reports.start);
        if (controls.retriggerPeriod) {
            setValue(plain(*controls.retriggerPeriod), std::llround(playTime / kMillisecond), reports.start);
        }
        reports.ends = DurationField{plain(*controls.repeatCount), playTime, 1};
    } else {
        setValue(plain(controls.trigger), lasting->ordinal, reports.start);
    }
    setValue(plain(controls.trigger), kStopOrdinal, reports.stop);
    reports.fields.push_back(plain(controls.intensity));
    if (auto sound = validate(reports); !sound) {
        return fail(ErrorCode::Unsupported, "its haptic report cannot be used: {}", sound.error().message);
    }
    return reports;
}

}  // namespace tacto::hid
