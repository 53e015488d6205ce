// certificate: the calibration certificates of the laboratory's oscilloscopes.
#include <nlohmann/json.hpp>

#include "app/cli/Command.h"
#include "core/calibration/CertificateStore.h"
#include "core/exchange/dcc/DccCertificate.h"

namespace tacto::cli {

namespace {

void declareCertificate(QCommandLineParser& parser) {
    parser.addOption({"instrument", "Maker and model of the oscilloscope.", "NAME"});
    parser.addOption({"serial", "Its serial number, as tactoscope-cli devices shows it.", "S"});
    parser.addOption({"number", "Number of the certificate.", "N"});
    parser.addOption({"by", "The laboratory that issued it.", "LAB"});
    parser.addOption({"date", "Its date, as 2026-11-21.", "D"});
    parser.addOption({"due", "The last day on which it counts, as 2027-11-20.", "D"});
    for (const auto& figure : kCertificateFigures) {
        parser.addOption(
            {figure.option,
             QString::fromStdString(fmt::format("Expanded uncertainty (k = 2) of the {} in {}{}.", figure.title,
                                                figure.unit, figure.required ? "" : "; absent: not stated")),
             "U"});
    }
    parser.addOption({"dcc",
                      "Reads a digital calibration certificate (DCC 3, XML); again for the one of a shunt or a probe. "
                      "The other options give what it does not state.",
                      "FILE"});
    parser.addOption({"json", "Prints one JSON value."});
}

nlohmann::json toJson(const CertificateStore& store, std::size_t index, CalibrationDate today) {
    const auto& [certificate, entered, withdrawn] = store.all()[index];
    auto out = tacto::toJson(certificate);
    const auto state = store.state(index, today);
    out["state"] = nameOf(state);
    out["used"] = state == CertificateState::Counts;
    out["entered"] = dateText(entered);
    out["withdrawn"] = withdrawn ? nlohmann::json(dateText(*withdrawn)) : nlohmann::json(nullptr);
    return out;
}

int list(const CertificateStore& store, bool json) {
    const auto today = utcToday();
    if (store.lastLineCut()) {
        say(stderr, "{}: the last line was cut short while it was written and is left out\n",
            certificateFile().string());
    }
    if (json) {
        auto all = nlohmann::json::array();
        for (std::size_t i = 0; i < store.all().size(); ++i) all.push_back(toJson(store, i, today));
        printJson(all);
        return kDone;
    }
    for (std::size_t i = 0; i < store.all().size(); ++i) {
        const auto& certificate = store.all()[i].certificate;
        const auto state = store.state(i, today);
        say("{} {}: {}: {}{}\n    {}\n", certificate.instrument, certificate.serial, certificateText(certificate),
            nameOf(state), state == CertificateState::Counts ? "" : ", not used", figuresText(certificate));
    }
    if (store.all().empty()) say(stderr, "No certificate is entered.\n");
    return kDone;
}

/// Returns what the options say; `all`: each that is required must be there. Errors: InvalidArgument naming the option
/// and what is accepted.
Result<Certificate> certificateGiven(const QCommandLineParser& parser, bool all) {
    Certificate out;
    for (const auto& text : kCertificateTexts)
        out.*text.member = parser.value(QString::fromStdString(std::string(text.key))).trimmed().toStdString();
    for (const auto& [name, day] : {std::pair{"date", &Certificate::date}, std::pair{"due", &Certificate::due}}) {
        if (!all && !parser.isSet(name)) continue;
        const auto text = parser.value(name).toStdString();
        const auto date = parseDate(text);
        if (!date) {
            return fail(ErrorCode::InvalidArgument, "--{} is \"{}\"; a day as 2026-11-21 is expected", name, text);
        }
        out.*day = *date;
    }
    for (const auto& figure : kCertificateFigures) {
        if (!parser.isSet(figure.option) && !(all && figure.required)) continue;
        const auto u = numberOption(parser, figure.option);
        if (!u) return failure(u);
        out.*figure.member = *u;
    }
    return out;
}

/// Returns what the files of --dcc say, with what the options add. Errors: as readDcc() and certificateFrom().
Result<DccCertificate> certificateRead(const QCommandLineParser& parser, const Certificate& given) {
    std::vector<DccFile> files;
    for (const auto& path : parser.values("dcc")) {
        auto file = readDcc(path.toStdString());
        if (!file) return failure(file);
        files.push_back(std::move(*file));
    }
    return certificateFrom(files, given);
}

int add(CertificateStore& store, const QCommandLineParser& parser) {
    const bool digital = parser.isSet("dcc");
    const auto given = certificateGiven(parser, !digital);
    if (!given) return usage("certificate add: " + given.error().message);
    DccCertificate read{*given, {}};
    if (digital) {
        auto found = certificateRead(parser, *given);
        if (!found) return couldNotRun(found.error());
        read = std::move(*found);
    }
    const auto& certificate = read.certificate;
    const auto today = utcToday();
    if (const auto added = store.add(certificate, today); !added) return failWith(added.error());
    const auto index = store.all().size() - 1;
    const auto state = store.state(index, today);
    if (parser.isSet("json")) {
        auto value = toJson(store, index, today);
        if (digital) value["notes"] = read.notes;
        printJson(value);
    } else {
        say("{}: entered for {} {}; {}\n", certificateText(certificate), certificate.instrument, certificate.serial,
            figuresText(certificate));
        for (const auto& note : read.notes) say("    {}\n", note);
    }
    if (state != CertificateState::Counts) say(stderr, "It is {}: its figures are not used.\n", nameOf(state));
    return kDone;
}

int withdraw(CertificateStore& store, const QCommandLineParser& parser, const std::string& number) {
    const auto serial = parser.value("serial").toStdString();
    if (const auto done = store.withdraw(number, serial, utcToday()); !done) return failWith(done.error());
    say(stderr, "Certificate {} is withdrawn: its figures are not used any more.\n", number);
    return kDone;
}

/// Refuses options that are not used, because a user would think that they had an effect.
int onlyOptions(const QCommandLineParser& parser, const QString& word, const QStringList& known) {
    for (const auto& option : parser.optionNames()) {
        if (!known.contains(option))
            return usage(fmt::format("certificate {} takes no --{}", word.toStdString(), option.toStdString()));
    }
    return kDone;
}

int runCertificate(const QCommandLineParser& parser) {
    const auto words = parser.positionalArguments();
    const auto word = words.isEmpty() ? QString() : words.front();
    const qsizetype expected = word == "withdraw" ? 2 : 1;
    if (word != "list" && word != "add" && word != "withdraw") {
        return usage(words.isEmpty() ? std::string("certificate: list, add or withdraw is missing")
                                     : fmt::format("certificate: there is no \"{}\"; list, add or withdraw is expected",
                                                   word.toStdString()));
    }
    if (words.size() != expected) {
        return usage(expected == 2 ? std::string("certificate withdraw: one NUMBER is expected")
                                   : fmt::format("certificate {}: \"{}\" is not an option; options are expected",
                                                 word.toStdString(), words.at(1).toStdString()));
    }
    if (word != "add") {
        const auto known = word == "list" ? QStringList{"json"} : QStringList{"serial"};
        if (const int code = onlyOptions(parser, word, known); code != kDone) return code;
    }
    auto store = CertificateStore::open(certificateFile());
    if (!store) return couldNotRun(store.error());
    if (word == "list") return list(*store, parser.isSet("json"));
    if (word == "add") return add(*store, parser);
    return withdraw(*store, parser, words.at(1).toStdString());
}

}  // namespace

const Command kCertificate{
    "certificate",
    "{list [--json] | add --instrument NAME --serial S --number N --by LAB --date D --due D "
    "--gain-u PCT [--timebase-u-ppm X] [--shunt-u PCT] [--probe-u PCT] [--json] | add --dcc "
    "FILE [--dcc FILE]... [--serial S] [--due D] [--gain-u PCT] [--timebase-u-ppm X] [--shunt-u PCT] "
    "[--probe-u PCT] [--instrument NAME] [--json] | withdraw NUMBER [--serial S]}",
    "The calibration certificates of oscilloscopes", declareCertificate, runCertificate};

}  // namespace tacto::cli
