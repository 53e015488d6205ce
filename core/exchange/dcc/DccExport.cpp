#include "core/exchange/dcc/DccExport.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

#include "core/base/Clock.h"
#include "core/base/JsonText.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Printable.h"
#include "core/base/WholeFile.h"
#include "core/calibration/CertificateDetails.h"
#include "core/calibration/CertificateStore.h"
#include "core/exchange/dcc/DccNames.h"
#include "core/session/Origin.h"

namespace tacto {

namespace dcc {
namespace {

using nlohmann::json;
using pugi::xml_node;

constexpr const char* kUnknown = "unknown";
constexpr double kCoverage = 0.95;

/// What the session says of its calibration.
struct Calibration {
    json results;   ///< the report's item "certificate"
    json details;   ///< what people entered: CertificateDetails.h; null: nothing
    json evidence;  ///< the calibrations that were stored, by quantity; null: none
    std::string ambient, operatorName, sample;
    std::string verdict;
    std::optional<Certificate> oscilloscope;
    std::string traceability;  ///< the sentence about the oscilloscope's certificate
};

Result<Calibration> calibrationOf(const ExportSource& source) {
    Calibration all;
    all.operatorName = textOr(source.description(), "operator");
    all.sample = textOr(source.description(), "sample");
    auto read = source.forEachMoment([&](const ExportRow& row) -> Result<void> {
        const auto& details = row.details;
        const auto later = [&](const char* key, std::string& into) {
            if (auto text = textOr(details, key); !text.empty()) into = std::move(text);
        };
        if (row.kind == "verdict") {
            all.verdict = textOr(details, "verdict");
        } else if (row.kind == "measurement" && row.name == kCalibrationMeasurement) {
            all.evidence = details;
        } else if (row.kind == "event" && row.name == kCertificateEvent) {
            all.traceability = textOr(details, "text");
            if (auto certificate = certificateFrom(valueOr(details, "certificate"))) all.oscilloscope = *certificate;
        } else if (row.kind == "report") {
            const auto kind = textOr(details, "kind");
            if (kind == "certificate") all.results = details;
            if (kind == "certificate details") all.details = details;
            if (kind == "notes") {
                later("ambient", all.ambient);
                if (all.operatorName.empty()) later("operator", all.operatorName);
                if (all.sample.empty()) later("sample", all.sample);
            }
        }
        return {};
    });
    if (!read) return failure(read);
    const auto refused = [&](std::string_view why) {
        return fail(ErrorCode::Unsupported, "{} makes no calibration certificate: {}", source.name(), why);
    };
    if (source.damaged()) return refused("the session is not what was recorded");
    if (all.results.is_null())
        return refused("it holds no new calibration of a stimulator; a session of stimulator-calibration is expected");
    if (all.verdict.empty() || all.verdict == "stopped") return refused("the run did not come to its verdict");
    for (const auto& device : source.about().devices) {
        const auto from = originOf(device);
        if (from != origin::kHardware && from != origin::kSimulated) return refused("its readings come from files");
    }
    return all;
}

/// Text that XML and the schema accept: something, without control characters, and blanks only between words.
std::string plain(std::string_view text, const char* otherwise = kUnknown) {
    const auto shown = printable(trimmed(text));
    return shown.empty() ? otherwise : shown;
}

xml_node addText(xml_node to, const char* name, std::string_view text) {
    auto node = to.append_child(name);
    node.text().set(plain(text).c_str());
    return node;
}
/// <name><dcc:content lang="en">text</dcc:content>...</name>
xml_node addContent(xml_node to, const char* name, std::initializer_list<std::string_view> texts) {
    auto node = to.append_child(name);
    for (const auto text : texts) addText(node, "dcc:content", text).append_attribute("lang") = "en";
    return node;
}
xml_node addWith(xml_node to, const char* name, const char* refType) {
    auto node = to.append_child(name);
    node.append_attribute("refType") = refType;
    return node;
}

std::string numberText(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "NaN"; }
/// A level as it was set, 0.65 and not 0.6499999999999999.
std::string levelText(double value) { return std::isfinite(value) ? fmt::format("{:.12g}", value) : "NaN"; }
/// D-SI has no exponents here, and no factor below 1.
std::string factorText(double k) {
    constexpr double kMax = 1e15;
    return k >= 1 && k < kMax ? fmt::format("{}", k) : "NaN";
}
std::string unitOf(std::string_view unit) {
    if (unit == "V") return "\\volt";
    if (unit == "mA") return "\\milli\\ampere";
    if (unit == "s") return "\\second";
    return "\\one";
}

/// A list of values with their uncertainties, as far as those are known.
struct Values {
    std::vector<double> values, uncertainties, factors;
};

std::string listText(const std::vector<double>& all, std::string (*text)(double) = numberText) {
    std::string joined;
    for (const double each : all) joined += (joined.empty() ? "" : " ") + text(each);
    return joined;
}

void addReal(xml_node to, double value, std::string_view unit, double u, double k) {
    auto real = to.append_child("si:real");
    addText(real, "si:value", numberText(value));
    addText(real, "si:unit", unit);
    if (!std::isfinite(u) || !std::isfinite(k)) return;
    auto expanded = real.append_child("si:measurementUncertaintyUnivariate").append_child("si:expandedMU");
    addText(expanded, "si:valueExpandedMU", numberText(u));
    addText(expanded, "si:coverageFactor", factorText(k));
    addText(expanded, "si:coverageProbability", numberText(kCoverage));
}

void addList(xml_node to, const Values& of, std::string_view unit, std::string (*text)(double) = numberText) {
    auto list = to.append_child("si:realListXMLList");
    addText(list, "si:valueXMLList", listText(of.values, text));
    addText(list, "si:unitXMLList", unit);
    if (std::ranges::none_of(of.uncertainties, [](double u) { return std::isfinite(u); })) return;
    auto expanded =
        list.append_child("si:measurementUncertaintyUnivariateXMLList").append_child("si:expandedMUXMLList");
    addText(expanded, "si:valueExpandedMUXMLList", listText(of.uncertainties));
    addText(expanded, "si:coverageFactorXMLList", listText(of.factors, factorText));
    // Written for each: dccQuantities 3.0 takes the first k for all when there is one probability.
    addText(expanded, "si:coverageProbabilityXMLList", listText(std::vector<double>(of.values.size(), kCoverage)));
}

class Writer {
public:
    Writer(const ExportSource& source, const Calibration& calibration) : source_(source), of_(calibration) {}

