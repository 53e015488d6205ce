// The levels of a stimulator's calibration: sets each level and reads it with the oscilloscope.
#include <algorithm>
#include <string_view>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/BenchCalls.h"
#include "app/scripting/host/measure/Readings.h"
#include "app/scripting/host/stimulator_calibration/StimulatorLevels.h"
#include "core/base/JsonText.h"

namespace tacto::host::stimulator_calibration {

namespace {

/// Returns the name of a setting: "width_max_us" for `end` "max".
std::string keyOf(const CalibratedQuantity& of, std::string_view end) {
    return fmt::format("{}_{}_{}", of.id, end, of.setting);
}

Result<LevelSettings> checked(LevelSettings settings, const Arguments& arguments) {
    for (const auto& one : kCalibratedQuantities) {
        const auto& range = settings.of(one);
        if (!(range.low < range.high))
            return arguments.wrong(keyOf(one, "min"), range.low,
                                   fmt::format("a number below {}, {:g},", keyOf(one, "max"), range.high));
    }
    return settings;
}

/// Straight curves over the calibrated range: roughness R sets the amplitude and pressure P the interval.
Json encodingOver(const LevelSettings& settings) {
    return {{"assignment", "texture_to_amplitude"},
            {"amplitude_curve", "linear"},
            {"interval_curve", "linear"},
            {"amplitude_min_v", settings.amplitude_v.low},
            {"amplitude_max_v", settings.amplitude_v.high},
            {"interval_min_s", settings.interval_s.low},
            {"interval_max_s", settings.interval_s.high},
            {"amplitude_ratio_per_train", 0},
            {"amplitude_slew_v_per_s", 0},
            {"interval_ratio_per_train", 0},
            {"hold", "voltage"},
            {"shape", "symmetric"},
            {"pulses", 1},
            {"phase_width_us", 200},
            {"inter_phase_gap_us", 100}};
}

Result<void> armOn(ScriptSession& session, double load_ohm) {
    return armConfirmed(session, fmt::format("{} ohm", load_ohm));
}

Result<void> driveAt(ScriptSession& session, double roughness, double pressure) {
    return session.bench().drive(DriveSource::Manual, roughness, pressure);
}

/// Arms with this encoding and drives at the shortest interval (pressure P = 1).
Result<void> armWith(ScriptSession& session, const Json& encoding, double load_ohm, double roughness) {
    if (auto changed = bench::changeEncoding(session.bench(), encoding); !changed) return changed;
    if (auto armed = armOn(session, load_ohm); !armed) return armed;
    return driveAt(session, roughness, 1);
}

/// Reads all levels in one range, so that its errors are the same for all.
Result<Json> readTrains(ScriptSession& session, const LevelSettings& settings, int trains) {
    const double highest_v = settings.amplitude_v.high;
    auto captures =
        bench::captureTrains(session, {.trains = trains,
                                       .rate_hz = settings.rate_hz,
                                       .voltageRange_v = 1.3 * highest_v,
                                       .currentRange_ma = std::max(1.0, 1.3e3 * highest_v / settings.load_ohm),
                                       .intervals = trains > 1});
    if (!captures) return failure(captures);
    return measure::pulseReading(session, session.hold(std::move(*captures)));
}

/// Amplitude and interval are driven; width and gap are part of the profile and need a disarmed output.
Result<void> setLevel(ScriptSession& session, const LevelSettings& settings, std::string_view quantity, double share) {
    if (quantity == "amplitude") return driveAt(session, share, 1);
    if (quantity == "interval") return driveAt(session, 0, 1 - share);
    Json encoding = encodingOver(settings);
    if (quantity == "width") encoding["phase_width_us"] = settings.width_us.at(share);
    if (quantity == "gap") encoding["inter_phase_gap_us"] = settings.gap_us.at(share);
    session.bench().disarm();
    return armWith(session, encoding, settings.load_ohm, 0);
}

/// Takes two records, or one with both trains if the oscilloscope states no tolerance of its time stamps.
Result<Json> readInterval(ScriptSession& session, const LevelSettings& settings, double share) {
    if (!session.scopeSeen().stampsStated()) {
        // A record of both trains begins with the next train; after this wait, that train has the new interval.
        if (auto waited = session.bench().wait(Seconds(2 * settings.interval_s.at(share))); !waited)
            return failure(waited);
    }
    return readTrains(session, settings, 2);
}

}  // namespace

LevelRange& LevelSettings::of(const CalibratedQuantity& quantity) {
    if (quantity.id == kCalibratedAmplitude.id) return amplitude_v;
    if (quantity.id == kCalibratedInterval.id) return interval_s;
    return quantity.id == kCalibratedWidth.id ? width_us : gap_us;
}

std::vector<HostParameter> levelSettings() {
    using namespace takes;
    return {number("settings.load", "ohm", "that is connected; ± 20 % for the limits").range(1, 1e6),
            number("settings.rate_hz", "Hz", "sampling rate").range(1, 1e9),
            number("settings.settling_s", "s", "at each level before it is read").range(0, 3600),
            number("settings.amplitude_min_v", "V", "lowest amplitude").range(0, 200),
            number("settings.amplitude_max_v", "V", "largest; of a current source times |Z|").range(0, 200),
            number("settings.interval_min_s", "s", "shortest interval").range(0, 60),
            number("settings.interval_max_s", "s", "longest").range(0, 60),
            number("settings.width_min_us", "us", "shortest phase").range(0, 10'000),
            number("settings.width_max_us", "us", "longest").range(0, 10'000),
            number("settings.gap_min_us", "us", "shortest gap").range(0, 10'000),
            number("settings.gap_max_us", "us", "longest").range(0, 10'000)};
}

Result<LevelSettings> levelSettingsFrom(const Arguments& arguments) {
    LevelSettings settings{.load_ohm = arguments.number("settings.load"),
                           .rate_hz = arguments.number("settings.rate_hz"),
                           .settling_s = arguments.number("settings.settling_s")};
    for (const auto& one : kCalibratedQuantities) {
        settings.of(one) = {arguments.number("settings." + keyOf(one, "min")),
                            arguments.number("settings." + keyOf(one, "max"))};
    }
    return checked(settings, arguments);
}

Result<LevelSettings> narrowed(LevelSettings settings, const Json& stored, const Arguments& arguments) {
    for (const auto& one : kCalibratedQuantities) {
        const Json& line = stored.at(std::string(one.id));
        if (textOr(line, "unit") == "mA") continue;
        auto& range = settings.of(one);
        range = {std::max(one.perUnit * numberOr(line, "lowest"), range.low),
                 std::min(one.perUnit * numberOr(line, "highest"), range.high)};
    }
    return checked(settings, arguments);
}

Result<Json> readKnownLoad(ScriptSession& session, const LevelSettings& settings) {
    if (auto armed = armWith(session, encodingOver(settings), settings.load_ohm, 1); !armed) return failure(armed);
    auto reading = readTrains(session, settings, 1);
    if (!reading) return reading;
    session.bench().disarm();
    return reading;
}

Result<void> warmUp(ScriptSession& session, double load_ohm, double seconds) {
    if (!(seconds > 0)) return {};
    if (auto armed = armOn(session, load_ohm); !armed) return armed;
    if (auto driven = driveAt(session, 0, 1); !driven) return driven;
    if (auto waited = session.bench().wait(Seconds(seconds)); !waited) return waited;
    session.bench().disarm();
    return {};
}

Result<void> beginLevels(ScriptSession& session, const LevelSettings& settings, const CalibratedQuantity& quantity) {
    if (auto changed = bench::changeEncoding(session.bench(), encodingOver(settings)); !changed) return changed;
    if (quantity.id != "amplitude" && quantity.id != "interval") return {};  // other levels each arm the output
    return armOn(session, settings.load_ohm);
}

Result<Json> readLevel(ScriptSession& session, const LevelSettings& settings, const CalibratedQuantity& quantity,
                       double share) {
    if (auto set = setLevel(session, settings, quantity.id, share); !set) return failure(set);
    if (settings.settling_s > 0) {
        if (auto waited = session.bench().wait(Seconds(settings.settling_s)); !waited) return failure(waited);
    }
    return quantity.id == "interval" ? readInterval(session, settings, share) : readTrains(session, settings, 1);
}

}  // namespace tacto::host::stimulator_calibration
