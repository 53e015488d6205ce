// What laboratories' digital certificates state of an oscilloscope, a multimeter or a shunt, and what is refused.
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "core/exchange/dcc/DccCertificate.h"
#include "core/exchange/dcc/DsiUnit.h"
#include "tests/exchange/dcc/DccText.h"
#include "tests/support/Support.h"
#include "tests/support/Trials.h"

namespace tacto::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

const std::string kGain =
    dccResult("Voltage", dccReal("basic_measurementError", "Gain error", "0", "\\percent", "0.5", "2"));

Result<DccCertificate> read(const std::vector<std::string>& texts, const Certificate& given = {}) {
    std::vector<DccFile> files;
    for (const auto& text : texts) {
        auto file = dccFrom(text, "file.xml");
        if (!file) return failure(file);
        files.push_back(std::move(*file));
    }
    return certificateFrom(files, given);
}

void expectRefusedDcc(const std::string& text, const std::vector<std::string>& says, const Certificate& given = {}) {
    const auto refused = read({text}, given);
    ASSERT_FALSE(refused) << testing::PrintToString(says);
    for (const auto& each : says) EXPECT_THAT(refused.error().message, HasSubstr(each));
    EXPECT_EQ(refused.error().message.find('\n'), std::string::npos);
}

TEST(DsiUnits, AreFactorsAndDimensions) {
    const DsiUnit volt = dsiUnit("\\volt").value();
    for (const auto& [text, factor] : std::vector<std::pair<const char*, double>>{
             {"\\volt", 1},
             {"\\milli\\volt", 1e-3},
             {" \\kilo\\volt ", 1e3},
             {"\\kilogram\\metre\\tothe{2}\\second\\tothe{-3}\\ampere\\tothe{-1}", 1},
             {"\\watt\\per\\ampere", 1},
             {"\\micro\\volt\\second\\per\\second", 1e-6},
             {"\\joule\\per\\milli\\coulomb", 1e3}}) {
        const auto unit = dsiUnit(text);
        ASSERT_TRUE(unit) << text;
        EXPECT_TRUE(unit->sameKind(volt)) << text;
        EXPECT_NEAR(unit->factor / factor, 1, 1e-12) << text;
    }
    EXPECT_EQ(dsiUnit("\\percent")->factor, 0.01);
    EXPECT_TRUE(dsiUnit("\\ppm")->sameKind({}));
    EXPECT_TRUE(dsiUnit("\\mega\\hertz")->sameKind(*dsiUnit("\\per\\second")));
    for (const char* wrong :
         {"", " ", "V", "volt", "\\", "\\milli", "\\volt volt", "\\volts", "\\volt\\tothe{", "\\per",
          "\\volt\\tothe{x}", "\\volt\\tothe{1e9}", "\\degreecelsius", "\\volt\\tothe{NaN}"})
        EXPECT_FALSE(dsiUnit(wrong)) << wrong;
}

/// A figure drawn at random: written in some unit of its kind, with some k, as list or single number.
TEST(DccCertificates, StateTheirWorstPointWithItsError) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 200, .ci = 1000, .campaign = 50'000});
         ++seed) {
        std::mt19937_64 random(seed);
        const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
        const std::pair<const char*, double> units[] = {
            {"\\volt", 1}, {"\\milli\\volt", 1e-3}, {"\\kilo\\volt", 1e3}, {"\\watt\\per\\ampere", 1}};
        const auto& [unit, factor] = units[random() % std::size(units)];
        const auto& [otherUnit, otherFactor] = units[random() % std::size(units)];
        const double k = random() % 2 == 0 ? 2 : draw(1, 3);
        std::string references, shown, errors, us, ks;
        double worst = 0;
        const auto count = 1 + random() % 6;
        for (std::size_t i = 0; i < count; ++i) {
            const double at = draw(0.1, 100) * (random() % 2 == 0 ? 1 : -1), off = draw(-0.01, 0.01) * at,
                         u = draw(1e-4, 1e-2) * std::abs(at);
            references += fmt::format(" {}", at / otherFactor);
            shown += fmt::format(" {}", (at + off) / factor);
            errors += fmt::format("\n{}", off / factor);
            us += fmt::format(" {}", u / factor);
            ks += fmt::format(" {}", k);
            worst = std::max(worst, (u * 2 / k + std::abs(off)) / std::abs(at));
        }
        if (random() % 2 == 0) ks = fmt::format("{}", k);
        const bool byError = random() % 2 == 0;
        DccText dcc;
        dcc.results =
            dccResult("DC", dccQuantity("basic_referenceValue", "Applied", references, otherUnit) +
                                (byError ? dccQuantity("basic_measurementError", "Error", errors, unit, us, ks)
                                         : dccQuantity("basic_measuredValue", "Indicated", shown, unit, us, ks)));
        const double ppm = draw(0.1, 100), time = draw(1e-6, 1);
        dcc.results += dccResult("Time base", dccReal("", "Frequency", "0", "\\ppm", fmt::format("{}", ppm), "2") +
                                                  dccReal("", "Rise time", "3.5", "\\nano\\second", "1", "2"));
        const auto found = read({dcc.text()});
        ASSERT_TRUE(found) << found.error().message << " seed " << seed;
        EXPECT_NEAR(*found->certificate.gain_pct / (100 * worst), 1, 1e-9) << "seed " << seed;
        EXPECT_NEAR(*found->certificate.timeBase_ppm / ppm, 1, 1e-9) << "seed " << seed << " " << time;
        EXPECT_FALSE(found->certificate.shunt_pct || found->certificate.probe_pct);
        EXPECT_THAT(found->notes, Contains(HasSubstr("readings are not corrected")));
        EXPECT_THAT(found->notes, Contains(HasSubstr("K-17 is unsigned")));
    }
}

