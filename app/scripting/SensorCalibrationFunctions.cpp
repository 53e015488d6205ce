// Calibrating a fingertip: its rest, slides over surfaces, weights on it, and what follows from them.
#include <cmath>
#include <set>

#include "app/scripting/Arguments.h"
#include "app/scripting/HostFunction.h"
#include "app/scripting/ScriptSession.h"
#include "app/scripting/SurfaceSliding.h"
#include "core/analysis/ResultJson.h"
#include "core/analysis/SensorCalibrationJson.h"

namespace tacto {

namespace {

using Json = nlohmann::json;

/// Takes the bench's samples as long as it lives.
class Listening {
public:
    explicit Listening(Bench& bench) : bench_(bench), tap_(std::make_unique<BenchTap>()) { bench_.listen(tap_.get()); }
    /// The finger drives nothing afterwards that it was not asked to.
    ~Listening() {
        bench_.listen(nullptr);
        static_cast<void>(bench_.drive(DriveSource::Off));
    }
    Listening(const Listening&) = delete;
    Listening& operator=(const Listening&) = delete;

    void takeInto(SensorSamples& samples) {
        while (const auto sample = tap_->samples.pop()) {
            auto& block = samples.blocks[sample->stream];
            block.t_s.push_back(sample->t_s);
            for (std::uint32_t c = 0; c < sample->channels; ++c) {
                block.values.push_back(static_cast<double>(sample->values[c]));
            }
        }
    }

