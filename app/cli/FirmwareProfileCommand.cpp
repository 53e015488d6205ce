// firmware-profile: a profile for a board that encodes by itself (resources/firmware/tactile_encoder).
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/run/AllDrivers.h"
#include "app/run/OpenDevices.h"
#include "core/acquisition/Recording.h"
#include "core/bench/Profile.h"
#include "core/bench/arming/CommandPreview.h"
#include "drivers/sensor_board/EncoderProfile.h"

namespace tacto::cli {

namespace {

void declareFirmwareProfile(QCommandLineParser& parser) {
    parser.addOption({"out", "C header (.h) or bytes (.bin) to write.", "FILE"});
    parser.addOption({"load", "Load in ohm, a resistance; the board's ceilings are judged at ± 20 % of it.", "OHM"});
    parser.addOption({"source", "What the board drives: voltage (default) or current.", "KIND"});
    parser.addOption({"largest", "The stimulator's largest amplitude, V or mA (default 100).", "X"});
    parser.addOption({"step", "The stimulator's step of amplitude, V or mA; 0, the default: none.", "X"});
    parser.addOption({"recording",
                      "A recording of the board's sensors, for their rates, channels and units. Without it: 3 axes in "
                      "m/s2 at 4000 Hz, force in N and 8 taxels in Pa at 200 Hz.",
                      "FOLDER"});
    parser.addOption({"device",
                      "The board's sensors (sensor:, in place of --recording) or its stimulator (in place of --source, "
                      "--largest and --step), as the bench has them that the board is to encode for.",
                      "URI"});
    parser.addOption({"json", "Prints one JSON value."});
}

std::vector<StreamInfo> usualStreams() {
    return {{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"}};
}

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
    for (const auto* option : {"source", "largest", "step"})
        if (devices->stimulator && parser.isSet(option)) return invalid("--{} and a stimulator are given", option);
    if (devices->sensor && parser.isSet("recording")) return invalid("--recording and a sensor are given");
    return devices;
}

Result<EncoderOutput> outputOptions(const QCommandLineParser& parser) {
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
    for (const auto& [name, into] :
         {std::pair{"largest", &output.source.amplitudeMax}, std::pair{"step", &output.source.amplitudeStep}}) {
        if (!parser.isSet(name)) continue;
        const auto number = numberOption(parser, name);
        if (!number) return failure(number);
        *into = *number;
    }
    return output;
}

int runFirmwareProfile(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "PROFILE");
    if (!path) return usage("firmware-profile: " + path.error().message);
    const auto out = parser.value("out").toStdString();
    const bool header = out.ends_with(".h");
    if (!header && !out.ends_with(".bin"))
        return usage(fmt::format("firmware-profile: --out is \"{}\"; FILE.h or FILE.bin is expected", out));
    auto output = outputOptions(parser);
    if (!output) return usage("firmware-profile: " + output.error().message);
    const auto profile = loadProfile(*path);
    if (!profile) return couldNotRun(profile.error());
    output->ceilings = profile->ceilings;
    const SteadyClock clock;
    const auto devices = devicesOf(parser, clock);
    if (!devices) {
        const bool wrong = devices.error().code == ErrorCode::InvalidArgument;
        return wrong ? usage("firmware-profile: " + devices.error().message) : couldNotRun(devices.error());
    }
    if (devices->stimulator) output->source = devices->stimulator->traits();
    auto streams = usualStreams();
    std::string fingertip;
    if (parser.isSet("recording")) {
        const auto recording = Recording::open(parser.value("recording").toStdString());
        if (!recording) return couldNotRun(recording.error());
        streams = recording->infos();
        fingertip = recording->fingertip;
    }
    if (devices->sensor) {
        const auto own = devices->sensor->streams();
        streams.assign(own.begin(), own.end());
        fingertip = devices->sensor->identity().serial;
    }
    if (const auto another = madeWithAnother(*profile, fingertip); another && !fingertip.empty())
        say(stderr, "{}\n", *another);
    const auto encoder = encoderProfile(streams, profile->roughness, profile->encoding, *output, fingertip);
    if (!encoder) return failWith(encoder.error());
    const auto content = header ? profileHeader(*encoder, profile->name) : profileBytes(*encoder);
    if (const auto written = writeFile(out, content); !written) return couldNotRun(written.error());
    const auto hash = fmt::format("{:08x}", encoder->hash);
    if (parser.isSet("json"))
        printJson({{"out", out}, {"hash", hash}, {"bytes", profileBytes(*encoder).size()}});
    else
        say(stdout, "{}: {}, hash {}\n", out, profile->name, hash);
    return kDone;
}

}  // namespace

const Command kFirmwareProfile{"firmware-profile",
                               "PROFILE --load OHM --out FILE.{h|bin} [--source KIND] [--largest X] [--step X] "
                               "[--recording FOLDER] [--device URI]... [--json]",
                               "A profile for a board that encodes by itself", declareFirmwareProfile,
                               runFirmwareProfile};

}  // namespace tacto::cli