    [[nodiscard]] std::string text() {
        pugi::xml_document document;
        auto root = document.append_child("dcc:digitalCalibrationCertificate");
        root.append_attribute("xmlns:dcc") = kNamespace;
        root.append_attribute("xmlns:si") = kUnitNamespace;
        root.append_attribute("xmlns:xsi") = "http://www.w3.org/2001/XMLSchema-instance";
        root.append_attribute("xsi:schemaLocation") = "https://ptb.de/dcc https://ptb.de/dcc/v3.3.0/dcc.xsd";
        root.append_attribute("schemaVersion") = "3.3.0";
        addAdministrative(root.append_child("dcc:administrativeData"));
        addResults(root.append_child("dcc:measurementResults").append_child("dcc:measurementResult"));
        std::ostringstream out;
        out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
        document.save(out, "  ", pugi::format_indent | pugi::format_no_declaration, pugi::encoding_utf8);
        return std::move(out).str();
    }

private:
    /// What was entered; else it is noted as unknown.
    [[nodiscard]] std::string entered(std::string_view key, std::string_view known = {}) {
        const auto detail = std::ranges::find(kCertificateDetails, key, &CertificateDetail::key);
        if (auto text = textOr(of_.details, std::string(key).c_str()); !text.empty()) return text;
        if (!known.empty()) return std::string(known);
        unknown_ += fmt::format("{}{}", unknown_.empty() ? "" : ", ", lowered(detail->title));
        return kUnknown;
    }
    [[nodiscard]] const SessionDevice* deviceOf(Role role) const {
        const auto& all = source_.about().devices;
        const auto found = std::ranges::find_if(all, [role](const SessionDevice& each) { return each.is(role); });
        return found == all.end() ? nullptr : &*found;
    }
    [[nodiscard]] std::string dayAfter(double seconds) const {
        const auto wall = wallTimeFrom(source_.wallStart());
        if (!wall) return source_.wallStart().substr(0, std::string_view("2026-11-21").size());
        const auto day = std::chrono::floor<std::chrono::days>(
            *wall + std::chrono::round<std::chrono::seconds>(std::chrono::duration<double>(seconds)));
        return dateText(CalibrationDate(day));
    }

    static void identify(xml_node to, const char* issuer, std::string_view value, std::string_view name,
                         const char* refType = nullptr) {
        auto one = to.append_child("dcc:identification");
        if (refType != nullptr) one.append_attribute("refType") = refType;
        addText(one, "dcc:issuer", issuer);
        addText(one, "dcc:value", value);
        addContent(one, "dcc:name", {name});
    }
    static void addSoftware(xml_node to, std::string_view name, std::string_view release, const char* type) {
        auto one = to.append_child("dcc:software");
        addContent(one, "dcc:name", {name});
        addText(one, "dcc:release", release);
        addText(one, "dcc:type", type);
    }
    static void addContact(xml_node to, const char* name, std::string_view who, std::string_view where) {
        auto contact = to.append_child(name);
        addContent(contact, "dcc:name", {who});
        addContent(contact.append_child("dcc:location"), "dcc:further", {where});
    }

