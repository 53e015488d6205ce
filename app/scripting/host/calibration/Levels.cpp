// The levels of a stimulator's calibration: how each is set, and what the oscilloscope saw of it.
#include <algorithm>
#include <string_view>

#include "app/scripting/engine/Arming.h"
#include "app/scripting/host/bench/EncodingChange.h"
#include "app/scripting/host/bench/TrainCaptures.h"
#include "app/scripting/host/calibration/CalibrationObject.h"
#include "app/scripting/host/measure/PulseReading.h"

namespace tacto::host::calibration {

namespace {

/// What the levels of a run go by.
struct LevelSettings {
    explicit LevelSettings(const Arguments& from)
        : load_ohm(from.number("settings.load")),
          rate_hz(from.number("settings.rate_hz")),
          settling_s(from.number("settings.settling_s")),
          amplitude_v(from, kCalibratedAmplitude),
          interval_s(from, kCalibratedInterval),
          width_us(from, kCalibratedWidth),
          gap_us(from, kCalibratedGap) {}

    double load_ohm, rate_hz, settling_s;
    LevelRange amplitude_v, interval_s, width_us, gap_us;
};

/// Straight curves over the calibrated range, so that R sets the amplitude and P the interval level by level.
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

/// Arms with this encoding, and drives at the shortest interval, which belongs to P = 1.
Result<void> armWith(ScriptSession& session, const Json& encoding, double load_ohm, double roughness) {
    if (auto changed = bench::changeEncoding(session.bench(), encoding); !changed) return changed;
    if (auto armed = armOn(session, load_ohm); !armed) return armed;
    return driveAt(session, roughness, 1);
}

/// One range for all levels: its errors are then the same for all.
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

/// Amplitude and interval are driven; width and gap are part of the profile and want a disarmed output.
Result<void> setLevel(ScriptSession& session, const LevelSettings& settings, std::string_view quantity, double share) {
    if (quantity == "amplitude") return driveAt(session, share, 1);
    if (quantity == "interval") return driveAt(session, 0, 1 - share);
    Json encoding = encodingOver(settings);
    if (quantity == "width") encoding["phase_width_us"] = settings.width_us.at(share);
    if (quantity == "gap") encoding["inter_phase_gap_us"] = settings.gap_us.at(share);
    session.bench().disarm();
    return armWith(session, encoding, settings.load_ohm, 0);
}

/// Two records, or both trains in one where the oscilloscope does not state how good the time stamps of records are.
Result<Json> readInterval(ScriptSession& session, const LevelSettings& settings, double share) {
    if (!session.scopeSeen().stampsStated()) {
        // A record of both begins with whatever train comes first: it has the new interval by then.
        if (auto waited = session.bench().wait(Seconds(2 * settings.interval_s.at(share))); !waited)
            return failure(waited);
    }
    return readTrains(session, settings, 2);
}

}  // namespace

Result<Json> readKnownLoad(ScriptSession& session, const Arguments& arguments) {
    const LevelSettings settings(arguments);
    if (auto armed = armWith(session, encodingOver(settings), settings.load_ohm, 1); !armed) return failure(armed);
    auto reading = readTrains(session, settings, 1);
    if (!reading) return reading;
    session.bench().disarm();
    return reading;
}

Result<Json> warmUp(ScriptSession& session, const Arguments& arguments) {
    const double seconds = arguments.number("seconds");
    if (!(seconds > 0)) return Json();
    if (auto armed = armOn(session, arguments.number("load")); !armed) return failure(armed);
    if (auto driven = driveAt(session, 0, 1); !driven) return failure(driven);
    if (auto waited = session.bench().wait(Seconds(seconds)); !waited) return failure(waited);
    session.bench().disarm();
    return Json();
}

Result<Json> beginLevels(ScriptSession& session, const Arguments& arguments) {
    const LevelSettings settings(arguments);
    const auto quantity = arguments.text("quantity");
    if (auto changed = bench::changeEncoding(session.bench(), encodingOver(settings)); !changed)
        return failure(changed);
    if (quantity != "amplitude" && quantity != "interval") return Json();  // each of their levels arms
    return done(armOn(session, settings.load_ohm));
}

Result<Json> readLevel(ScriptSession& session, const Arguments& arguments) {
    const LevelSettings settings(arguments);
    const auto quantity = arguments.text("quantity");
    const double share = arguments.number("step.share");
    if (auto set = setLevel(session, settings, quantity, share); !set) return failure(set);
    if (settings.settling_s > 0) {
        if (auto waited = session.bench().wait(Seconds(settings.settling_s)); !waited) return failure(waited);
    }
    auto reading = quantity == "interval" ? readInterval(session, settings, share) : readTrains(session, settings, 1);
    if (!reading) return reading;
    const auto key = calibratedQuantity(quantity)->reading;
    Json row = {{"reading", reading->at("reading")},
                {"commanded", reading->at("commanded").at(key)},
                {"measured", reading->at(key)},
                {"direction", arguments.text("step.direction")},
                {"repeat", arguments.whole("step.repeat")}};
    return Json{{"row", std::move(row)}, {"reading", std::move(*reading)}};
}

}  // namespace tacto::host::calibration