    [[nodiscard]] std::uint64_t dropped() const noexcept { return tap_->samples.dropped(); }

private:
    Bench& bench_;
    std::unique_ptr<BenchTap> tap_;
};

/// Lets `duration_s` pass and returns what the fingertip said meanwhile.
Result<SensorSamples> listenFor(ScriptSession& session, double duration_s) {
    constexpr double kStep_s = 0.1;  // a tap holds over half a second of a 20 kHz finger
    Bench& bench = session.bench();
    if (!bench.devices().sensor) return fail(ErrorCode::Unsupported, "no sensor is connected");
    SensorSamples samples;
    for (auto info : bench.devices().sensor->streams()) {
        info.channels = std::min(info.channels, TapSample::kMaxChannels);
        samples.streams.push_back(info);
    }
    samples.blocks.resize(samples.streams.size());
    samples.serial = bench.devices().sensor->identity().serial;
    if (auto driven = bench.drive(DriveSource::Sensor); !driven) return failure(driven);
    Listening listening(bench);
    const double end = toSeconds(session.now()) + duration_s;
    while (toSeconds(session.now()) < end) {
        const double left = std::max(0.005, end - toSeconds(session.now()));
        if (auto waited = bench.wait(Seconds(std::min(kStep_s, left))); !waited) return failure(waited);
        listening.takeInto(samples);
    }
    if (listening.dropped() > 0) {
        return fail(ErrorCode::Device,
                    "{} samples of the fingertip were lost here: this computer was too busy; none may be",
                    listening.dropped());
    }
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        const auto& info = samples.streams[s];
        const double wanted = info.rate_hz * duration_s;
        const auto came = static_cast<double>(samples.blocks[s].samples());
        if (came < wanted / 2) {
            return fail(ErrorCode::Device, "{} gave {} samples in {} s; about {:.0f} are expected", info.name, came,
                        duration_s, wanted);
        }
    }
    return samples;
}

/// The mean force as the profile in force turns it into N, and in which unit that is; null without a force sensor.
Result<Json> forceInUse(ScriptSession& session, const SensorSamples& samples) {
    auto chain = RoughnessChain::create(samples.streams, session.bench().profile().roughness, {}, samples.serial);
    if (!chain) return failure(chain);
    for (std::size_t s = 0; s < samples.streams.size(); ++s) {
        if (samples.streams[s].kind != StreamKind::Force) continue;
        const double mean = levelOf(samples, StreamKind::Force).mean;
        return Json{{"mean", numberOrNull((*chain)->inUse(s, 0, mean))},
                    {"unit", symbolOf((*chain)->streams()[s].unit)}};
    }
    return Json();
}

Result<Json> streams(ScriptSession& session, const Json&) {
    const auto& sensor = session.bench().devices().sensor;
    if (!sensor) return fail(ErrorCode::Unsupported, "bench.sensorStreams: no sensor is connected");
    Json out = Json::array();
    for (const auto& info : sensor->streams()) {
        out.push_back({{"kind", nameOf(info.kind)},
                       {"unit", symbolOf(info.unit)},
                       {"channels", info.channels},
                       {"rate_hz", info.rate_hz}});
    }
    return out;
}

Result<Json> measureRest(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.measureRest", list);
    auto options = arguments.options(0, {"duration_s"});
    if (!options) return failure(options);
    auto duration = arguments.number(*options, "duration_s", 3, {0.5, 600});
    if (!duration) return failure(duration);
    Bench& bench = session.bench();
    bench.disarm();
    if (auto& surface = bench.devices().surface) {
        if (auto up = surface->present("", MillimetresPerSecond(0), Newtons(0)); !up) return failure(up);
    } else {
        OperatorQuestion question;
        question.name = "rest";
        question.text = "Lift the fingertip; nothing touches it";
        if (auto answer = session.ask(question); !answer) return failure(answer);
    }
    if (auto waited = bench.wait(Seconds(1)); !waited) return failure(waited);  // the finger leaves what it was on
    auto samples = listenFor(session, *duration);
    if (!samples) return failure(samples);
    auto rest = readRest(*samples, bench.profile().roughness);
    if (!rest) return failure(rest);
    Json out = toJson(*rest);
    out["duration_s"] = *duration;
    out["force"] = toJson(levelOf(*samples, StreamKind::Force));
    auto used = forceInUse(session, *samples);
    if (!used) return failure(used);
    out["force_in_use"] = std::move(*used);
    session.own().note(out);
    return out;
}

Result<Json> measureSlide(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.measureSlide", list);
    auto material = arguments.text(0, "material");
    if (!material) return failure(material);
    auto rest = arguments.object(1, "rest");
    if (!rest) return failure(rest);
    auto levels = sensorRestFrom(**rest);
    if (!levels) return failure(levels);
    auto options = arguments.options(2, {"speed_mm_s", "force_n", "duration_s"});
    if (!options) return failure(options);
    auto sliding = slidingFrom(arguments, *options, {*material, 50, 1});
    if (!sliding) return failure(sliding);
    auto duration = arguments.number(*options, "duration_s", 4, {1, 600});
    if (!duration) return failure(duration);
    Bench& bench = session.bench();
    bench.disarm();
    if (auto slid = slide(session, *sliding); !slid) return failure(slid);
    if (auto waited = bench.wait(Seconds(1)); !waited) return failure(waited);  // the finger lands and speeds up
    auto samples = listenFor(session, *duration);
    if (!samples) return failure(samples);
    auto reading = readSlide(*samples, bench.profile().roughness, *levels);
    if (!reading) return fail(reading.error().code, "{}: {}", *material, reading.error().message);
    Json out = toJson(*reading);
    out["material"] = *material;
    if (session.own().noted(**rest)) session.own().note(out);
    return out;
}

Result<Json> measureWeight(ScriptSession& session, const Json& list) {
    const Arguments arguments("bench.measureWeight", list);
    auto mass = arguments.number(0, "mass_g", {0, 5000});
    if (!mass) return failure(mass);
    auto options = arguments.options(1, {"gravity_m_s2", "duration_s"});
    if (!options) return failure(options);
    auto gravity = arguments.number(*options, "gravity_m_s2", 9.80665, {9.7, 9.9});
    if (!gravity) return failure(gravity);
    auto duration = arguments.number(*options, "duration_s", 2, {0.5, 600});
    if (!duration) return failure(duration);
    const double force = *mass / 1000 * *gravity;
    Bench& bench = session.bench();
    bench.disarm();
    if (auto& surface = bench.devices().surface) {
        auto pressed = surface->present("glass", MillimetresPerSecond(0), Newtons(force));
        if (!pressed) return failure(pressed);
    } else {
        OperatorQuestion question;
        question.name = fmt::format("weight-{}g", *mass);
        question.text =
            fmt::format("Rest the weight of {} g ({:.4g} N) on the fingertip and wait until it is still", *mass, force);
        if (auto answer = session.ask(question); !answer) return failure(answer);
    }
    if (auto waited = bench.wait(Seconds(1.5)); !waited) return failure(waited);
    auto samples = listenFor(session, *duration);
    if (!samples) return failure(samples);
    Json out = {{"mass_g", *mass}, {"reference_n", force}, {"force", nullptr}, {"taxels", Json::array()}};
    auto used = forceInUse(session, *samples);
    if (!used) return failure(used);
    out["force_in_use"] = std::move(*used);
    if (const auto* info = streamOf(*samples, StreamKind::Force)) {
        out["force"] = numberOrNull(levelOf(*samples, StreamKind::Force).mean);
        out["force_unit"] = symbolOf(info->unit);
    }
    if (const auto* info = streamOf(*samples, StreamKind::Taxels)) {
        out["taxel_unit"] = symbolOf(info->unit);
        for (std::size_t c = 0; c < info->channels; ++c) {
            out["taxels"].push_back(numberOrNull(levelOf(*samples, StreamKind::Taxels, c).mean));
        }
    }
    session.own().note(out);
    return out;
}

Result<Json> sensorScale(ScriptSession&, const Json& list) {
    const Arguments arguments("analysis.sensorScale", list);
    auto rows = arguments.list(0, "readings");
    if (!rows) return failure(rows);
    auto options = arguments.options(1, {"name", "tolerance_pct"});
    if (!options) return failure(options);
    auto name = arguments.text(*options, "name", "the sensor");
    if (!name) return failure(name);
    auto tolerance = arguments.number(*options, "tolerance_pct", 0, {0, 50});
    if (!tolerance) return failure(tolerance);
    std::vector<CalibrationReading> readings;
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("commanded", Json()).is_number()) {
            return arguments.wrong("a reading", row, "an object with commanded (the reference) and measured");
        }
        CalibrationReading reading;
        reading.commanded = row["commanded"].get<double>();
        const Json measured = row.value("measured", Json());
        if (measured.is_number()) reading.measured = measured.get<double>();
        const Json direction = row.value("direction", Json(""));
        if (direction == "up") reading.direction = SweepDirection::Up;
        if (direction == "down") reading.direction = SweepDirection::Down;
        readings.push_back(reading);
    }
    auto found = fitSensorScale(readings, *tolerance / 100, *name);
    if (!found) return failure(found);
    return toJson(*found);
}

