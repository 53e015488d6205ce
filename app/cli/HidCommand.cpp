// hid show-bytes: prints the bytes that a massager would receive; needs no massager.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/base/LocaleFreeText.h"
#include "drivers/hid_massager/MassagerTemplate.h"

namespace tacto::cli {

namespace {

void declareHid(QCommandLineParser& parser) {
    parser.addOption({"intensity", "Intensity of the burst, 0 to 1.", "X"});
    parser.addOption({"length", "Length of the report in bytes, where the template accepts several.", "N"});
    parser.addOption({"json", "Prints one JSON value."});
}

/// Returns the template for a shipped name or a file. Errors: NotFound naming the shipped templates; ParseError.
Result<hid::MassagerTemplate> templateOf(const std::string& name) {
    if (name.ends_with(".json")) return hid::loadMassagerTemplate(name);
    const auto resources = resourcesFolder();
    if (!resources) return failure(resources);
    auto shipped = hid::loadMassagerTemplates(*resources / "massagers");
    if (!shipped) return failure(shipped);
    std::vector<std::string_view> names;
    for (auto& one : *shipped) {
        if (one.key == name) return std::move(one);
        names.push_back(one.key);
    }
    return fail(ErrorCode::NotFound, "there is no template \"{}\"; there are {}, or a file that ends in .json", name,
                fmt::join(names, ", "));
}

Result<std::size_t> lengthOption(const QCommandLineParser& parser, const hid::MassagerTemplate& described) {
    if (!parser.isSet("length")) return described.lengths.front();
    const auto text = parser.value("length").toStdString();
    const auto number = parseNumber(text);
    for (const auto length : described.lengths) {
        if (number && *number == static_cast<double>(length)) return length;
    }
    return fail(ErrorCode::InvalidArgument, "--length is \"{}\"; {} is accepted, which this template describes", text,
                fmt::join(described.lengths, " or "));
}

void print(const hid::MassagerTemplate& described, const hid::VibrationReports& reports,
           const std::vector<std::uint8_t>& bytes, double intensity) {
    say("{}: report {:02X}, {} bytes\n", described.title, described.report, bytes.size());
    say("intensity {:g}  {}\n", intensity, hid::hexOf(bytes));
    say("stop         {}\n", hid::hexOf(reports.stop));
    for (const auto& field : reports.fields) {
        say("byte {}, bit {}, {} bits: {} = {} ({} to {})\n", field.bit / 8, field.bit % 8, field.bits,
            hid::nameOf(field.role), hid::valueOf(field, bytes), field.min, field.max);
    }
}

void printAsJson(const hid::MassagerTemplate& described, const hid::VibrationReports& reports,
                 const std::vector<std::uint8_t>& bytes, double intensity) {
    auto fields = nlohmann::json::array();
    for (const auto& field : reports.fields) {
        fields.push_back({{"role", hid::nameOf(field.role)},
                          {"byte", field.bit / 8},
                          {"bit", field.bit % 8},
                          {"bits", field.bits},
                          {"value", hid::valueOf(field, bytes)}});
    }
    printJson({{"template", described.key},
               {"title", described.title},
               {"report", described.report},
               {"length", bytes.size()},
               {"intensity", intensity},
               {"bytes", bytes},
               {"stop", reports.stop},
               {"fields", std::move(fields)},
               {"keep_alive_s", reports.keepAlive.count()},
               {"shortest_write_s", reports.shortestWrite.count()}});
}

int runHid(const QCommandLineParser& parser) {
    const auto given = parser.positionalArguments();
    if (given.isEmpty() || given.front() != "show-bytes") {
        return usage(given.isEmpty()
                         ? std::string("hid: show-bytes is missing, as in hid show-bytes dualsense --intensity 0.5")
                         : fmt::format("hid: there is no \"{}\"; show-bytes is expected", given.front().toStdString()));
    }
    if (given.size() != 2) {
        return usage("hid show-bytes: one TEMPLATE is expected, the name of a shipped one or a file");
    }
    const auto intensity = numberOption(parser, "intensity");
    if (!intensity) return usage("hid show-bytes: " + intensity.error().message);
    if (!(*intensity >= 0 && *intensity <= 1)) {
        return usage(fmt::format("hid show-bytes: --intensity is {}; 0 to 1 is expected", *intensity));
    }
    const auto described = templateOf(given.at(1).toStdString());
    if (!described) return couldNotRun(described.error());
    const auto length = lengthOption(parser, *described);
    if (!length) return usage("hid show-bytes: " + length.error().message);
    const auto reports = described->reports(*length);
    if (!reports) return couldNotRun(reports.error());
    const auto bytes = hid::startBytes(*reports, *intensity);
    if (!bytes) return failWith(bytes.error());
    if (parser.isSet("json"))
        printAsJson(*described, *reports, *bytes, *intensity);
    else
        print(*described, *reports, *bytes, *intensity);
    return kDone;
}

}  // namespace

const Command kHid{"hid", "show-bytes TEMPLATE --intensity X [--length N] [--json]",
                   "The bytes that a massager's template makes of an intensity", declareHid, runHid};

}  // namespace tacto::cli