    void addAdministrative(xml_node to) {
        addSoftware(to.append_child("dcc:dccSoftware"), "Tactoscope", source_.version(), "application");
        addCore(to.append_child("dcc:coreData"));
        addItem(to.append_child("dcc:items").append_child("dcc:item"));
        auto laboratory = to.append_child("dcc:calibrationLaboratory");
        const auto name = entered("laboratory"), address = entered("address");
        addContact(laboratory, "dcc:contact", name, address);
        for (const char* each :
             {"dcc:cryptElectronicSeal", "dcc:cryptElectronicSignature", "dcc:cryptElectronicTimeStamp"})
            addText(laboratory, each, "false");
        auto persons = to.append_child("dcc:respPersons");
        const auto authority = entered("authorised_by"), function = entered("function");
        addPerson(persons, authority, function, "authorises the certificate");
        if (!of_.operatorName.empty()) addPerson(persons, of_.operatorName, "operator", "carried out the calibration");
        const auto customer = entered("customer"), contact = entered("contact");
        addContact(to, "dcc:customer", customer, contact);
        addStatements(to.append_child("dcc:statements"));
    }
    static void addPerson(xml_node to, std::string_view who, std::string_view role, std::string_view does) {
        auto one = to.append_child("dcc:respPerson");
        addContent(one.append_child("dcc:person"), "dcc:name", {who});
        addContent(one, "dcc:description", {does});
        addText(one, "dcc:role", role);
        addText(one, "dcc:cryptElectronicSignature", "false");
    }

    void addCore(xml_node to) {
        addText(to, "dcc:countryCodeISO3166_1", "ZZ");
        addText(to, "dcc:usedLangCodeISO639_1", "en");
        addText(to, "dcc:mandatoryLangCodeISO639_1", "en");
        // The printed certificate has the same number.
        const auto own = source_.name() + "-" + source_.chainHead().substr(0, 8);
        addText(to, "dcc:uniqueIdentifier", entered("number", own));
        auto ids = to.append_child("dcc:identifications");
        identify(ids, "other", own, "session and the beginning of its chain head");
        identify(ids, "other", source_.chainHead(), "head of the chain of hashes over the session's readings");
        if (const auto day = textOr(of_.details, "received"); !day.empty()) addText(to, "dcc:receiptDate", day);
        addText(to, "dcc:beginPerformanceDate", dayAfter(0));
        addText(to, "dcc:endPerformanceDate", dayAfter(source_.duration_s()));
        addText(to, "dcc:performanceLocation", "other");  // a statement says where
        if (const auto day = textOr(of_.details, "issued"); !day.empty()) addText(to, "dcc:issueDate", day);
    }

    void addItem(xml_node to) {
        const auto* device = deviceOf(Role::Stimulator);
        addContent(to, "dcc:name", {of_.sample.empty() ? "stimulator" : "stimulator, " + of_.sample});
        addContent(to, "dcc:description", {"Condition at receipt: " + entered("condition")});
        if (device != nullptr && !device->firmware.empty())
            addSoftware(to.append_child("dcc:installedSoftwares"), "firmware", device->firmware, "firmware");
        addContent(to.append_child("dcc:manufacturer"), "dcc:name", {entered("make")});
        addText(to, "dcc:model", entered("model", device == nullptr ? "" : device->name));
        auto ids = to.append_child("dcc:identifications");
        const auto reported = device == nullptr ? std::string() : device->serial;
        const auto serial = entered("serial", reported);
        identify(ids, "manufacturer", serial, "serial number", kSerial);
        // What was entered does not replace what the device reports about itself.
        if (!reported.empty() && serial != reported)
            identify(ids, "other", reported, "serial number that the device reports");
    }

