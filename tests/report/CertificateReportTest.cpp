// The report of a stimulator's calibration as a certificate by ISO/IEC 17025:2017, 7.8.2.1, 7.8.4.1 and 7.8.6.2.
#include <QJsonArray>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>

#include "app/report/CertificatePages.h"
#include "app/report/Report.h"
#include "core/calibration/CertificateDetails.h"
#include "core/session/Origin.h"
#include "tests/report/Samples.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

QJsonArray rowsOf(double factor, double shift, double u) {
    QJsonArray rows;
    for (int level = 1; level <= 4; ++level) {
        const double set = 10.0 * level;
        rows << QJsonObject{{"commanded", set * factor},
                            {"error", shift * level * factor},
                            {"expanded_uncertainty", u * level * factor},
                            {"coverage_factor", 1.85 - 0.05 * level},
                            {"tolerance", 0.02 * set * factor},
                            {"verdict", level == 4 ? "indeterminate" : "pass"}};
    }
    return rows;
}

QJsonObject quantity(const char* id, const char* title, const char* unit, double factor) {
    return {{"quantity", id},
            {"title", title},
            {"unit", unit},
            {"tolerance_pct", 2},
            {"warnings", QJsonArray()},
            {"stated_by", "the instrument"},
            {"measured", rowsOf(factor, 0.0421, 0.0613)},
            {"found", QJsonValue::Null},
            {"left", QJsonValue::Null}};
}

/// A customer's stimulator, calibrated with a real oscilloscope that has a known certificate.
ReportModel calibrated() {
    ReportModel model;
    model.title = "Stimulator calibration";
    model.protocol = model.resultKind = "stimulator-calibration";
    model.session = "stimulator-calibration-20261129T101645Z";
    model.started = "2026-11-29T10:16:45Z";
    model.duration_s = 343;
    model.verdict = ReportVerdict::Pass;
    model.reasons = {"Amplitude: uses 40 % of its tolerance at 10 V"};
    model.chainHead = QString("9c3d5191").repeated(8);
    model.devices = {
        {"stimulator", "RehaStim2", "sciencemode:/dev/ttyUSB0", "RS2-0042", "1.4", false, origin::kHardware},
        {"oscilloscope", "Scope X", "sigrok:", "DS1ZA1", "", false, origin::kHardware}};
    model.identity = {{"Program", "Tactoscope 9.8.7"},
                      {"Script from", "shipped with the program"},
                      {"Script stimulator-calibration", QString("a7ce4d4a").repeated(8), true}};
    model.basis.rule = {{"Decision rule", "Each level passes when |error| + U is within the tolerance."},
                        {"Guard band", "U on the side of the limit (ISO 14253-1)"}};
    model.basis.certificate = "certificate 4711 (DAkkS Lab, 2026-01-05, due 2027-01-05) of the oscilloscope is used";
    model.certificate = ReportCertificate{
        {},
        {{"quantities",
          QJsonArray{quantity("amplitude", "Amplitude", "V", 1), quantity("width", "Phase width", "s", 1e-6)}},
         {"correction_in_readings", QJsonArray()},
         {"before", QJsonObject{{"text", "stimulator RS2-0042 is not calibrated in V"}, {"made", QJsonValue::Null}}},
         {"kept", QJsonValue::Null}},
        {{"instrument", "Scope X"},
         {"serial", "DS1ZA1"},
         {"number", "4711"},
         {"by", "DAkkS Lab"},
         {"date", "2026-01-05"},
         {"due", "2027-01-05"},
         {"gain_u_pct", 0.5},
         {"timebase_u_ppm", 2},
         {"probe_u_pct", QJsonValue::Null}}};
    return model;
}

class Certificate : public ::testing::Test {
protected:
    std::string text(const ReportModel& model, const char* name) {
        const auto path = scratch_.path() / name;
        const auto written = writeReport(model, QString::fromStdString(path.string()));
        EXPECT_TRUE(written) << (written ? "" : written.error().message);
        std::string all =
            path.extension() == ".pdf" ? poppler("pdftotext -layout", path) : contentOfFile(path).toStdString();
        // The text as people read it: blanks for narrow blanks and line breaks; of the tags only a line to write on.
        QString read = QString::fromStdString(all).replace(QChar(0x202f), ' ');
        if (path.extension() == ".html") {
            read.remove(QRegularExpression("<style>.*</style>", QRegularExpression::DotMatchesEverythingOption));
            read.replace("<dd class=\"blank\">", "____ ").remove(QRegularExpression("<[^>]*>"));
        }
        return read.replace(QString("ﬁ"), "fi").replace(QString("ﬀ"), "ff").simplified().toStdString();
    }
    ScratchDir scratch_;
};

