#include "app/cli/EncoderOptions.h"

#include <algorithm>
#include <array>

#include "app/cli/Command.h"
#include "app/run/AllDrivers.h"
#include "app/run/OpenDevices.h"
#include "core/bench/arming/CommandPreview.h"

namespace tacto::cli {

namespace {

constexpr std::array kStated{"source", "largest", "step"};

/// The devices of --device. Errors: as Registry::open(); InvalidArgument for one that is neither, or given twice over.
Result<DeviceSet> devicesOf(const QCommandLineParser& parser, const Clock& clock) {
    std::vector<DeviceUri> uris;
    for (const auto& text : parser.values("device")) {
        auto uri = DeviceUri::parse(text.toStdString());
        if (!uri) return failure(uri);
        uris.push_back(std::move(*uri));
    }
    auto registry = allDrivers()();
    auto devices =
        openDevices(registry, uris, {}, {.clock = clock, .declaredLoad = parser.value("load").toStdString()});
    if (!devices) return devices;
    if (devices->identities().size() != uris.size() || devices->oscilloscope || devices->massager)
        return invalid("--device is a sensor: or the address of a stimulator, one of each");
    for (const auto* option : kStated)
        if (devices->stimulator && parser.isSet(option)) return invalid("--{} and a stimulator are given", option);
    return devices;
}

Result<EncoderOutput> statedOutput(const QCommandLineParser& parser) {
    EncoderOutput output;
    if (!parser.isSet("load")) return invalid("--load is missing");
    const auto load = parseLoad(parser.value("load").toStdString());
    if (!load) return failure(load);
    output.load = LoadRange::declared(*load);
    const auto kind = parser.isSet("source") ? parser.value("source").toStdString() : "voltage";
    if (kind != "voltage" && kind != "current")
        return invalid("--source is \"{}\"; voltage or current is expected", kind);
    output.source.drive = kind == "current" ? Drive::Current : Drive::Voltage;
    output.source.amplitudeMax = 100;
    output.source.compliance = Volts(double{TE_MAX_PEAK_V});
    for (const auto& [name, into] :
         {std::pair{"largest", &output.source.amplitudeMax}, std::pair{"step", &output.source.amplitudeStep}}) {
        if (!parser.isSet(name)) continue;
        const auto number = numberOption(parser, name);
        if (!number) return failure(number);
        *into = *number;
    }
    return output;
}

}  // namespace

void declareEncoderOptions(QCommandLineParser& parser) {
    parser.addOption({"load", "Load in ohm, a resistance; the board's ceilings are judged at ± 20 % of it.", "OHM"});
    parser.addOption({"source", "What the board drives: voltage (default) or current.", "KIND"});
    parser.addOption({"largest", "The stimulator's largest amplitude, V or mA (default 100).", "X"});
    parser.addOption({"step", "The stimulator's step of amplitude, V or mA; 0, the default: none.", "X"});
    parser.addOption({"device",
                      "The board's stimulator, in place of --source, --largest and --step, as the bench has it that "
                      "the board is to encode for; of firmware-profile also its sensors (sensor:, in place of "
                      "--recording).",
                      "URI"});
}

bool encoderOptionsGiven(const QCommandLineParser& parser) {
    return parser.isSet("load") || parser.isSet("device") ||
           std::ranges::any_of(kStated, [&](const char* option) { return parser.isSet(option); });
}

Result<EncoderBench> encoderBench(const QCommandLineParser& parser) {
    auto output = statedOutput(parser);
    if (!output) return failure(output);
    EncoderBench bench{std::move(*output), {}, {}};
    const SteadyClock clock;
    const auto devices = devicesOf(parser, clock);
    if (!devices) return failure(devices);
    if (devices->stimulator) bench.output.source = devices->stimulator->traits();
    if (devices->sensor) {
        const auto own = devices->sensor->streams();
        bench.streams.assign(own.begin(), own.end());
        bench.fingertip = devices->sensor->identity().serial;
    }
    return bench;
}

}  // namespace tacto::cli
