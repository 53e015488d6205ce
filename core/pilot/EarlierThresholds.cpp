#include "core/pilot/EarlierThresholds.h"

#include <algorithm>
#include <cmath>

#include "core/base/JsonFields.h"
#include "core/pilot/PilotRecord.h"

namespace tacto {

namespace {

constexpr double kImpedanceAgrees = 0.3;
constexpr std::string_view kThresholds = "pilot-thresholds";

/// The body of the last event of `kind` with that name; null where there is none.
const nlohmann::json* lastEvent(const std::vector<SessionRow>& events, std::string_view kind, std::string_view name) {
    const nlohmann::json* found = nullptr;
    for (const auto& event : events) {
        if (event.name == kind && textOr(event.body, "name") == name) found = &event.body;
    }
    return found;
}

std::string deviceText(const std::string& name, const std::string& serial) {
    return serial.empty() ? name : name + " " + serial;
}

}  // namespace

Result<StudySession> thresholdsSession(const std::vector<StudySession>& sessions, std::string_view participant) {
    const StudySession* last = nullptr;
    for (const auto& each : sessions) {
        if (each.participant == participant && each.opened) last = &each;
    }
    if (last == nullptr) return fail(ErrorCode::NotFound, "there is no earlier session");
    if (last->protocol != kThresholds)
        return fail(ErrorCode::NotFound, "the last session was of {}; one of {} is expected", last->protocol,
                    kThresholds);
    if (last->state != StudySessionState::Complete)
        return fail(ErrorCode::NotFound, "the session of {} did not come to its end", kThresholds);
    return *last;
}

Result<EarlierThresholds> earlierThresholds(const std::vector<SessionRow>& events, LevelUnit unit) {
    const auto missing = [](std::string_view what) {
        return fail(ErrorCode::NotFound, "the earlier session has no {}; the thresholds are measured again", what);
    };
    EarlierThresholds found;
    found.unit = unit;
    const auto* end = lastEvent(events, row::kSessionEnd, "end");
    if (end == nullptr || textOr(*end, "state") != "complete") return missing("end");
    const auto* estimate = lastEvent(events, row::kEstimate, "detection");
    if (estimate != nullptr) found.detection = numberOr(valueOr(*estimate, "estimate"), "value");
    if (!(found.detection > 0)) return missing("detection threshold");
    const auto* range = lastEvent(events, row::kRange, "range");
    if (range == nullptr || !flagOr(*range, "usable")) return missing("usable range");
    found.min = numberOr(*range, levelKey("min", unit).c_str());
    found.max = numberOr(*range, levelKey("max", unit).c_str());
    if (!(found.min > 0 && found.max > found.min)) return missing("usable range");
    if (unit == LevelUnit::Current) {
        found.impedance_ohm = numberOr(*range, "impedance_ohm");
        if (!(found.impedance_ohm > 0)) return missing("impedance");
    }
    double before = kNaN, series = kNaN;
    for (const auto& event : events) {
        if (event.name != row::kAnswer) continue;
        if (numberOr(event.body, "series") != series) before = kNaN;
        series = numberOr(event.body, "series");
        const double level = numberOr(event.body, std::string(nameOf(unit)).c_str());
        if (level > 0) before = level;
        // An empty presentation counts for the level before it in its series, as when it was answered.
        if (textOr(event.body, "response") == "too-strong" && before > 0)
            found.tooStrong = std::min(found.tooStrong.value_or(before), before);
    }
    if (found.tooStrong && !(found.max < *found.tooStrong)) return missing("range below what was too strong");
    return found;
}

Result<void> stillHold(const EarlierThresholds& found, const ThresholdsNow& now) {
    const bool massager = found.unit == LevelUnit::Intensity;
    if (now.unit != found.unit) {
        return fail(kGateRefused, "the thresholds were measured in {}; {} is used now, and they are measured again",
                    nameOf(found.unit), nameOf(now.unit));
    }
    const auto ago = now.at - found.endedAt;
    if (!(ago >= std::chrono::seconds(0) && ago <= kThresholdsHold)) {
        return fail(kGateRefused, "the thresholds were measured {:.0f} min ago; at most {} min are accepted",
                    std::chrono::duration<double, std::ratio<60>>(ago).count(), kThresholdsHold.count());
    }
    if (now.device != found.device || now.serial != found.serial) {
        return fail(kGateRefused, "the thresholds were measured with {} and {} is connected; the former is expected",
                    deviceText(found.device, found.serial), deviceText(now.device, now.serial));
    }
    if (!now.untouched) {
        return fail(kGateRefused, "the {} touched since the thresholds were measured; they are measured again",
                    massager ? "massager was" : "electrodes were");
    }
    if (massager || std::abs(now.impedance_ohm - found.impedance_ohm) / found.impedance_ohm <= kImpedanceAgrees)
        return {};
    return fail(kGateRefused,
                "the electrodes measure {:.0f} ohm after {:.0f} ohm; a change of at most 30 % is accepted, so the "
                "thresholds are measured again",
                now.impedance_ohm, found.impedance_ohm);
}

}  // namespace tacto
