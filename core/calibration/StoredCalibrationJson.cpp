#include "core/calibration/StoredCalibrationJson.h"

#include <algorithm>
#include <cmath>

namespace tacto {

using nlohmann::json;

namespace {

Result<void> checkLine(const StoredLine& line, const std::string& serial, std::string_view quantity) {
    if (auto sound = validateNumbers(line, quantity); !sound) {
        return fail(ErrorCode::InvalidArgument, "calibration of {}: {}", serial, sound.error().message);
    }
    if (!(line.uncertainty_pct > 0) || !std::isfinite(line.uncertainty_pct)) {
        return fail(ErrorCode::InvalidArgument, "calibration of {}: uncertainty of {} {} %; above 0 was expected",
                    serial, quantity, line.uncertainty_pct);
    }
    if (line.residual && !(*line.residual >= 0 && std::isfinite(*line.residual))) {
        return fail(ErrorCode::InvalidArgument, "calibration of {}: largest residual of {} {}; 0 or more was expected",
                    serial, quantity, *line.residual);
    }
    return {};
}

json toJson(const StoredLine& line) {
    json out = {{"gain", line.gain},
                {"offset", line.offset},
                {"uncertainty_pct", line.uncertainty_pct},
                {"lowest", line.lowest},
                {"highest", line.highest}};
    if (line.residual) out["residual"] = *line.residual;
    return out;
}

StoredLine lineFrom(const json& in) {
    StoredLine line;
    line.gain = in.at("gain").get<double>();
    line.offset = in.at("offset").get<double>();
    line.uncertainty_pct = in.at("uncertainty_pct").get<double>();
    line.lowest = in.at("lowest").get<double>();
    line.highest = in.at("highest").get<double>();
    if (in.contains("residual")) line.residual = in.at("residual").get<double>();
    return line;
}

bool isDigest(std::string_view text) {
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace

Result<void> checkProvenance(const StoredCalibration& c) {
    if (c.session.empty() || !isDigest(c.sessionHead) || c.readings == 0) {
        return fail(ErrorCode::InvalidArgument,
                    "the calibration of stimulator {} of {} does not say from which readings it was computed, so it is "
                    "not applied; a new calibration is expected",
                    c.serial, dateText(c.made));
    }
    const auto stated = [](const CalibrationInstrument& one) { return one.gainTolerance.value_or(0) > 0; };
    if (std::none_of(c.instruments.begin(), c.instruments.end(), stated)) {
        return fail(ErrorCode::InvalidArgument,
                    "the calibration of stimulator {} of {} rests on no instrument whose accuracy is stated, so it is "
                    "not applied; a new calibration is expected",
                    c.serial, dateText(c.made));
    }
    const auto held = std::chrono::sys_days(c.validUntil) - std::chrono::sys_days(c.made);
    if (held > kLongestValidity) {
        return fail(ErrorCode::InvalidArgument,
                    "the calibration of stimulator {} of {} claims to hold for {} days, so it is not applied; at most "
                    "{} are accepted",
                    c.serial, dateText(c.made), held.count(), kLongestValidity.count());
    }
    return {};
}

Result<void> check(const StoredCalibration& c) {
    if (c.serial.empty()) {
        return fail(ErrorCode::InvalidArgument, "a calibration without the stimulator's serial; one was expected");
    }
    if (c.unit != "V" && c.unit != "mA") {
        return fail(ErrorCode::InvalidArgument, "calibration of {}: unit '{}'; V or mA was expected", c.serial, c.unit);
    }
    if (auto sane = checkLine(c.amplitude, c.serial, "amplitude"); !sane) return sane;
    for (const auto& time : kStoredTimes) {
        if (!(c.*time.line)) continue;
        if (auto sane = checkLine(*(c.*time.line), c.serial, time.title); !sane) return sane;
    }
    if (!c.made.ok() || !c.validUntil.ok() || c.validUntil < c.made) {
        return fail(ErrorCode::InvalidArgument, "calibration of {}: valid until {}; a day from {} on was expected",
                    c.serial, c.validUntil.ok() ? dateText(c.validUntil) : "no day",
                    c.made.ok() ? dateText(c.made) : "no day");
    }
    for (const auto& instrument : c.instruments) {
        if (!instrument.due || *instrument.due >= c.made) continue;
        return fail(ErrorCode::InvalidArgument,
                    "calibration of {}: the {} {} was itself due on {}, before {}; a calibrated one was expected",
                    c.serial, instrument.name, instrument.serial, dateText(*instrument.due), dateText(c.made));
    }
    return {};
}

json toJson(const StoredCalibration& c) {
    json instruments = json::array();
    for (const auto& instrument : c.instruments) {
        instruments.push_back({{"name", instrument.name},
                               {"serial", instrument.serial},
                               {"due", instrument.due ? json(dateText(*instrument.due)) : json()},
                               {"gain_tolerance", instrument.gainTolerance ? json(*instrument.gainTolerance) : json()},
                               {"stated_by", instrument.statedBy}});
    }
    json out = toJson(c.amplitude);  // at the top: files were written so before times were kept
    out.update({{"serial", c.serial},
                {"device", c.device},
                {"unit", c.unit},
                {"made", dateText(c.made)},
                {"valid_until", dateText(c.validUntil)},
                {"simulated", c.simulated},
                {"session", c.session},
                {"session_head", c.sessionHead},
                {"readings", c.readings},
                {"instruments", instruments}});
    for (const auto& time : kStoredTimes) {
        if (c.*time.line) out[std::string(time.key)] = toJson(*(c.*time.line));
    }
    return out;
}

Result<StoredCalibration> storedCalibrationFrom(const json& in) {
    StoredCalibration c;
    const auto date = [](const json& value) {
        return value.is_string() ? parseDate(value.get<std::string>()) : std::nullopt;
    };
    try {
        c.serial = in.at("serial").get<std::string>();
        c.device = in.at("device").get<std::string>();
        c.unit = in.at("unit").get<std::string>();
        c.amplitude = lineFrom(in);
        for (const auto& time : kStoredTimes) {
            if (in.contains(time.key)) c.*time.line = lineFrom(in.at(time.key));
        }
        c.simulated = in.at("simulated").get<bool>();
        c.session = in.at("session").get<std::string>();
        // Lines of older versions have neither: they are read, and not applied.
        c.sessionHead = in.value("session_head", "");
        c.readings = in.value("readings", std::size_t{0});
        const auto made = date(in.at("made")), until = date(in.at("valid_until"));
        if (!made || !until) return fail(ErrorCode::ParseError, "made or valid_until is no date such as 2026-11-21");
        c.made = *made;
        c.validUntil = *until;
        for (const auto& entry : in.at("instruments")) {
            CalibrationInstrument instrument{entry.at("name").get<std::string>(), entry.at("serial").get<std::string>(),
                                             date(entry.at("due"))};
            if (!instrument.due && !entry.at("due").is_null()) {
                return fail(ErrorCode::ParseError, "an instrument's due is no date such as 2026-11-21");
            }
            const json tolerance = entry.value("gain_tolerance", json());
            if (!tolerance.is_null()) instrument.gainTolerance = tolerance.get<double>();
            instrument.statedBy = entry.value("stated_by", "");
            c.instruments.push_back(std::move(instrument));
        }
    } catch (const json::exception& wrong) {
        return fail(ErrorCode::ParseError, "{}", wrong.what());
    }
    if (auto sane = check(c); !sane) return failure(sane);
    return c;
}

}  // namespace tacto
