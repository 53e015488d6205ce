#include <nlohmann/json.hpp>

#include "app/cli/CaptureOptions.h"
#include "app/cli/Command.h"
#include "app/cli/TextTable.h"
#include "app/run/Shipped.h"
#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/QuantityText.h"
#include "core/bench/arming/CommandPreview.h"

namespace tacto::cli {

namespace {

void declareEncode(QCommandLineParser& parser) {
    parser.addOption({"roughness", "Roughness index, 0 to 1.", "R"});
    parser.addOption({"pressure-pa", "Contact pressure in Pa, 0 or more.", "P"});
    parser.addOption({"load", "Declared load in ohm; the limits are judged at ± 20 % of it.", "OHM"});
    parser.addOption({"profile", "Profile to use instead of the shipped one.", "F"});
    parser.addOption({"json", "Prints one JSON value."});
}

Result<Load> loadOption(const QCommandLineParser& parser) {
    if (!parser.isSet("load")) return fail(ErrorCode::InvalidArgument, "--load is missing");
    return parseLoad(parser.value("load").toStdString());
}

int runEncode(const QCommandLineParser& parser) {
    if (!parser.positionalArguments().isEmpty()) {
        return usage(fmt::format("encode takes options only, and \"{}\" is not one",
                                 parser.positionalArguments().front().toStdString()));
    }
    const auto roughness = numberOption(parser, "roughness");
    if (!roughness) return usage("encode: " + roughness.error().message);
    if (!(*roughness >= 0 && *roughness <= 1)) {
        return usage(fmt::format("encode: --roughness is {}; 0 to 1 is expected", *roughness));
    }
    const auto pressure_pa = numberOption(parser, "pressure-pa");
    if (!pressure_pa) return usage("encode: " + pressure_pa.error().message);
    if (!(*pressure_pa >= 0)) {
        return usage(fmt::format("encode: --pressure-pa is {}; 0 or more is expected", *pressure_pa));
    }
    const auto load = loadOption(parser);
    if (!load) return usage("encode: " + load.error().message);
    const auto profile = profileOption(parser);
    if (!profile) return couldNotRun(profile.error());
    const auto limits = shippedLimits();
    if (limits && !addedLimitsText(*limits).empty()) say(stderr, "{}\n", addedLimitsText(*limits));
    if (!limits) return couldNotRun(limits.error());

    const double P = pressureIndex(*pressure_pa, profile->roughness);
    const auto command = Encoder(profile->encoding).encode(*roughness, P);
    if (!command) return failWith(command.error());

    const auto preview = previewOf(*command, *profile, limits->sets, *load);
    if (!preview) return couldNotRun(preview.error());
    const auto& refusal = preview->refusal;
    const double amplitude_ma = command->amplitude.value() / preview->impedance.value() * 1e3;
    if (parser.isSet("json")) {
        printJson({{"amplitude_v", command->amplitude.value()},
                   {"amplitude_ma", numberOrNull(amplitude_ma)},
                   {"interval_s", command->interval.count()},
                   {"approved", !refusal},
                   {"refusal", refusal ? nlohmann::json(refusal->message) : nlohmann::json(nullptr)}});
    } else {
        TextTable table({"", ""});
        table.add({"amplitude", fmt::format("{}  ({} into {})", scaledText(command->amplitude.value(), "V", 4),
                                            scaledText(amplitude_ma * 1e-3, "A", 4), load->text())});
        table.add({"interval", scaledText(command->interval.count(), "s", 4)});
        table.add({"approved",
                   refusal ? fmt::format("no: {}", refusal->message) : "yes, from 80 to 120 % of the declared load"});
        table.print();
    }
    return refusal ? kStopped : kDone;
}

}  // namespace

const Command kEncode{"encode", "--roughness R --pressure-pa P --load OHM [--profile F] [--json]",
                      "Amplitude and interval for a roughness and a pressure, judged against the limits", declareEncode,
                      runEncode};

}  // namespace tacto::cli