const QJsonObject kDetails{
    {"laboratory", "Lab Nord"}, {"address", "Street 1, Hamburg"},   {"place", "at the customer's, room 5"},
    {"number", "CAL-147"},      {"customer", "Institute <b>T</b>"}, {"contact", "E. Muster, +49 30 1"},
    {"make", "Hasomed"},        {"condition", "undamaged"},         {"received", "2026-11-20"},
    {"issued", "2026-12-01"},   {"authorised_by", "Dr. A. Weber"},  {"function", "Head of laboratory"}};

TEST_F(Certificate, SaysEverythingThatTheStandardAsksFor) {
    RecordProperty("hazard", "H8");
    auto model = calibrated();
    model.certificate->details = kDetails;
    model.basis.ambient = "22.5 °C, 45 % RH";
    model.basis.sample = "S-014";
    for (const char* file : {"c.pdf", "c.html"}) {
        if (std::string_view(file) == "c.pdf" && !havePoppler()) continue;
        const auto page = text(model, file);
        const bool pdf = std::string_view(file) == "c.pdf";
        for (const char* wanted :
             {"Calibration certificate",  // 7.8.2.1 a
              "Lab Nord",
              "Street 1, Hamburg",                                             // b
              "at the customer's, room 5",                                     // c
              "Certificate stimulator-calibration-20261129T101645Z-9c3d5191",  // d
              "CAL-147",
              "End of calibration certificate stimulator-calibration-20261129T101645Z-9c3d5191.",
              "E. Muster, +49 30 1",  // e
              "stimulator-calibration.js (shipped with the program), Tactoscope 9.8.7",
              "science.md section 9",  // f
              "Hasomed",
              "RehaStim2",
              "RS2-0042",
              "S-014",
              "undamaged",  // g
              "Received on",
              "2026-11-20",  // h
              "Calibrated on",
              "2026-11-29 (UTC)",  // i
              "Issued on",
              "2026-12-01",                                               // j
              "no interval of calibration is recommended",                // 7.8.4.3
              "The results relate only to the items calibrated.",         // l
              "This certificate shall not be reproduced except in full",  // 7.8.2.1, note
              "Deviations from it",
              "Interval was not calibrated",  // n
              "Authorised by",
              "Dr. A. Weber",
              "Head of laboratory",
              "Signature",  // o
              "for a coverage probability of 95 %",
              "Coverage (%)",      // 7.8.4.1 a
              "22.5 °C, 45 % RH",  // b
              "Amplitude: through certificate 4711 of DAkkS Lab, dated 2026-01-05, due 2027-01-05, of the oscilloscope",
              "voltage gain, U = 0.5 % (k = 2)",
              "time base, U = 2 ppm (k = 2)",  // c
              "as found and as left",
              "no adjustment was made, and no correction was stored",  // d
              "Statement of conformity",
              "Amplitude ± 2 % of the set value",  // e, 7.8.6.2
              "U on the side of the limit"})
            EXPECT_THAT(page, HasSubstr(wanted)) << file;
        EXPECT_THAT(page, HasSubstr(pdf ? "Institute <b>T</b>" : "Institute &lt;b&gt;T&lt;/b&gt;")) << "as text";
        EXPECT_THAT(page, HasSubstr("Not traceable: the probe, which is not from this certificate"))
            << "no more than it states";
        EXPECT_THAT(page, Not(HasSubstr("____"))) << "everything was said";
        EXPECT_THAT(page, Not(HasSubstr("SIMULATED")));
        if (!pdf) continue;
        const auto pages = std::stoi(std::regex_replace(poppler("pdfinfo", scratch_.path() / file),
                                                        std::regex("[^]*Pages: *([0-9]+)[^]*"), "$1"));
        for (int n = 1; n <= pages; ++n) {
            EXPECT_THAT(page, HasSubstr(fmt::format("page {} of {}", n, pages)));
        }
        EXPECT_THAT(page, HasSubstr("chain head 9c3d51919c3d"));
    }
}

