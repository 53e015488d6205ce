#include "core/calibration/StoredCalibrationJson.h"

#include <algorithm>
#include <cmath>

#include "core/base/Hex.h"
#include "core/base/RecordFields.h"

namespace tacto {

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

/// The keys of a line, whose members are those of the line that `line` leads to.
template <class Record, class Line>
void addLine(RecordFields<Record>& fields, Line line) {
    fields.number("gain", in(line, &StoredLine::gain)).required = true;
    fields.number("offset", in(line, &StoredLine::offset)).required = true;
    fields.number("uncertainty_pct", in(line, &StoredLine::uncertainty_pct)).required = true;
    fields.number("lowest", in(line, &StoredLine::lowest)).required = true;
    fields.number("highest", in(line, &StoredLine::highest)).required = true;
    fields.number("residual", in(line, &StoredLine::residual)).leftOutIfEmpty = true;
}

RecordFields<StoredCalibration> buildCalibrationFields() {
    using C = StoredCalibration;
    using I = CalibrationInstrument;
    constexpr AcceptedText kAnyText{.mayBeEmpty = true};
    RecordFields<I> instrument;
    instrument.text("name", &I::name, kAnyText).required = true;
    instrument.text("serial", &I::serial, kAnyText).required = true;
    instrument.add("due", &I::due, dateKind()).required = true;
    instrument.number("gain_tolerance", &I::gainTolerance);
    instrument.text("stated_by", &I::statedBy, kAnyText);
    instrument.passOverUnknownKeys();  // a later version may know more
    RecordFields<StoredLine> line;
    addLine(line, std::identity{});
    line.passOverUnknownKeys();

    RecordFields<C> all;
    all.text("serial", &C::serial, kAnyText).required = true;
    all.text("device", &C::device, kAnyText).required = true;
    all.text("unit", &C::unit, kAnyText).required = true;
    addLine(all, &C::amplitude);  // at the top: files were written so before times were kept
    for (const auto& time : kStoredTimes) all.record(time.id, time.line, line).leftOutIfEmpty = true;
    all.add("made", &C::made, dateKind()).required = true;
    all.add("valid_until", &C::validUntil, dateKind()).required = true;
    all.flag("simulated", &C::simulated).required = true;
    all.text("session", &C::session, kAnyText).required = true;
    // Lines of older versions have neither: they are read, and not applied.
    all.text("session_head", &C::sessionHead, kAnyText);
    all.number("readings", &C::readings);
    all.list("instruments", &C::instruments, instrument.kind(), 0, 10'000).required = true;
    all.passOverUnknownKeys();
    all.rule([](const C& calibration) { return check(calibration); });
    return all;
}

const RecordFields<StoredCalibration>& calibrationFields() {
    static const auto fields = buildCalibrationFields();
    return fields;
}

}  // namespace

Result<void> checkProvenance(const StoredCalibration& c) {
    if (c.session.empty() || !isSha256(c.sessionHead) || c.readings == 0) {
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
    if (auto sane = checkLine(c.amplitude, c.serial, kCalibratedAmplitude.words); !sane) return sane;
    for (const auto& time : kStoredTimes) {
        if (!(c.*time.line)) continue;
        if (auto sane = checkLine(*(c.*time.line), c.serial, time.words); !sane) return sane;
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

nlohmann::json toJson(const StoredCalibration& calibration) { return calibrationFields().write(calibration); }

Result<StoredCalibration> storedCalibrationFrom(const nlohmann::json& json) {
    return calibrationFields().read(json, {});
}

}  // namespace tacto