Result<Json> sensorCalibration(ScriptSession& session, const Json& list) {
    const Arguments arguments("analysis.sensorCalibration", list);
    auto rows = arguments.list(0, "surfaces");
    if (!rows) return failure(rows);
    auto rest = arguments.object(1, "rest");
    if (!rest) return failure(rest);
    auto levels = sensorRestFrom(**rest);
    if (!levels) return failure(levels);
    std::vector<SlidSurface> surfaces;
    bool own = session.own().noted(**rest);
    std::set<Json> seen;
    for (const auto& row : **rows) {
        if (!row.is_object() || !row.value("slides", Json()).is_array()) {
            return arguments.wrong("a surface", row, "an object with name, ra_um, rz_um and slides");
        }
        SlidSurface surface;
        auto name = arguments.text(row, "name", "");
        if (!name) return failure(name);
        surface.name = *name;
        for (const auto& [key, target] : {std::pair{"ra_um", &surface.ra_um}, std::pair{"rz_um", &surface.rz_um}}) {
            if (row.value(key, Json()).is_null()) continue;
            auto value = arguments.number(row, key, std::nan(""), {0, 1e5});
            if (!value) return failure(value);
            *target = *value;
        }
        for (const auto& one : row["slides"]) {
            auto slid = slideReadingFrom(one);
            if (!slid) return failure(slid);
            surface.slides.push_back(*std::move(slid));
            own = own && session.own().noted(one) && one["material"] == surface.name && seen.insert(one).second;
        }
        surfaces.push_back(std::move(surface));
    }
    auto found = calibrateSensor(surfaces, session.bench().profile().roughness, *levels);
    if (!found) return failure(found);
    Json out = toJson(*found);
    if (own) session.own().note(out);
    return out;
}

}  // namespace

