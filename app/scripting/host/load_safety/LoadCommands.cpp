// Computes the effect of a command on a load before the command is given.
#include "app/scripting/host/load_safety/LoadCommands.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"
#include "core/bench/delivery/TrainPlanner.h"
#include "core/encoding/Encoder.h"
#include "core/safety/SourceTraits.h"
#include "core/safety/TrainExposure.h"
#include "core/session/SessionWriter.h"

namespace tacto::host::load_safety {

namespace {

constexpr double kHeadroom = 1.5;     // range divided by expected peak, so that an output that is too large still shows
constexpr double kTimeConstants = 8;  // length of the tail in time constants: 0.03 % is left at its end
constexpr double kLongestTail_s = 0.02;

/// Returns the amplitude in V or mA.
double inItsUnit(const Amplitude& amplitude) { return siValue(amplitude) * (isCurrent(amplitude) ? 1e3 : 1); }

/// Returns the first limit that forbids the train, with the figures for the declared load and for the worst case.
std::string forbids(const GateSetup& setup, const PulseTrain& train, Seconds interval) {
    const auto nominal = exposureOf(train, interval, setup.load.nominal, setup.source, 0);
    const auto rows = exposureTable(setup, train, interval);
    const auto* row = firstForbidding(rows);
    if (row == nullptr) return {};
    return fmt::format("{} {} at {}, {} at worst within 20 % of it; {} {} are allowed ({})", titleOf(row->quantity),
                       scaledText(nominal.at(row->quantity), row->unit, 3), setup.load.nominal.text(),
                       scaledText(row->value, row->unit, 3), row->strict ? "less than" : "at most",
                       exactText(row->limit, row->unit), row->set.view());
}

/// Returns the limit that forbids arming on this load: every arming delivers an impedance check first.
std::string forbidsCheck(const GateSetup& setup) {
    const PulseTrain check = checkTrainOf(setup);
    const auto why = forbids(setup, check, checkInterval(check));
    if (why.empty()) return {};
    return fmt::format("impedance check of {:.3g} {}: {}", inItsUnit(check.amplitude), amplitudeUnit(check.amplitude),
                       why);
}

/// Returns settings that show the whole train with its tail, and up to twice the expected peak.
bench::CaptureOptions captureFor(Bench& bench, const PulseTrain& train, const TrainExposure& most, const Load& load,
                                 bool opens) {
    const auto* scope = bench.devices().oscilloscope.get();
    double tail_s = 0;
    if (load.kind == LoadKind::SkinEquivalent) {
        const double ohm = opens ? load.parallel.value() : 1 / (1 / load.parallel.value() + 1 / load.series.value());
        tail_s = std::min(kLongestTail_s, kTimeConstants * ohm * load.capacitance.value() * 1e-9);
    }
    const double record_s =
        (train.outputDuration().count() + tail_s + bench::kTrainTail.count()) / (1 - bench::kPreTrigger);
    double rate = 10e6;
    double depth = 1e6;
    if (scope != nullptr) {
        rate = std::min(rate, scope->traits().maxRate.value());
        if (scope->traits().memoryDepth > 0) depth = static_cast<double>(scope->traits().memoryDepth);
    }
    if (record_s * rate > depth) rate = depth / record_s;
    const double volts = kHeadroom * most.at(Quantity::PeakVoltage);
    return {.rate_hz = rate,
            .samples = static_cast<std::size_t>(record_s * rate),
            .voltageRange_v = volts,
            .currentRange_ma = kHeadroom * most.at(Quantity::PeakCurrent),
            .trigger_v = 0.2 * volts / kHeadroom};
}

/// Returns the command at the shortest interval; `strength` runs from 0 (weakest amplitude) to 1 (strongest).
Result<LoadCommand> commandFor(ScriptSession& session, const std::string& name, double strength) {
    Bench& bench = session.bench();
    const auto load = parseLoad(name);
    if (!load) return failure(load);
    const auto& encoding = bench.profile().encoding;
    const auto& source = bench.devices().stimulator->traits();
    // Roughness R and pressure P that give the shortest interval and the amplitude `strength`, for either assignment.
    const bool texture = encoding.assignment == Assignment::TextureToAmplitude;
    const double R = texture ? strength : 1, P = texture ? 1 : strength;
    const auto command = Encoder(encoding).encode(R, P);
    if (!command) return failure(command);

    const Ohms ohms = impedanceOf(*load, encoding.train, source);
    const GateSetup setup = bench.setupFor(*load);
    LoadCommand out{.load = name,
                    .roughness = R,
                    .pressure = P,
                    .command_v = command->amplitude.value(),
                    .interval_s = command->interval.count(),
                    .checkForbidden = forbidsCheck(setup)};
    // As it will be programmed: a calibrated stimulator is told less, or more, than what comes out.
    const auto rounded = programmedTrain(encoding, source, bench.calibration(), command->amplitude, ohms);
    if (!rounded && rounded.error().code == ErrorCode::LimitExceeded) return failure(rounded);
    if (!rounded) {
        out.notApplicable =
            fmt::format("{} cannot be driven with {:.4g} V: {}", name, out.command_v, rounded.error().message);
        return out;
    }
    const auto& train = rounded->train;
    out.forbidden = forbids(setup, train, programmedFor(command->interval, bench.calibration()));
    const double area = setup.electrodeArea ? setup.electrodeArea->value() : kNaN;
    const auto most = exposureOf(train, command->interval, *load, source, area);
    // The settled current of a skin equivalent is far below its charging spike, so it is captured in its own range.
    constexpr double kOverTheEnd = 5e3;  // mA per A
    const bool spikes = load->kind == LoadKind::SkinEquivalent && source.drive == Drive::Voltage;
    if (spikes) out.fineRange_ma = kOverTheEnd * out.command_v / ohms.value();
    out.capture = captureFor(bench, train, most, *load, source.gap == GapState::HighImpedance);
    return out;
}

}  // namespace

Result<std::vector<LoadCommand>> commandsFor(ScriptSession& session, const std::string& load, int count) {
    std::vector<LoadCommand> all;
    for (int i = 0; i < count; ++i) {
        auto command = commandFor(session, load, static_cast<double>(i) / (count - 1));
        if (!command) return failure(command);
        all.push_back(std::move(*command));
    }
    return all;
}

std::optional<std::size_t> strongestOf(const std::vector<LoadCommand>& commands) {
    for (std::size_t i = commands.size(); i > 0; --i) {
        if (commands[i - 1].notApplicable.empty() && commands[i - 1].forbidden.empty()) return i - 1;
    }
    return {};
}

}  // namespace tacto::host::load_safety
