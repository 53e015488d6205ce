#include <nlohmann/json.hpp>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/MeasureLoad.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"
#include "core/devices/DeviceUri.h"
#include "core/measure/CaptureDescription.h"
#include "core/measure/CaptureFile.h"
#include "core/measure/InstrumentStatement.h"
#include "core/measure/PulseMeasurement.h"

namespace tacto::cli {

namespace {

void declareMeasure(QCommandLineParser& parser) {
    parser.addOption({"channel", "Measures only this channel.", "NAME"});
    parser.addOption(
        {"shunt", "Resistance in ohm across which the channel was measured: volts become amperes.", "OHM"});
    parser.addOption({"rate", "Intra-train pulse rate in Hz: pulses up to 1.5 periods apart form a train.", "HZ"});
    parser.addOption({"train-gap", "Pulses up to this many seconds apart form a train.", "S"});
    declareCaptureOptions(parser);
    parser.addOption(
        {"accuracy",
         "What the instrument's data sheet states, as in gain_pct=2; may be repeated. Also fs_pct, probe_pct, "
         "shunt_pct, timebase_ppm, lsb_v, lsb_a.",
         "KEY=VALUE"});
    parser.addOption({"json", "Prints one JSON value."});
}

nlohmann::json toJson(const ChannelMeasurement& m) {
    using tacto::toJson;
    return {{"name", m.name},
            {"unit", m.unit},
            {"rate_hz", numberOrNull(m.rate_hz)},
            {"samples", m.samples},
            {"pulses", m.measuredPulses},
            {"trains", m.trains.size()},
            {"amplitude", toJson(m.amplitude)},
            {"width_s", toJson(m.width_s)},
            {"interval_s", toJson(m.interval_s)},
            {"rise_s", toJson(m.rise_s)},
            {"fall_s", toJson(m.fall_s)},
            {"overshoot", toJson(m.overshoot)},
            {"droop", toJson(m.droop)},
            {"gap_s", toJson(m.gap_s)},
            {"charge", toJson(m.charge)},
            {"imbalance", toJson(m.imbalance)},
            {"baseline", numberOrNull(m.states.baseline)},
            {"amplitude_uncertainty", numberOrNull(m.uncertainty.amplitude)},
            {"width_uncertainty_s", numberOrNull(m.uncertainty.width_s)}};
}

Result<MeasureOptions> optionsFrom(const QCommandLineParser& parser) {
    MeasureOptions options;
    for (const auto* name : {"rate", "train-gap"}) {
        if (!parser.isSet(name)) continue;
        const auto number = numberOption(parser, name);
        if (!number) return failure(number);
        if (!(*number > 0)) {
            return fail(ErrorCode::InvalidArgument, "--{} is {}; a number above 0 is expected", name, *number);
        }
        if (std::string_view(name) == "rate")
            options.intraTrainRate = Hertz(*number);
        else
            options.trainGap = Seconds(*number);
    }
    return options;
}

/// Returns whether the capture is simulated, as stated by the capture or its folder. Nothing: the origin is not known.
std::optional<bool> simulatedAs(const std::filesystem::path& path, const Capture& capture) {
    return capture.simulated ? std::optional(true) : statedSimulated(path);
}

int runMeasure(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "CAPTURE");
    if (!path) return usage(fmt::format("measure: {}", path.error().message));
    const auto options = optionsFrom(parser);
    if (!options) return usage("measure: " + options.error().message);
    std::optional<Ohms> shunt;
    if (parser.isSet("shunt")) {
        const auto ohm = numberOption(parser, "shunt");
        if (!ohm) return usage("measure: " + ohm.error().message);
        if (!(*ohm > 0)) return usage(fmt::format("measure: --shunt is {}; a number above 0 is expected", *ohm));
        shunt = Ohms(*ohm);
    }
    const auto readAs = captureOptions(parser);
    if (!readAs) return usage("measure: " + readAs.error().message);
    auto reading = readCaptureFile(*path, *readAs);
    if (!reading) return couldNotRun(reading.error());
    std::optional<std::size_t> channel;
    const auto channelName = parser.value("channel").toStdString();
    if (parser.isSet("channel")) {
        const auto found = findChannel(reading->capture, channelName);
        if (!found) return usage("measure: " + found.error().message);
        channel = *found;
    }
    if (shunt) {
        const auto name = channel ? std::optional<std::string_view>(channelName) : std::nullopt;
        if (const auto converted = convertShunt(reading->capture, name, *shunt); !converted) {
            return usage("measure: " + converted.error().message);
        }
    }
    DeviceUri stated{.scheme = "measure", .path = *path, .parameters = {}};
    for (const auto& text : parser.values("accuracy")) {
        const auto pair = text.toStdString();
        const auto equals = pair.find('=');
        if (equals == std::string::npos)
            return usage(fmt::format("measure: --accuracy is \"{}\"; KEY=VALUE is expected", pair));
        stated.parameters.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
    }
    const auto statement = takeStatement(stated);
    if (!statement) return usage("measure: " + statement.error().message);
    if (!stated.parameters.empty()) {
        return usage(
            fmt::format("measure: --accuracy {} is not known; gain_pct, fs_pct, probe_pct, shunt_pct, "
                        "timebase_ppm, lsb_v or lsb_a is expected",
                        stated.parameters.front().first));
    }
    if (*statement) applyStatement(reading->capture, **statement);
    const auto found = measureCapture(reading->capture, channel, *options);
    for (auto& its : reading->capture.channels) {
        for (const auto& m : found.channels) {
            if (m.name == its.name && m.quality.foundStep > 0) its.lsb = m.quality.foundStep;
        }
    }
    const auto lacking = notStatedText(reading->capture);
    const auto load = loadIn(reading->capture, *options);
    auto warnings = reading->warnings;
    warnings.insert(warnings.end(), found.warnings.begin(), found.warnings.end());
    if (load) warnings.insert(warnings.end(), load->warnings.begin(), load->warnings.end());
    const auto simulated = simulatedAs(*path, reading->capture);
    if (parser.isSet("json")) {
        auto channels = nlohmann::json::array();
        for (const auto& m : found.channels) {
            channels.push_back(toJson(m));
            addTrust(channels.back(), m);
        }
        printJson({{"format", reading->formatId},
                   {"channels", channels},
                   {"load", loadJson(load)},
                   {"simulated", simulated ? nlohmann::json(*simulated) : nlohmann::json()},
                   {"not_stated", lacking},
                   {"warnings", warnings}});
        return kDone;
    }
    say("{}\n", reading->formatName);
    if (simulated.value_or(false)) say("SIMULATED: no number here was measured on hardware.\n");
    for (const auto& m : found.channels) {
        say("{}: {} samples at {}, {} pulses\n", m.name, m.samples, scaledText(m.rate_hz, "S/s", 4), m.measuredPulses);
        printChannel(m);
    }
    if (load) printLoad(*load);
    if (!lacking.empty() && !found.channels.empty() && found.channels.front().measuredPulses > 0) {
        say("What is not known rests on this: {} (--accuracy, or a file that states it).\n", lacking);
    }
    for (const auto& warning : warnings) say(stderr, "{}\n", warning);
    return kDone;
}

}  // namespace

const Command kMeasure{"measure", "CAPTURE [--channel NAME] [--shunt OHM] [--format ID] [--json]",
                       "Amplitude, width and interval of the pulses in an oscilloscope record", declareMeasure,
                       runMeasure};

}  // namespace tacto::cli
