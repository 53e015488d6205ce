#include "core/calibration/CalibrationStore.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"

namespace tacto {

StimulatorCalibration linesOf(const StoredCalibration& stored) {
    const auto known = [](const StoredLine& line) {
        CalibrationLine out = line;
        // U is stated in % of the command; the delivered value may be less than the command.
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
        return invalid("calibration of {}: no {}; all four quantities were expected", calibration.serial, time.words);
    }
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);  // another process may have added a line meanwhile
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

namespace {

Result<void> checkLine(const StoredLine& line, const std::string& serial, std::string_view quantity) {
    if (auto sound = validateNumbers(line, quantity); !sound) {
        return invalid("calibration of {}: {}", serial, sound.error().message);
    }
    if (!(line.uncertainty_pct > 0) || !std::isfinite(line.uncertainty_pct)) {
        return invalid("calibration of {}: uncertainty of {} {} %; above 0 was expected", serial, quantity,
                       line.uncertainty_pct);
    }
    if (line.residual && !(*line.residual >= 0 && std::isfinite(*line.residual))) {
        return invalid("calibration of {}: largest residual of {} {}; 0 or more was expected", serial, quantity,
                       *line.residual);
    }
    return {};
}

/// Adds the keys of a calibration line; `line` gives the member that holds the line.
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
    instrument.passOverUnknownKeys();  // so that files of a later version can be read
    RecordFields<StoredLine> line;
    addLine(line, std::identity{});
    line.passOverUnknownKeys();

    RecordFields<C> all;
    all.text("serial", &C::serial, kAnyText).required = true;
    all.text("device", &C::device, kAnyText).required = true;
    all.text("unit", &C::unit, kAnyText).required = true;
    addLine(all, &C::amplitude);  // at the top level, as in files from before times were calibrated
    for (const auto& time : kStoredTimes) all.record(time.id, time.line, line).leftOutIfEmpty = true;
    all.add("made", &C::made, dateKind()).required = true;
    all.add("valid_until", &C::validUntil, dateKind()).required = true;
    all.flag("simulated", &C::simulated).required = true;
    all.text("session", &C::session, kAnyText).required = true;
    // Lines of older versions lack these two: they are read, but not applied.
    all.text("session_head", &C::sessionHead, kAnyText);
    all.number("readings", &C::readings);
    all.list("instruments", &C::instruments, instrument.kind(), 0, 10'000).required = true;
    all.passOverUnknownKeys();
    all.rule([](const C& calibration) { return check(calibration); });
    return all;
}

const RecordFields<StoredCalibration>& calibrationFields() { return builtOnce<buildCalibrationFields>(); }

}  // namespace

Result<void> checkProvenance(const StoredCalibration& c) {
    if (c.session.empty() || !isSha256(c.sessionHead) || c.readings == 0) {
        return invalid(
            "the calibration of stimulator {} of {} does not say from which readings it was computed, so it is "
            "not applied; a new calibration is expected",
            c.serial, dateText(c.made));
    }
    const auto stated = [](const CalibrationInstrument& one) { return one.gainTolerance.value_or(0) > 0; };
    if (std::none_of(c.instruments.begin(), c.instruments.end(), stated)) {
        return invalid(
            "the calibration of stimulator {} of {} rests on no instrument whose accuracy is stated, so it is "
            "not applied; a new calibration is expected",
            c.serial, dateText(c.made));
    }
    const auto held = std::chrono::sys_days(c.validUntil) - std::chrono::sys_days(c.made);
    if (held > kLongestValidity) {
        return invalid(
            "the calibration of stimulator {} of {} claims to hold for {} days, so it is not applied; at most "
            "{} are accepted",
            c.serial, dateText(c.made), held.count(), kLongestValidity.count());
    }
    return {};
}

Result<void> check(const StoredCalibration& c) {
    if (c.serial.empty()) {
        return invalid("a calibration without the stimulator's serial; one was expected");
    }
    if (c.unit != "V" && c.unit != "mA") {
        return invalid("calibration of {}: unit '{}'; V or mA was expected", c.serial, c.unit);
    }
    if (auto sane = checkLine(c.amplitude, c.serial, kCalibratedAmplitude.words); !sane) return sane;
    for (const auto& time : kStoredTimes) {
        if (!(c.*time.line)) continue;
        if (auto sane = checkLine(*(c.*time.line), c.serial, time.words); !sane) return sane;
    }
    if (!c.made.ok() || !c.validUntil.ok() || c.validUntil < c.made) {
        return invalid("calibration of {}: valid until {}; a day from {} on was expected", c.serial,
                       c.validUntil.ok() ? dateText(c.validUntil) : "no day",
                       c.made.ok() ? dateText(c.made) : "no day");
    }
    for (const auto& instrument : c.instruments) {
        if (!instrument.due || *instrument.due >= c.made) continue;
        return invalid("calibration of {}: the {} {} was itself due on {}, before {}; a calibrated one was expected",
                       c.serial, instrument.name, instrument.serial, dateText(*instrument.due), dateText(c.made));
    }
    return {};
}

nlohmann::json toJson(const StoredCalibration& calibration) { return calibrationFields().write(calibration); }

Result<StoredCalibration> storedCalibrationFrom(const nlohmann::json& json) {
    return calibrationFields().read(json, {});
}

std::optional<CalibrationDate> parseDate(std::string_view text) {
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
    const auto number = [&](std::size_t from, std::size_t length) -> std::optional<int> {
        const auto value = parseWhole<int>(text.substr(from, length));
        return value && *value >= 0 ? value : std::nullopt;
    };
    const auto year = number(0, 4), month = number(5, 2), day = number(8, 2);
    if (!year || !month || !day) return std::nullopt;
    const CalibrationDate date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                               std::chrono::day(static_cast<unsigned>(*day))};
    return date.ok() ? std::optional(date) : std::nullopt;
}

std::string dateText(CalibrationDate date) {
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                       static_cast<unsigned>(date.day()));
}

ValueKind<CalibrationDate> dateKind() {
    return codedKind<CalibrationDate>(
        "a date as \"2026-11-21\"",
        [](const nlohmann::json& value) {
            return value.is_string() ? parseDate(value.get<std::string>()) : std::nullopt;
        },
        [](const CalibrationDate& date) { return nlohmann::json(dateText(date)); });
}

CalibrationDate utcToday() { return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()); }

}  // namespace tacto