std::vector<HostFunction> sensorCalibrationFunctions() {
    constexpr std::string_view kRest = "from bench.measureRest()";
    constexpr std::string_view kThrows =
        "Throws for an unknown surface, without an answer, when too few samples came, or when the run is stopped.";
    return {
        {"bench",
         "sensorStreams",
         HostKind::Property,
         {},
         "What the fingertip measures.",
         "List of { kind (acceleration, force, taxels), unit, channels, rate_hz }.",
         "Throws without a sensor.",
         streams},
        {"bench",
         "measureRest",
         HostKind::Function,
         {{"options.duration_s", "number", "s", "0.5 to 600; 3 where left out", true}},
         "Disarms, lifts the finger (question rest on a rig that cannot) and reads the fingertip without contact.",
         "{ taxel_baseline, taxel_floor, taxel_unit, mean_square, unit, duration_s, force, force_in_use }: mean_square "
         "is "
         "the power of the acceleration at rest, in unit squared, and null without acceleration; force is a statistic "
         "in the sensor's unit, force_in_use { mean, unit } as the profile scales it.",
         "Throws when something touched the fingertip, when too few samples came, or when the run is stopped.",
         measureRest},
        {"bench",
         "measureSlide",
         HostKind::Function,
         {{"material", "text", "", "surface, as \"P120\""},
          {"rest", "object", "", kRest},
          {"options.speed_mm_s", "number", "mm/s", "sliding speed; 50 where left out", true},
          {"options.force_n", "number", "N", "normal force; 1 where left out", true},
          {"options.duration_s", "number", "s", "1 to 600; 4 where left out", true}},
         "Disarms, slides over a surface as bench.measureReference() does, and reads every feature of the slide.",
         "{ material, h, h_abs, v_static, v_dynamic, force_n, sliding_frames, track }: a feature that the rig does not "
         "have is null; track is for analysis.sensorCalibration().",
         kThrows,
         measureSlide},
        {"bench",
         "measureWeight",
         HostKind::Function,
         {{"mass_g", "number", "g", "0 to 5000"},
          {"options.gravity_m_s2", "number", "m/s2", "9.7 to 9.9; 9.80665 where left out", true},
          {"options.duration_s", "number", "s", "0.5 to 600; 2 where left out", true}},
         "Puts a weight on the resting fingertip (question weight-MASSg on a rig that cannot) and reads force and "
         "taxels.",
         "{ mass_g, reference_n, force, force_unit, taxels, taxel_unit, force_in_use }: means, in the sensor's own "
         "units; "
         "force_in_use { mean, unit } as the profile scales it.",
         kThrows,
         measureWeight},
        {"analysis",
         "sensorScale",
         HostKind::Function,
         {{"readings", "list", "", "objects with commanded (the reference), measured and direction (up, down)"},
          {"options.name", "text", "", "of the sensor, for messages", true},
          {"options.tolerance_pct", "number", "%", "half-width that all references share; 0 where left out", true}},
         "A straight line through readings against references, turned round: reference = scale · reading + offset.",
         "{ scale, scale_expanded_uncertainty, offset, offset_expanded_uncertainty, gain, offset_reading, "
         "residual_max_pct_fs, repeatability_pct_fs, hysteresis_pct_fs, levels, readings, warnings }: U for 95 %.",
         "Throws for fewer than two references, or where the readings do not follow them.",
         sensorScale},
        {"analysis",
         "sensorCalibration",
         HostKind::Function,
         {{"surfaces", "list", "",
           "objects { name, ra_um, rz_um, slides from bench.measureSlide() }; first the smooth, then the rough "
           "reference"},
          {"rest", "object", "", kRest}},
         "The scale of R from two reference surfaces, how far apart they are in d′, and Spearman's rank correlation of "
         "R against Ra where five or more surfaces have one.",
         "{ surfaces, d_prime: { h, v, R, all }, spearman, accepted, verdict, reasons, warnings, roughness: section of "
         "a profile }.",
         "Throws for fewer than three slides of a reference, or a rough one whose Ra is not above the smooth one's.",
         sensorCalibration},
    };
}

}  // namespace tacto
