#include "core/session/Marks.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/JsonFields.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

/// What the session's benches wrote.
struct Recorded {
    std::vector<std::string> flags;
    bool complete = false;
    bool uncalibratedStimulator = false;
    std::string measuredBeyond;          ///< the first; empty: none was seen
    std::vector<double> uncertaintyOfR;  ///< U at R 0, 0.5 and 1; empty: not known
};

void addOnce(std::vector<std::string>& all, const std::string& one) {
    if (std::ranges::find(all, one) == all.end()) all.push_back(one);
}

std::vector<double> uncertaintyIn(const SessionRow& row) {
    std::vector<double> out;
    for (const auto& one : valueOr(row.body, "R_expanded_uncertainty")) {
        if (one.is_number()) out.push_back(one.get<double>());
    }
    return out.size() == 3 ? out : std::vector<double>{};
}

/// R of a rig that is calibrated carries an uncertainty, or says that it has none; of another it would mean nothing.
std::string uncertaintyText(const Recorded& recorded) {
    const auto& u = recorded.uncertaintyOfR;
    if (u.empty()) return "The uncertainty of R is not known.";
    return fmt::format("U of R (95 %, one slide): {:.2g} at R 0, {:.2g} at R 0.5, {:.2g} at R 1.", u[0], u[1], u[2]);
}

Recorded recordedIn(const std::vector<SessionRow>& events) {
    Recorded out;
    std::vector<std::string> early;
    for (const auto& row : events) {
        if (row.name == kMarkEvent) addOnce(early, textOr(row.body, "text"));
        if (row.name == kMeasuredBeyondEvent && out.measuredBeyond.empty())
            out.measuredBeyond = textOr(row.body, "text");
        if (row.name != kMarksEvent) continue;
        out.complete = true;
        for (const auto& flag : textsOr(row.body, "flags")) addOnce(out.flags, flag);
        if (valueOr(row.body, "stimulator_calibrated") == false) out.uncalibratedStimulator = true;
        out.uncertaintyOfR = uncertaintyIn(row);
    }
    if (!out.complete) out.flags = std::move(early);
    return out;
}

}  // namespace

Result<std::vector<std::string>> sessionMarks(const SessionReader& session) {
    const auto delivered = deliveredIn(session);
    if (!delivered) return failure(delivered);
    const auto events = session.events();
    if (!events) return failure(events);
    const auto& about = session.about();
    auto marks = originMarks(about, *delivered);
    const auto recorded = recordedIn(*events);
    const auto measured = session.measurements();
    if (!measured) return failure(measured);
    const bool calibrates = std::ranges::find(*measured, kCalibrationMeasurement, &SessionRow::name) != measured->end();
    if (recorded.uncalibratedStimulator)
        marks.emplace_back(calibrates ? kNotCalibratedBefore : "The stimulator is not calibrated.");
    if (!recorded.measuredBeyond.empty()) marks.push_back(recorded.measuredBeyond);
    marks.insert(marks.end(), recorded.flags.begin(), recorded.flags.end());
    const bool felt = std::ranges::any_of(about.devices, [](const auto& device) { return device.is(Role::Sensor); });
    const bool uncalibrated =
        std::ranges::find(recorded.flags, nameOf(RoughnessFlag::UncalibratedR)) != recorded.flags.end();
    if (felt && recorded.complete && !uncalibrated) marks.push_back(uncertaintyText(recorded));
    if (felt) marks.emplace_back(kKnownLimitOfR);
    if (!recorded.complete) {
        marks.emplace_back(
            session.closed()
                ? "Marks were not recorded: whether R and the stimulator were calibrated, and the flags of "
                  "the recording, are not known."
                : "The session was not closed: its marks may not be complete.");
    }
    return marks;
}

}  // namespace tacto