    void state(xml_node to, std::string_view text, const char* refType = nullptr) const {
        auto one = to.append_child("dcc:statement");
        if (refType != nullptr) one.append_attribute("refType") = refType;
        addContent(one, "dcc:declaration", {text});
    }
    void addStatements(xml_node to) {
        if (source_.simulated())
            state(to,
                  "SIMULATED: this shows what a certificate would say. No device was calibrated, and it is not to be "
                  "issued.",
                  kSimulated);
        for (const auto& mark : source_.marks()) state(to, mark, kMark);
        state(to, "This file is not signed: nothing in it shows who made it, or that it was not changed.");
        state(to, fmt::format("Place of calibration: {}", entered("place")));
        if (!unknown_.empty())
            state(to, fmt::format("Not entered, and so unknown: {}, and the country (ZZ).", unknown_));
        else
            state(to, "Not entered, and so unknown: the country (ZZ).");
        state(to, "Traceability: " + (source_.simulated()        ? "none, nothing was measured on hardware"
                                      : of_.traceability.empty() ? "no certificate of the oscilloscope is known"
                                                                 : of_.traceability));
        if (const auto& kept = valueOr(of_.results, "kept"); kept.is_object())
            state(to, fmt::format("A correction of this calibration is stored on {}; this bench applies it until {}.",
                                  textOr(kept, "made"), textOr(kept, "valid_until")));
        for (const char* text :
             {"The results relate only to the items calibrated.",
              "This certificate shall not be reproduced except in full without approval of the laboratory.",
              "Laboratory, customer, make, condition, conditions, and days of receipt and issue are as they were "
              "entered; the program measured none of them.",
              "How long this bench applies a stored correction is its own setting; no interval of calibration is "
              "recommended."})
            state(to, text);
    }

    void addResults(xml_node to) {
        addContent(to, "dcc:name", {"Calibration of a stimulator"});
        auto method = to.append_child("dcc:usedMethods").append_child("dcc:usedMethod");
        const auto& about = source_.about();
        addContent(method, "dcc:name", {about.protocol.empty() ? "protocol" : about.protocol + ".js"});
        addContent(
            method, "dcc:description",
            {"Each level is commanded upward and downward and read from an oscilloscope's record across the load. "
             "Error: what is delivered less what is set, in the worse direction. U = k u for a coverage "
             "probability of 95 %, k from Student's t or from propagated distributions (GUM and Supplement 1).",
             "SHA-256 of the protocol: " + plain(about.protocolSha256)});
        addText(method, "dcc:norm", "JCGM 100:2008");
        addSoftware(to.append_child("dcc:usedSoftware"), "Tactoscope", about.programVersion, "application");
        addEquipment(to);
        auto conditions = to.append_child("dcc:influenceConditions").append_child("dcc:influenceCondition");
        addContent(conditions, "dcc:name", {"Ambient conditions"});
        addContent(conditions.append_child("dcc:data"), "dcc:text",
                   {of_.ambient.empty() ? "unknown: not entered" : of_.ambient});
        auto results = to.append_child("dcc:results");
        for (const auto& quantity : valueOr(of_.results, "quantities")) addQuantity(results, quantity);
    }

    void addEquipment(xml_node to) {
        xml_node all;
        for (const auto& device : source_.about().devices) {
            if (device.is(Role::Stimulator)) continue;
            if (!all) all = to.append_child("dcc:measuringEquipments");
            auto one = all.append_child("dcc:measuringEquipment");
            addContent(one, "dcc:name", {device.role});
            const bool own = device.is(Role::Oscilloscope) && of_.oscilloscope;
            if (own) addContent(one, "dcc:description", {figuresText(*of_.oscilloscope)});
            if (own) addCertificate(one.append_child("dcc:certificate"), *of_.oscilloscope);
            addText(one, "dcc:model", device.name);
            identify(one.append_child("dcc:identifications"), "manufacturer", device.serial, "serial number", kSerial);
            if (!device.firmware.empty())
                addSoftware(one.append_child("dcc:installedSoftware"), "firmware", device.firmware, "firmware");
        }
    }
    /// The schema wants a hash of every certificate, also of one on paper.
    static void addCertificate(xml_node to, const Certificate& certificate) {
        addContent(to, "dcc:referral", {certificateText(certificate)});
        addText(to, "dcc:referralID", certificate.number);
        addText(to, "dcc:procedure", kUnknown);
        addText(to, "dcc:value", kUnknown);
        addContent(to, "dcc:description",
                   {fmt::format("{} of {}, dated {}, due {}, of {} {}", certificate.number, certificate.by,
                                dateText(certificate.date), dateText(certificate.due), certificate.instrument,
                                certificate.serial)});
    }

