// firmware-profile: a profile for a board that encodes by itself (resources/firmware/tactile_encoder).
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/cli/EncoderOptions.h"
#include "core/acquisition/Recording.h"
#include "core/bench/Profile.h"

namespace tacto::cli {

namespace {

void declareFirmwareProfile(QCommandLineParser& parser) {
    parser.addOption({"out", "C header (.h) or bytes (.bin) to write.", "FILE"});
    declareEncoderOptions(parser);
    parser.addOption({"recording",
                      "A recording of the board's sensors, for their rates, channels and units. Without it: 3 axes in "
                      "m/s2 at 4000 Hz, force in N and 8 taxels in Pa at 200 Hz.",
                      "FOLDER"});
    parser.addOption({"json", "Prints one JSON value."});
}

std::vector<StreamInfo> usualStreams() {
    return {{StreamKind::Acceleration, StreamUnit::MetrePerSecondSquared, 3, 4000, "acceleration"},
            {StreamKind::Force, StreamUnit::Newton, 1, 200, "force"},
            {StreamKind::Taxels, StreamUnit::Pascal, 8, 200, "taxels"}};
}

int runFirmwareProfile(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "PROFILE");
    if (!path) return usage("firmware-profile: " + path.error().message);
    const auto out = parser.value("out").toStdString();
    const bool header = out.ends_with(".h");
    if (!header && !out.ends_with(".bin"))
        return usage(fmt::format("firmware-profile: --out is \"{}\"; FILE.h or FILE.bin is expected", out));
    const auto profile = loadProfile(*path);
    if (!profile) return couldNotRun(profile.error());
    auto bench = encoderBench(parser);
    if (!bench) {
        const bool wrong = bench.error().code == ErrorCode::InvalidArgument;
        return wrong ? usage("firmware-profile: " + bench.error().message) : couldNotRun(bench.error());
    }
    bench->output.ceilings = profile->ceilings;
    auto streams = bench->streams.empty() ? usualStreams() : bench->streams;
    std::string fingertip = bench->fingertip;
    if (parser.isSet("recording")) {
        if (!bench->streams.empty()) return usage("firmware-profile: --recording and a sensor are given");
        const auto recording = Recording::open(parser.value("recording").toStdString());
        if (!recording) return couldNotRun(recording.error());
        streams = recording->infos();
        fingertip = recording->fingertip;
    }
    if (const auto another = madeWithAnother(*profile, fingertip); another && !fingertip.empty())
        say(stderr, "{}\n", *another);
    const auto encoder = encoderProfile(streams, profile->roughness, profile->encoding, bench->output, fingertip);
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