TEST(DccCertificates, NameTheInstrumentTheLaboratoryAndTheDays) {
    DccText dcc;
    dcc.results = kGain;
    const auto found = read({dcc.text()});
    ASSERT_TRUE(found) << found.error().message;
    const auto& certificate = found->certificate;
    EXPECT_EQ(certificate.instrument, "Rigol DS1054Z");
    EXPECT_EQ(certificate.serial, "DS1ZA1");
    EXPECT_EQ(certificate.number, "K-17");
    EXPECT_EQ(certificate.by, "DAkkS Lab");
    EXPECT_EQ(dateText(certificate.date), "2026-11-01");
    EXPECT_EQ(dateText(certificate.due), "2027-10-31");
    EXPECT_EQ(certificate.gain_pct, 0.5);
}

TEST(DccCertificates, OfAShuntAndAProbeAddTheirFigures) {
    DccText scope, shunt, probe;
    scope.results = kGain;
    shunt.number = "S-4";
    shunt.model = "Current shunt";
    shunt.serial = "R1";
    shunt.ended = "2026-11-05";
    shunt.due = "2027-01-31";
    shunt.results = dccResult("Resistance", dccReal("", "Value", "0.1", "\\kilo\\ohm", "0.0002", "2"));
    probe.number = "P-5";
    probe.due = "";
    probe.results = dccResult("", dccReal("", "Attenuation", "10", "\\one", "0.1", "2"));
    Certificate given;
    given.due = *parseDate("2027-06-30");
    const auto found = read({scope.text(), shunt.text(), probe.text()}, given);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->certificate.serial, "DS1ZA1");
    EXPECT_EQ(found->certificate.number, "K-17 + S-4 + P-5");
    EXPECT_EQ(found->certificate.by, "DAkkS Lab");
    EXPECT_EQ(dateText(found->certificate.date), "2026-11-05");
    EXPECT_EQ(dateText(found->certificate.due), "2027-01-31");
    EXPECT_EQ(found->certificate.gain_pct, 0.5);
    EXPECT_NEAR(*found->certificate.shunt_pct, 0.2, 1e-9);
    EXPECT_NEAR(*found->certificate.probe_pct, 1, 1e-9);
    expectRefusedDcc(shunt.text(), {"states no voltage gain", "given beside"});
}

TEST(DccCertificates, TakeFromOptionsOnlyWhatTheyDoNotState) {
    DccText dcc;
    dcc.results = kGain;
    dcc.due = "";
    expectRefusedDcc(dcc.text(), {"no day on which it is due", "basic_recalibration"});
    Certificate given;
    given.due = *parseDate("2027-03-01");
    EXPECT_EQ(read({dcc.text()}, given)->certificate.due, given.due);
    given.serial = "OTHER";
    expectRefusedDcc(dcc.text(), {"\"OTHER\"", "\"DS1ZA1\""}, given);
    given.serial.clear();
    given.gain_pct = 0.4;
    expectRefusedDcc(dcc.text(), {"0.4", "0.5"}, given);
    dcc.results = dccResult("Voltage", dccQuantity("basic_measuredValue", "Indicated", "1 2", "\\volt"));
    expectRefusedDcc(dcc.text(), {"no voltage gain with its uncertainty"}, {.due = given.due});
    EXPECT_EQ(read({dcc.text()}, given)->certificate.gain_pct, 0.4);
    dcc.serial = "";
    expectRefusedDcc(dcc.text(), {"no serial number"}, given);
    given.serial = "S1";
    EXPECT_EQ(read({dcc.text()}, given)->certificate.serial, "S1");
    dcc.items =
        "<dcc:item><dcc:model>B</dcc:model><dcc:identifications><dcc:identification refType=\"basic_serialNumber\">"
        "<dcc:value>S2</dcc:value></dcc:identification></dcc:identifications></dcc:item>";
    expectRefusedDcc(dcc.text(), {"2 items", "serial number"}, given);
    given.serial = "S2";
    EXPECT_EQ(read({dcc.text()}, given)->certificate.instrument, "B");
}

