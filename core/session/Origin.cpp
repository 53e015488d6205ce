#include "core/session/Origin.h"

#include <algorithm>
#include <fmt/format.h>

#include "core/base/JsonText.h"
#include "core/dsp/RoughnessFlags.h"
#include "core/session/SessionReader.h"

namespace tacto {

namespace {

std::string nounOf(const SessionDevice& device) { return device.is(Role::Sensor) ? "fingertip sensor" : device.role; }

std::string named(const SessionDevice& device) {
    auto text = nounOf(device);
    if (!device.name.empty()) text += " " + device.name;
    if (!device.serial.empty()) text += " " + device.serial;
    return text;
}

std::string deliveredText(const Delivered& delivered) {
    auto text = fmt::format(", which delivered {} {}", delivered.trains, delivered.trains == 1 ? "train" : "trains");
    if (delivered.trains > 0 && !delivered.unit.empty())
        text += fmt::format(" of up to {:.3g} {}", delivered.most, delivered.unit);
    if (delivered.checks > 0)
        text += fmt::format(" and {} impedance {}", delivered.checks, delivered.checks == 1 ? "check" : "checks");
    return text;
}

bool isOutput(const SessionDevice& device) { return device.is(Role::Stimulator) || device.is(Role::Massager); }

}  // namespace

std::string originOf(const SessionDevice& device) {
    if (!device.origin.empty()) return device.origin;
    if (device.simulated) return origin::kSimulated;
    const bool isReplayed = device.uri.starts_with("recording:") || device.uri.starts_with("capture:");
    return isReplayed ? origin::kReplayedUnknown : origin::kHardware;
}

Result<Delivered> deliveredIn(const SessionReader& session, const std::function<void(const SessionRow&)>& also) {
    if (session.locked())
        return fail(ErrorCode::Unsupported,
                    "what the session delivered is sealed; it opens with the study's passphrase");
    Delivered delivered;
    constexpr std::string_view kCheck = "impedance check", kTrain = "delivered";
    const auto count = [&](const SessionRow& row) {
        if (row.name == kCheck) {
            ++delivered.checks;
            return;
        }
        ++delivered.trains;
        if (also) also(row);
        for (const auto& [key, unit] : {std::pair("amplitude_ma", "mA"), std::pair("amplitude_v", "V")}) {
            const auto amplitude = row.body.find(key);
            if (amplitude == row.body.end() || !amplitude->is_number()) continue;
            delivered.unit = unit;
            delivered.most = std::max(delivered.most, amplitude->get<double>());
        }
    };
    const auto read =
        session.forEachCommand(count, [&](std::string_view name) { return name == kCheck || name == kTrain; });
    if (!read) return failure(read);
    return delivered;
}

std::vector<std::string> originMarks(const SessionAbout& about, const Delivered& delivered) {
    std::vector<std::string> simulated, real, marks;
    std::vector<const SessionDevice*> replayed;
    for (const auto& device : about.devices) {
        const auto from = originOf(device);
        if (from == origin::kSimulated)
            simulated.push_back("the " + nounOf(device));
        else if (from == origin::kHardware)
            real.push_back(named(device) + (isOutput(device) ? deliveredText(delivered) : ""));
        else
            replayed.push_back(&device);
    }
    const bool allSimulated = std::ranges::all_of(about.devices, [](const SessionDevice& device) {
        const auto from = originOf(device);
        return from == origin::kSimulated || from == origin::kReplayedSimulated;
    });
    if (allSimulated) {
        if (about.simulated || !about.devices.empty())
            marks.emplace_back("SIMULATED: no number here was measured on hardware.");
        return marks;
    }
    if (simulated.empty() && replayed.empty()) return marks;
    if (!simulated.empty()) marks.push_back(fmt::format("SIMULATED: {}.", fmt::join(simulated, ", ")));
    if (!real.empty()) marks.push_back(fmt::format("Real: {}.", fmt::join(real, "; ")));
    for (const auto* device : replayed) {
        const auto from = originOf(*device);
        const char* what = from == origin::kReplayedMeasured    ? "which says that it was measured"
                           : from == origin::kReplayedSimulated ? "which was simulated"
                                                                : "which does not say whether it was measured";
        marks.push_back(fmt::format("Replayed: the {} from {}, {}.", nounOf(*device), device->uri, what));
    }
    return marks;
}

nlohmann::json devicesJson(const std::vector<SessionDevice>& all) {
    auto devices = nlohmann::json::array();
    for (const auto& device : all) {
        const auto from = originOf(device);
        devices.push_back(
            {{"role", device.role},
             {"name", device.name},
             {"serial", device.serial},
             {"simulated", from == origin::kReplayedUnknown ? nlohmann::json() : nlohmann::json(device.simulated)},
             {"origin", from}});
    }
    return devices;
}

namespace {

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

/// The uncertainty of R has a meaning only for a calibrated rig.
std::string uncertaintyText(const RecordedMarks& recorded) {
    const auto& u = recorded.uncertaintyOfR;
    if (u.empty()) return "The uncertainty of R is not known.";
    return fmt::format("U of R (95 %, one slide): {:.2g} at R 0, {:.2g} at R 0.5, {:.2g} at R 1.", u[0], u[1], u[2]);
}

}  // namespace

RecordedMarks recordedMarks(const std::vector<SessionRow>& events) {
    RecordedMarks out;
    std::vector<std::string> early;
    for (const auto& row : events) {
        if (row.name == kMarkEvent) addOnce(early, textOr(row.body, "text"));
        if (row.name == kMeasuredBeyondEvent && out.measuredBeyond.empty())
            out.measuredBeyond = textOr(row.body, "text");
        if (row.name != kMarksEvent) continue;
        out.complete = true;
        for (const auto& flag : textsOr(row.body, "flags")) addOnce(out.flags, flag);
        if (const auto calibrated = valueOr(row.body, "stimulator_calibrated"); calibrated.is_boolean())
            out.stimulatorCalibrated = calibrated.get<bool>() && out.stimulatorCalibrated.value_or(true);
        out.uncertaintyOfR = uncertaintyIn(row);
    }
    if (!out.complete) out.flags = std::move(early);
    return out;
}

Result<std::vector<std::string>> sessionMarks(const SessionReader& session) {
    const auto delivered = deliveredIn(session);
    if (!delivered) return failure(delivered);
    return sessionMarks(session, *delivered);
}

Result<std::vector<std::string>> sessionMarks(const SessionReader& session, const Delivered& delivered) {
    const auto events = session.events();
    if (!events) return failure(events);
    const auto& about = session.about();
    auto marks = originMarks(about, delivered);
    const auto recorded = recordedMarks(*events);
    const auto measured = session.measurements();
    if (!measured) return failure(measured);
    const bool calibrates = std::ranges::find(*measured, kCalibrationMeasurement, &SessionRow::name) != measured->end();
    if (recorded.stimulatorCalibrated == false)
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
