#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/run/CaptureFormatsList.h"
#include "core/base/QuantityText.h"

namespace tacto::cli {

namespace {

void declareConvert(QCommandLineParser& parser) {
    parser.addOption({"out", "File to write; its suffix says the format (.csv, .wav, …).", "FILE"});
    declareCaptureOptions(parser);
    parser.addOption({"json", "Prints one JSON value."});
}

int runConvert(const QCommandLineParser& parser) {
    const auto path = onlyArgument(parser, "CAPTURE");
    if (!path) return usage("convert: " + path.error().message);
    if (!parser.isSet("out")) return usage("convert: --out is missing; a file to write is expected");
    const auto out = parser.value("out").toStdString();
    const auto options = captureOptions(parser);
    if (!options) return usage("convert: " + options.error().message);
    const auto formats = captureFormats();
    if (const auto writable = formats->writerOf(out); !writable) return usage("convert: " + writable.error().message);
    // The output may be the input under another name: through a link, or with dots in the path.
    std::error_code none;
    if (std::filesystem::equivalent(*path, out, none)) {
        return usage(fmt::format("convert: --out is {}, the file that is read; another one is expected", out));
    }
    const auto reading = readCaptureFile(*path, *options);
    if (!reading) return couldNotRun(reading.error());
    if (const auto written = formats->write(out, reading->capture); !written) return couldNotRun(written.error());
    const auto& capture = reading->capture;
    if (parser.isSet("json")) {
        printJson({{"format", reading->formatId},
                   {"channels", capture.channels.size()},
                   {"samples", capture.samples()},
                   {"rate_hz", capture.rate_hz},
                   {"file", out},
                   {"warnings", reading->warnings}});
        return kDone;
    }
    say("{}: {} of {} at {} from {} written\n", out,
        capture.channels.size() == 1 ? "a channel" : fmt::format("{} channels", capture.channels.size()),
        fmt::format("{} samples", capture.samples()), scaledText(capture.rate_hz, "S/s", 4), reading->formatName);
    for (const auto& warning : reading->warnings) say(stderr, "{}\n", warning);
    return kDone;
}

}  // namespace

const Command kConvert{"convert", "CAPTURE --out FILE [--format ID] [--json]",
                       "An oscilloscope record in another format: CSV, WAV, sigrok", declareConvert, runConvert};

}  // namespace tacto::cli