TEST_F(Certificate, WhatNobodySaidIsALineToWriteOn) {
    RecordProperty("hazard", "H9");
    const auto model = calibrated();
    const auto page = text(model, "c.html");
    for (const auto& detail : kCertificateDetails) {
        const auto title = std::string(detail.title);
        if (detail.key == "function" || detail.key == "authorised_by") continue;  // part of the signature
        if (detail.key == "model" || detail.key == "serial") {                    // given by the device
            EXPECT_THAT(page, Not(HasSubstr(title + " ____"))) << title;
        } else {
            EXPECT_THAT(page, HasSubstr(title + "____")) << title;
        }
    }
    EXPECT_THAT(page, HasSubstr("Conditions during it____"));
    EXPECT_THAT(page, Not(HasSubstr("not recorded Function")));
    auto nameless = model;
    nameless.devices.front().serial.clear();
    EXPECT_THAT(text(nameless, "n.html"), HasSubstr("Serial number____"));
    auto entered = model;
    entered.certificate->details = {{"serial", "RS2-0043"}};
    EXPECT_THAT(text(entered, "e.html"), HasSubstr("RS2-0043 (the device reports RS2-0042)"));
}

TEST_F(Certificate, HoldsWhatWasFoundAndWhatIsLeftApart) {
    RecordProperty("hazard", "H9");
    auto model = calibrated();
    auto quantities = model.certificate->results["quantities"].toArray();
    auto amplitude = quantities[0].toObject();
    EXPECT_THAT(text(model, "a.html"), AllOf(HasSubstr("Amplitude, as found and as left, measured"),
                                             Not(HasSubstr("computed from the readings"))));
    amplitude["left"] = rowsOf(1, 0.001, 0.0613);
    model.certificate->results["quantities"] = QJsonArray{amplitude};
    model.certificate->results["kept"] = QJsonObject{{"made", "2026-11-29"}, {"valid_until", "2027-11-29"}};
    const auto adjusted = text(model, "b.html");
    EXPECT_THAT(adjusted, AllOf(HasSubstr("Amplitude, as found, measured"), HasSubstr("Amplitude, as left, computed"),
                                HasSubstr("computed from the readings and was not measured"),
                                HasSubstr("computed from the readings and was not measured")));
    amplitude["found"] = rowsOf(1, 0.02, 0.0613);
    model.certificate->results["quantities"] = QJsonArray{amplitude};
    model.certificate->results["before"] = QJsonObject{{"text", "was calibrated"}, {"made", "2026-03-01"}};
    EXPECT_THAT(text(model, "c.html"),
                AllOf(HasSubstr("Amplitude without a correction, measured"), HasSubstr("Amplitude, as found, computed"),
                      HasSubstr("the correction of 2026-03-01 was applied")));
}

/// In each column: U has two digits, the value ends at the same decimal place, and only the header has the unit.
TEST_F(Certificate, EveryValueHasItsUAndItsFactorInOnePrefix) {
    RecordProperty("hazard", "H8");
    const auto content = contentOf(calibrated());
    int tables = 0;
    for (const auto& block : content.blocks) {
        const auto* table = std::get_if<TableBlock>(&block);
        if (table == nullptr || !table->caption.contains("as found")) continue;
        ++tables;
        const bool volts = table->caption.contains("Amplitude");
        QStringList titles;
        for (const auto& column : table->columns) titles << column.title;
        EXPECT_EQ(titles, (volts ? QStringList{"Verdict", "Set (V)", "Delivered (V)", "Error (V)", "U (V)", "k",
                                               "Coverage (%)", "Tolerance (V)"}
                                 : QStringList{"Verdict", "Set (µs)", "Delivered (µs)", "Error (µs)", "U (µs)", "k",
                                               "Coverage (%)", "Tolerance (µs)"}))
            << titles.join(", ").toStdString();
        ASSERT_EQ(table->rows.size(), 4U);
        for (int level = 1; level <= 4; ++level) {
            const auto cell = [&](int column) {
                QString text = table->rows[std::size_t(level) - 1][column];
                return text.remove(QChar(0x2007)).remove(QChar(0x2008)).toStdString();
            };
            const int places = level == 1 ? 3 : 2;
            EXPECT_EQ(cell(3), fmt::format("{:.{}f}", 0.0421 * level, places));
            EXPECT_EQ(cell(4), fmt::format("{:.{}f}", 0.0613 * level, places));
            EXPECT_EQ(cell(2), fmt::format("{:.{}f}", 10.0421 * level, places));
            EXPECT_EQ(cell(5), fmt::format("{:.2f}", 1.85 - 0.05 * level));
            EXPECT_EQ(cell(6), "95");
        }
    }
    EXPECT_EQ(tables, 2);
}

