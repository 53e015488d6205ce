#include "core/calibration/CalibrationStore.h"

#include <algorithm>

#include "core/calibration/StoredCalibrationJson.h"

namespace tacto {

StimulatorCalibration linesOf(const StoredCalibration& stored) {
    const auto known = [](const StoredLine& line) {
        CalibrationLine out = line;
        // U is stated in % of the command; what comes out may be less than that.
        double leastDelivered = 1;
        for (const double programmed : {line.lowest, line.highest})
            leastDelivered = std::min(leastDelivered, line.delivered(programmed) / programmed);
        const double relative = line.uncertainty_pct / 100 / leastDelivered;
        out.spread = line.residual ? Spread{relative, *line.residual}
                                   : Spread{std::max(relative, kUnknownSpread.relative), kUnknownSpread.absolute};
        return out;
    };
    StimulatorCalibration lines{known(stored.amplitude)};
    if (stored.interval) lines.interval = known(*stored.interval);
    if (stored.phaseWidth) lines.phaseWidth = known(*stored.phaseWidth);
    if (stored.gap) lines.gap = known(*stored.gap);
    return lines;
}

Result<CalibrationStore> CalibrationStore::open(std::filesystem::path file) {
    CalibrationStore store(std::move(file));
    if (auto done = store.read(); !done) return failure(done);
    return store;
}

Result<void> CalibrationStore::read() {
    all_.clear();
    return lines_.read([this](const nlohmann::json& body) -> Result<void> {
        auto calibration = storedCalibrationFrom(body.value("calibration", nlohmann::json()));
        if (!calibration) return failure(calibration);
        all_.push_back(std::move(*calibration));
        return {};
    });
}

Result<void> CalibrationStore::add(const StoredCalibration& calibration) {
    if (auto sane = check(calibration); !sane) return sane;
    if (auto known = checkProvenance(calibration); !known) return known;
    for (const auto& time : kStoredTimes) {
        if (calibration.*time.line) continue;
        return fail(ErrorCode::InvalidArgument, "calibration of {}: no {}; all four quantities were expected",
                    calibration.serial, time.words);
    }
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);  // another process may have added one since
        return nlohmann::json{{"calibration", toJson(calibration)}};
    });
    if (added) all_.push_back(calibration);
    return added;
}

const StoredCalibration* CalibrationStore::latest(std::string_view serial, std::string_view unit) const {
    for (auto at = all_.rbegin(); at != all_.rend(); ++at) {
        if (at->serial == serial && at->unit == unit) return &*at;
    }
    return nullptr;
}

const StoredCalibration* CalibrationStore::proven(std::string_view serial, std::string_view unit,
                                                  bool simulated) const {
    for (auto at = all_.rbegin(); at != all_.rend(); ++at) {
        if (at->serial != serial || at->unit != unit || (at->simulated && !simulated)) continue;
        if (checkProvenance(*at)) return &*at;
    }
    return nullptr;
}

Result<StoredCalibration> CalibrationStore::valid(std::string_view serial, std::string_view unit, CalibrationDate day,
                                                  bool simulated) const {
    const auto* found = latest(serial, unit);
    if (found == nullptr) {
        return fail(ErrorCode::NotFound, "stimulator {} is not calibrated in {}; a stimulator calibration is expected",
                    serial.empty() ? "without a serial" : serial, unit);
    }
    if (found->simulated && !simulated) {
        return fail(ErrorCode::NotFound,
                    "stimulator {} was calibrated on a simulated bench only, on {}; one on the "
                    "real bench is expected",
                    serial, dateText(found->made));
    }
    if (const auto known = checkProvenance(*found); !known) {
        return fail(ErrorCode::NotFound, "{}", known.error().message);
    }
    for (const auto& time : kStoredTimes) {
        if (found->*time.line) continue;
        return fail(ErrorCode::NotFound,
                    "the calibration of stimulator {} of {} is without its {}; one of amplitude, interval, phase width "
                    "and gap is expected",
                    serial, dateText(found->made), time.words);
    }
    if (day < found->made || day > found->validUntil) {
        return fail(ErrorCode::NotFound,
                    "the calibration of stimulator {} holds from {} to {} and today is {}; a newer "
                    "one is expected",
                    serial, dateText(found->made), dateText(found->validUntil), dateText(day));
    }
    return *found;
}

std::filesystem::path calibrationFile() { return labFile("calibrations.jsonl"); }

}  // namespace tacto