TEST(DccCertificates, AreRefusedInOneSentence) {
    RecordProperty("hazard", "H9");
    const auto with = [](auto&& change) {
        DccText dcc;
        dcc.results = kGain;
        change(dcc);
        return dcc.text();
    };
    const auto results = [&](const std::string& quantity) {
        return with([&](DccText& dcc) { dcc.results = dccResult("Voltage", quantity); });
    };
    expectRefusedDcc("", {"file.xml", "no XML"});
    expectRefusedDcc("<a/>", {"its root is \"a\""});
    expectRefusedDcc("<digitalCalibrationCertificate xmlns=\"https://ptb.de/si\"/>", {"its root is"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.root = "xmlns:dcc=\"https://ptb.de/dcc\" schemaVersion=\"2.4.0\""; }),
                     {"2.4.0", "version 3"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.number = ""; }), {"uniqueIdentifier is missing"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.laboratory = ""; }), {"laboratory has no name"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.ended = "soon"; }), {"endPerformanceDate", "\"soon\""});
    expectRefusedDcc(with([](DccText& dcc) { dcc.due = "2026-02-30"; }), {"2026-02-30"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.due = "2026-10-01"; }), {"due"});
    expectRefusedDcc(with([](DccText& dcc) { dcc.statements = "<dcc:statement refType=\"tactoscope_simulated\"/>"; }),
                     {"simulated bench"});
    // Units.
    expectRefusedDcc(results(dccQuantity("", "Voltage gain", "1 2", "V", "0.1", "2")),
                     {"\"Voltage gain\" is in V", "\\volt"});
    expectRefusedDcc(results(dccQuantity("", "Voltage gain", "1 2", "\\metre", "0.1", "2")), {"is in \\metre"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "\\volt \\milli\\volt", "0.1", "2")), {"one unit"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "", "0.1", "2")),
                     {"the unit of \"Voltage\" is missing"});
    // Numbers.
    for (const char* wrong : {"1,5", "0x10", "inf", "nan", "-INF", "1e999", "1 e5", "1..2", "--1", "+-1"})
        expectRefusedDcc(results(dccQuantity("", "Voltage", wrong, "\\volt", "0.1", "2")), {"\"Voltage\""});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 NaN", "\\volt", "0.1", "2")), {"value 2", "NaN"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "\\volt", "0.1 NaN", "2")), {"value 2", "NaN"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "\\volt", "-0.1", "2")), {"uncertainty", "-0.1"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "\\volt", "0.1", "0.5")), {"coverage factor k", "0.5"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2", "\\volt", "0.1")), {"coverage factor k", "missing"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2 3", "\\volt", "0.1 0.2", "2")),
                     {"3 values and 2 numbers"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2 3", "\\volt", "0.1", "2 2")), {"3 values and 2 numbers"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1 2 3", "\\volt \\volt", "0.1", "2")),
                     {"3 values and 2 units"});
    expectRefusedDcc(results(dccQuantity("basic_measurementError", "Error", "0.1", "\\volt", "0.1", "2")),
                     {"error in \\volt without the values"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "0 0", "\\volt", "0.1", "2")), {"no voltage gain"});
    expectRefusedDcc(results(dccQuantity("", "Voltage", "1", "\\volt", "0.9", "2")), {"90"});
}

TEST(DccCertificates, BringNothingElseWithThem) {
    RecordProperty("hazard", "H10");
    DccText dcc;
    dcc.results = kGain;
    const auto whole = dcc.text();
    auto head = whole;
    head.insert(head.find("?>") + 2, "<!DOCTYPE dcc [<!ENTITY a \"b\">]>");
    expectRefusedDcc(head, {"document type"});
    head = whole;
    head.insert(head.find("?>") + 2, "<!DOCTYPE a SYSTEM \"file:///etc/passwd\">");
    expectRefusedDcc(head, {"document type"});
    dcc.number = "&passwd;";
    expectRefusedDcc(dcc.text(), {});
    dcc.number = "K-17";
    dcc.head = R"(<?xml version="1.0" encoding="UTF-16"?>)";
    expectRefusedDcc(dcc.text(), {"UTF-16"});
    dcc.head = "\xff\xfe";
    expectRefusedDcc(dcc.text(), {"UTF-8"});
    dcc.head = std::string("\0", 1);
    expectRefusedDcc(dcc.text(), {"UTF-8"});
    dcc.head = "";
    for (int deep : {30, 70, 100'000}) {
        dcc.tail = "<dcc:comment>";
        for (int i = 0; i < deep; ++i) dcc.tail += "<a>";
        for (int i = 0; i < deep; ++i) dcc.tail += "</a>";
        dcc.tail += "</dcc:comment>";
        if (deep < 64)
            EXPECT_TRUE(read({dcc.text()}));
        else
            expectRefusedDcc(dcc.text(), {"nested"});
    }
    dcc.tail.assign(kDccLimit, ' ');
    expectRefusedDcc(dcc.text(), {"larger than"});
    const ScratchDir folder;
    const auto file = folder.write("large.xml", dcc.text());
    EXPECT_THAT(readDcc(file).error().message, AllOf(HasSubstr("large.xml"), HasSubstr("too large")));
    EXPECT_EQ(readDcc(folder.path() / "none.xml").error().code, ErrorCode::NotFound);
    EXPECT_FALSE(readDcc(folder.path()));
    EXPECT_FALSE(readDcc("/dev/zero"));
}

}  // namespace
}  // namespace tacto::test