TEST_F(Certificate, ClaimsNoMoreThanWasDone) {
    RecordProperty("hazard", "H9");
    auto simulated = calibrated();
    simulated.simulated = true;
    for (auto& device : simulated.devices) {
        device.simulated = true;
        device.origin = origin::kSimulated;
    }
    EXPECT_EQ(contentOf(simulated).documentTitle, "Calibration certificate – SIMULATED");
    EXPECT_THAT(text(simulated, "s.html"), AllOf(HasSubstr("not traceable: SIMULATED"), Not(HasSubstr("4711 of"))));
    if (havePoppler()) {
        const auto page = text(simulated, "s.pdf");
        std::size_t marks = 0;
        for (auto at = page.find("SIMULATED: no device was calibrated"); at != page.npos; ++marks)
            at = page.find("SIMULATED: no device was calibrated", at + 1);
        const auto info = poppler("pdfinfo", scratch_.path() / "s.pdf");
        EXPECT_EQ(marks, std::stoul(info.substr(info.find("Pages:") + 6))) << "on every page";
    }

    auto untraced = calibrated();
    untraced.certificate->oscilloscope = {};
    untraced.basis.certificate = "certificate 4711 is expired: its figures are not used";
    EXPECT_THAT(text(untraced, "u.html"), HasSubstr("not traceable: certificate 4711 is expired"));
    untraced.basis.certificate.clear();
    EXPECT_THAT(text(untraced, "v.html"), HasSubstr("not traceable: no calibration certificate of the oscilloscope"));

    auto stated = calibrated();
    auto amplitude = quantity("amplitude", "Amplitude", "V", 1);
    amplitude["stated_by"] = "the operator";
    stated.certificate->results["quantities"] = QJsonArray{amplitude};
    EXPECT_THAT(text(stated, "o.html"),
                HasSubstr("not traceable: the voltage gain, which is not from this certificate"));

    const auto refused = [&](auto change, const char* why) {
        auto model = calibrated();
        change(model);
        EXPECT_FALSE(isCertificate(model)) << why;
        const auto page = text(model, "r.html");
        EXPECT_THAT(page, AllOf(HasSubstr(std::string("No calibration certificate: ") + why),
                                Not(HasSubstr("The results relate only")), Not(HasSubstr("Authorised by"))));
    };
    refused([](ReportModel& model) { model.damage = {"row 7: digest"}; }, "the session is not what was recorded");
    refused([](ReportModel& model) { model.verdict = ReportVerdict::Stopped; }, "the run did not come to its verdict");
    refused([](ReportModel& model) { model.devices.back().origin = origin::kReplayedMeasured; },
            "its readings come from files");
}

TEST_F(Certificate, HostileWordsAreTextAndLongOnesAreCut) {
    RecordProperty("hazard", "H8");
    auto model = calibrated();
    for (const auto& detail : kCertificateDetails) {
        model.certificate->details[QString::fromUtf8(detail.key.data(), qsizetype(detail.key.size()))] =
            "</dd><script>alert(1)</script>\u202e" + QString("x").repeated(5000);
    }
    const auto path = scratch_.path() / "h.html";
    ASSERT_TRUE(writeReport(model, QString::fromStdString(path.string())));
    const auto html = contentOfFile(path);
    EXPECT_FALSE(html.contains("<script>"));
    EXPECT_FALSE(html.contains(QString(QChar(0x202e)).toUtf8()));
    EXPECT_LT(html.count('x'), 30'000);
    EXPECT_TRUE(writeReport(model, QString::fromStdString((scratch_.path() / "h.pdf").string())));
}

}  // namespace
}  // namespace tacto::test
