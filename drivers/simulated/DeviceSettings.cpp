#include "drivers/simulated/DeviceSettings.h"

#include <cmath>

#include "core/devices/DeviceUri.h"
#include "core/encoding/StimulatorCalibration.h"

namespace tacto::sim {

namespace {

/// Reads all `fault=` parameters.
FaultSchedule faultsIn(UriParameters& from, std::initializer_list<Fault> accepted) {
    FaultSchedule schedule;
    for (const auto value : from.each("fault")) {
        if (const auto added = schedule.add(value, accepted); !added) from.refuse(added.error().message);
    }
    return schedule;
}

/// Returns the source's statement about its amplitude and times, or nothing if its flaws put it out of order.
KnownLines statedBy(const SourceTraits& traits) {
    constexpr double kShortest_s = 1e-3, kLongest_s = 100;  // range of intervals
    constexpr double kMinShareOfMax = 1e-3;                 // used if the source has no amplitude grid
    const auto& stated = traits.accuracy;
    const double least = traits.amplitudeStep > 0 ? traits.amplitudeStep : kMinShareOfMax * traits.amplitudeMax;
    if (!stated.amplitude || !stated.phaseWidth || !stated.gap || !stated.interval) return std::nullopt;
    if (!(stated.phaseWidth->relative <= kLargestMiscalibration) || !(least < traits.amplitudeMax)) return std::nullopt;
    const auto line = [](double lowest, double highest, const Spread& spread) {
        return CalibrationLine{.lowest = lowest, .highest = highest, .spread = spread};
    };
    const double widest_s = Seconds(traits.widthMax).count();
    return StimulatorCalibration{line(least, traits.amplitudeMax, *stated.amplitude),
                                 line(kShortest_s, kLongest_s, *stated.interval),
                                 line(Seconds(traits.widthMin).count(), widest_s, *stated.phaseWidth),
                                 line(Seconds(traits.widthStep).count(), widest_s, *stated.gap)};
}

}  // namespace

Result<FingerAndSensor> readFinger(const DeviceUri& uri, std::uint64_t seed) {
    UriParameters from(uri);
    FingerAndSensor out;
    auto& finger = out.finger;
    auto& sensor = out.sensor;
    if (const auto material = from.text("material")) {
        if (findMaterial(*material) == nullptr) from.refuse("material", *material, "one of " + materialNames());
        finger.material = *material;
    }
    finger.speed = MillimetresPerSecond(from.quantity("speed", "mm/s", finger.speed.value(), 0, 1000));
    finger.force = Newtons(from.quantity("force", "N", finger.force.value(), 0, 20));
    finger.stroke = Seconds(from.quantity("stroke", "s", finger.stroke.count(), 0.1, 3600));
    finger.lift = Seconds(from.quantity("lift", "s", finger.lift.count(), 0, 3600));
    finger.tremor = from.quantity("tremor", "", finger.tremor, 0, 5);
    finger.resonance = Hertz(from.quantity("resonance", "Hz", finger.resonance.value(), 50, 800));
    finger.damping = from.quantity("damping", "", finger.damping, 0.05, 2);
    finger.gratingPeriod = Millimetres(from.quantity("grating", "m", 0, 50e-6, 10e-3) * 1e3);
    finger.gratingDepth = Micrometres(from.quantity("depth", "m", 50e-6, 0, 1e-3) * 1e6);
    sensor.rate_hz = from.quantity("rate", "Hz", sensor.rate_hz, 100, 20'000);
    sensor.slowRate_hz = from.quantity("taxelrate", "Hz", sensor.slowRate_hz, 10, 2000);
    const double ratio = sensor.rate_hz / sensor.slowRate_hz;
    if (!(ratio >= 1) || std::abs(ratio - std::round(ratio)) > 1e-9) {
        from.refuse("rate", fmt::format("{:g}Hz", sensor.rate_hz),
                    fmt::format("a whole multiple of the taxels' {:g} Hz (taxelrate)", sensor.slowRate_hz));
    }
    sensor.bits = from.integer("bits", sensor.bits, 8, 24);
    sensor.range_g = from.quantity("range", "g", sensor.range_g, 2, 200);
    sensor.noise_m_s2 = from.quantity("noise", "m/s2", sensor.noise_m_s2, 0, 10);
    sensor.taxelNoise_Pa = from.quantity("taxelnoise", "Pa", sensor.taxelNoise_Pa, 0, 1e4);
    sensor.forceNoise_N = from.quantity("forcenoise", "N", sensor.forceNoise_N, 0, 1);
    sensor.taxelGain = from.quantity("taxelgain", "", sensor.taxelGain, 0.1, 10);
    sensor.forceGain = from.quantity("forcegain", "", sensor.forceGain, 0.1, 10);
    sensor.onMotor = from.choice("on", "finger", {"finger", "motor"}) == "motor";
    sensor.taxelsInCounts = from.choice("taxelunit", "Pa", {"Pa", "count"}) == "count";
    sensor.dropouts = from.quantity("dropouts", "", 0, 0, 0.9);
    sensor.faults = faultsIn(from, {Fault::Unplug, Fault::Stale, Fault::Dropout, Fault::Nan, Fault::Garbage,
                                    Fault::Drift, Fault::Stuck, Fault::Late});
    if (const auto read = from.finish(); !read) return failure(read);
    finger.seed = sensor.seed = seed;
    finger.tickRate_hz = sensor.rate_hz * SimulatedSensor::ticksPerSample(sensor.rate_hz);
    return out;
}

Result<StimulatorAndLoad> readStimulator(const DeviceUri& uri, std::uint64_t seed) {
    UriParameters from(uri);
    StimulatorAndLoad out;
    auto& settings = out.stimulator;
    auto& traits = settings.traits;
    const bool current = from.choice("mode", "voltage", {"voltage", "current"}) == "current";
    const std::string_view unit = current ? "A" : "V";
    const double scale = current ? 1e3 : 1;  // traits are in mA
    traits.drive = current ? Drive::Current : Drive::Voltage;
    traits.amplitudeMax = from.quantity("max", unit, current ? 0.13 : 100, 0, current ? 1 : 500) * scale;
    traits.amplitudeStep = from.quantity("step", unit, current ? 1e-4 : 0.05, 0, current ? 0.01 : 10) * scale;
    traits.compliance = Volts(from.quantity("compliance", "V", current ? 150 : 100, 1, 500));
    traits.currentLimit = Milliamps(from.quantity("limit", "A", current ? 0.15 : 1, 1e-3, 10) * 1e3);
    const bool zero = from.choice("gap", current ? "highz" : "zero", {"zero", "highz"}) == "zero";
    traits.gap = zero ? GapState::HoldsZero : GapState::HighImpedance;
    traits.deadMan = Seconds(from.quantity("deadman", "s", 2, 0, 60));
    traits.readsBack = from.choice("readback", "yes", {"yes", "no"}) == "yes";
    settings.seed = seed;
    const bool drawn = from.choice("flaws", "drawn", {"drawn", "none"}) == "drawn";
    if (drawn) settings = drawnFlaws(settings);
    const StimulatorSettings before = settings;
    // Values given in the URI replace the drawn values.
    settings.gain = from.quantity("gain", "", settings.gain, 0.1, 10);
    settings.offset = from.quantity("offset", unit, settings.offset, current ? -0.01 : -10, current ? 0.01 : 10);
    settings.droop = from.quantity("droop", "", settings.droop, 0, 0.5);
    settings.overshoot = from.quantity("overshoot", "", settings.overshoot, 0, 0.5);
    settings.coldGain = from.quantity("coldgain", "", settings.coldGain, -0.2, 0.2);
    settings.sourceOhm = from.quantity("sourceohm", "ohm", settings.sourceOhm, 0, 1e4);
    settings.imbalance = from.quantity("imbalance", "", 0, -1, 1);
    settings.widthGain = from.quantity("widthgain", "", 1, 0.8, 1.25);
    settings.widthError = Seconds(from.quantity("widtherror", "s", settings.widthError.count(), -1e-4, 1e-4));
    settings.gapError = Seconds(from.quantity("gaperror", "s", settings.gapError.count(), -1e-4, 1e-4));
    // The simulated source states its largest errors, unless a flaw exceeds them: a device out of order does not know
    // that. Its onsets jitter around the rhythm that the computer keeps.
    const StimulatorStatement stated;
    const double off = settings.gain == before.gain && drawn ? stated.gain : std::abs(settings.gain - 1);
    const double offset = settings.offset == before.offset && drawn ? (current ? stated.offset_ma : stated.offset_v)
                                                                    : std::abs(settings.offset) * scale;
    const double timing = drawn ? stated.timing.count() : 0;
    const double cold = settings.coldGain == before.coldGain && drawn ? stated.coldGain : std::abs(settings.coldGain);
    traits.accuracy = {
        .amplitude = off <= kLargestMiscalibration ? std::optional(Spread{off + cold, offset}) : std::nullopt,
        .phaseWidth = Spread{std::abs(settings.widthGain - 1), std::max(timing, std::abs(settings.widthError.count()))},
        .gap = Spread{0, std::max(timing, std::abs(settings.gapError.count()))},
        .interval = Spread{},
        .rate = Spread{}};
    settings.calibration = statedBy(traits);
    settings.rise = Seconds(from.quantity("rise", "s", settings.rise.count(), 0, 1e-3));
    settings.latency = Seconds(from.quantity("latency", "s", settings.latency.count(), 0, 0.04));
    settings.jitter = Seconds(from.quantity("jitter", "s", settings.jitter.count(), 0, 0.01));
    settings.readBackNoise = from.quantity("readbacknoise", "", settings.readBackNoise, 0, 1);
    if (const auto text = from.text("load")) {
        const auto load = parseLoad(*text);
        if (load) {
            out.load = *load;
        } else {
            from.refuse("load", *text, load.error().message);
        }
    }
    settings.faults = faultsIn(from, {Fault::Unplug, Fault::StuckOn, Fault::Open, Fault::Short, Fault::Drift,
                                      Fault::Garbage, Fault::Late, Fault::Nan});
    if (const auto read = from.finish(); !read) return failure(read);
    return out;
}

Result<ScopeAndFlaws> readOscilloscope(const DeviceUri& uri, std::uint64_t seed) {
    UriParameters from(uri);
    ScopeAndFlaws out;
    out.traits.maxRate = Hertz(from.quantity("rate", "Hz", 10e6, 1e3, 10e6));
    out.traits.memoryDepth = static_cast<std::size_t>(from.integer("memory", 1'000'000, 1000, 10'000'000));
    out.traits.bits = from.integer("bits", 12, 6, 16);
    out.traits.bandwidth = Hertz(from.quantity("bandwidth", "Hz", 20e6, 1e3, 1e9));
    auto& flaws = out.flaws;
    auto& stated = flaws.stated;
    stated.states = from.choice("accuracy", "stated", {"stated", "unknown"}) == "stated";
    stated.gain = from.quantity("gaintolerance", "", stated.gain, 0, 0.5);
    stated.offset = from.quantity("offsettolerance", "", stated.offset, 0, 0.5);
    stated.linearity = from.quantity("linearitytolerance", "", stated.linearity, 0, 0.5);
    stated.shunt = from.quantity("shunttolerance", "", stated.shunt, 0, 0.5);
    stated.timeBase = from.quantity("timebasetolerance", "", stated.timeBase, 0, 0.1);
    if (from.choice("flaws", "drawn", {"drawn", "none"}) == "drawn") flaws = drawnFlaws(flaws, seed);
    // Values given in the URI replace the drawn values.
    flaws.noise = from.quantity("noise", "", flaws.noise, 0, 0.1);
    flaws.gain = from.quantity("gain", "", flaws.gain, 0.5, 2);
    flaws.offset = from.quantity("offset", "V", 0, -10, 10);
    flaws.currentGain = from.quantity("currentgain", "", flaws.currentGain, 0.5, 2);
    flaws.currentOffset = from.quantity("currentoffset", "A", 0, -1, 1);
    flaws.timeBase = from.quantity("timebase", "", flaws.timeBase, 0.8, 1.25);
    flaws.faults = faultsIn(from, {Fault::Unplug, Fault::Garbage, Fault::Late, Fault::Stale, Fault::Nan});
    if (const auto read = from.finish(); !read) return failure(read);
    flaws.seed = seed;
    return out;
}

Result<MassagerSettings> readMassager(const DeviceUri& uri) {
    UriParameters from(uri);
    MassagerSettings settings;
    auto& motor = settings.motor;
    motor.spinUp = Seconds(from.quantity("spinup", "s", motor.spinUp.count(), 1e-3, 1));
    motor.topFrequency = Hertz(from.quantity("frequency", "Hz", motor.topFrequency.value(), 10, 1000));
    motor.topAcceleration_m_s2 = from.quantity("acceleration", "m/s2", motor.topAcceleration_m_s2, 0.1, 200);
    settings.step = from.quantity("step", "", settings.step, 0, 1);
    settings.faults = faultsIn(from, {Fault::Unplug, Fault::StuckOn, Fault::Late});
    if (const auto read = from.finish(); !read) return failure(read);
    return settings;
}

}  // namespace tacto::sim