    void addQuantity(xml_node to, const json& quantity) {
        const auto title = textOr(quantity, "title"), unit = textOr(quantity, "unit"),
                   id = textOr(quantity, "quantity");
        const auto applied = textsOr(of_.results, "correction_in_readings");
        const bool inReadings = std::ranges::find(applied, id) != applied.end();
        const bool corrected = !textOr(valueOr(of_.results, "before"), "made").empty();
        const bool kept = valueOr(of_.results, "kept").is_object();
        addRows(to, valueOr(quantity, "measured"), unit,
                title + (inReadings  ? ", as found, with the stored correction, measured"
                         : corrected ? " without a correction, measured"
                         : kept      ? ", as found, measured"
                                     : ", as found and as left, measured"));
        addRows(to, valueOr(quantity, "found"), unit, title + ", as found, computed");
        addRows(to, valueOr(quantity, "left"), unit, title + ", as left, computed");
        if (const auto line = valueOr(of_.evidence, id.c_str()); line.is_object()) addLine(to, line, unit, title);
    }

    static void addRows(xml_node to, const json& rows, const std::string& written, const std::string& title) {
        if (!rows.is_array() || rows.empty()) return;
        Values set, delivered, error, tolerance;
        std::string verdicts;
        for (const auto& row : rows) {
            const double u = numberOr(row, "expanded_uncertainty"), k = numberOr(row, "coverage_factor");
            const double commanded = numberOr(row, "commanded"), off = numberOr(row, "error");
            // Both or neither: an uncertainty without its factor says nothing.
            const bool known = std::isfinite(u) && std::isfinite(k) && std::isfinite(off);
            set.values.push_back(commanded);
            error.values.push_back(off);
            delivered.values.push_back(commanded + off);
            error.uncertainties.push_back(known ? u : kNaN);
            error.factors.push_back(known ? k : kNaN);
            tolerance.values.push_back(numberOr(row, "tolerance"));
            verdicts += (verdicts.empty() ? "" : " ") + plain(textOr(row, "verdict"));
        }
        delivered.uncertainties = error.uncertainties;
        delivered.factors = error.factors;
        auto result = to.append_child("dcc:result");
        addContent(result, "dcc:name", {title});
        auto list = result.append_child("dcc:data").append_child("dcc:list");
        const auto unit = unitOf(written);
        const auto add = [&](const char* refType, const char* name, const Values& values,
                             std::string (*text)(double) = numberText) {
            auto one = addWith(list, "dcc:quantity", refType);
            addContent(one, "dcc:name", {name});
            addList(one, values, unit, text);
        };
        add(kNominal, "Set", set, levelText);
        add(kMeasured, "Delivered", delivered);
        add(kError, "Error", error);
        add(kTolerance, "Tolerance, ±", tolerance);
        auto verdict = addWith(list, "dcc:quantity", kVerdict);
        addContent(verdict, "dcc:name", {"Verdict"});
        addText(verdict, "dcc:charsXMLList", verdicts);
    }

    /// The line through the readings, by which commands are corrected.
    static void addLine(xml_node to, const json& line, const std::string& written, const std::string& title) {
        auto result = to.append_child("dcc:result");
        addContent(result, "dcc:name", {title + ", line through the readings"});
        auto list = result.append_child("dcc:data").append_child("dcc:list");
        const auto add = [&](const char* name, const std::string& key, std::string_view unit) {
            auto one = list.append_child("dcc:quantity");
            addContent(one, "dcc:name", {name});
            addReal(one, numberOr(line, key.c_str()), unit, numberOr(line, (key + "_expanded_uncertainty").c_str()),
                    numberOr(line, (key + "_coverage_factor").c_str()));
        };
        add("Gain", "gain", "\\one");
        add("Offset", "offset", unitOf(written));
    }

    const ExportSource& source_;
    const Calibration& of_;
    std::string unknown_;  ///< the items that were not entered, separated by commas
};

Result<void> write(const ExportSource& source, const std::filesystem::path& draft, ExportReport&) {
    const auto calibration = calibrationOf(source);
    if (!calibration) return failure(calibration);
    auto out = FileOut::create(draft);
    if (!out) return failure(out);
    return namedAs(draft, out->write(Writer(source, *calibration).text()));
}

}  // namespace
}  // namespace dcc

const ExportFormat& dccExport() {
    constexpr std::string_view kResults = "a certificate holds the results; the session holds the readings";
    static const ExportFormat format{.name = "dcc",
                                     .title = "DCC: digital certificate of a calibration",
                                     .suffix = ".xml",
                                     .cannot = {{ExportContent::Streams, kResults},
                                                {ExportContent::Captures, kResults},
                                                {ExportContent::Trials, kResults},
                                                {ExportContent::Trains, kResults},
                                                {ExportContent::Events, kResults},
                                                {ExportContent::Records, kResults}},
                                     .write = dcc::write};
    return format;
}

}  // namespace tacto
