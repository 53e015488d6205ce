// What laboratories' digital certificates state of an oscilloscope, a multimeter or a shunt, and what is refused.
#include <chrono>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <utility>

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
        const double k = random() % 2 == 0 ? 2 : draw(1, 4);
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
            worst = std::max(worst, (u * std::max(1.0, 2 / k) + std::abs(off)) / std::abs(at));
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
    expectRefusedDcc(results(dccQuantity("", "Voltage gain", "1 NaN", "\\one", "0.1", "2")), {"value 2", "NaN"});
    expectRefusedDcc(results(dccQuantity("", "Voltage gain", "1 1", "\\one", "0.1 NaN", "2")), {"value 2", "NaN"});
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
    expectRefusedDcc(results(dccQuantity("basic_referenceValue", "Voltage", "0 0", "\\volt", "0.1", "2") +
                             dccQuantity("basic_measuredValue", "Indicated", "0 0", "\\volt")),
                     {"no voltage gain"});
    expectRefusedDcc(results(dccQuantity("", "Voltage gain", "1", "\\one", "0.9", "2")), {"90"});
}

/// Numbers as a list.
std::string listed(const std::vector<double>& all, double factor = 1) {
    std::string text;
    for (const double each : all) text += fmt::format(" {}", each / factor);
    return text;
}

/// Readings of an input that are off at random, and what a certificate of them states.
struct Table {
    std::vector<double> applied, read, errors, us;
    double worst = 0;      ///< of the applied value
    double worstRead = 0;  ///< of the reading
    explicit Table(std::mt19937_64& random) {
        const auto draw = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
        for (auto count = 1 + random() % 6; count > 0; --count) {
            const double at = draw(3, 100) * (random() % 2 == 0 ? 1 : -1), off = draw(-0.1, 0.1) * at,
                         u = draw(1e-4, 1e-2) * std::abs(at);
            applied.push_back(at);
            read.push_back(at + off);
            errors.push_back(off);
            us.push_back(u);
            worst = std::max(worst, (u + std::abs(off)) / std::abs(at));
            worstRead = std::max(worstRead, (u + std::abs(off)) / std::abs(at + off));
        }
    }
};

/// However a table states its error, and whichever of its quantities has the uncertainty.
TEST(DccCertificates, DropNoErrorThatStandsBesideTheUncertainty) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 200, .ci = 1000, .campaign = 50'000});
         ++seed) {
        std::mt19937_64 random(seed);
        const Table table(random);
        const auto u = listed(table.us);
        const auto quantity = [](const char* refType, const char* name, const std::vector<double>& values,
                                 const std::string& with = {}) {
            return dccQuantity(refType, name, listed(values), "\\volt", with, with.empty() ? "" : "2");
        };
        std::vector<double> relative;
        for (std::size_t i = 0; i < table.errors.size(); ++i)
            relative.push_back(100 * table.errors[i] / table.applied[i]);
        const auto percent = dccQuantity("basic_measurementError", "Error", listed(relative), "\\percent");
        std::string list;
        double worst = table.worst;
        switch (random() % 7) {
            case 0:
                list = quantity("basic_referenceValue", "Applied", table.applied, u) +
                       quantity("basic_measuredValue", "Indicated", table.read);
                break;
            case 1:
                list = quantity("basic_nominalValue", "Applied", table.applied, u) +
                       quantity("basic_measuredValue", "Indicated", table.read);
                break;
            case 2:
                list =
                    quantity("", "Reading", table.read, u) + quantity("basic_measurementError", "Shown", table.errors);
                worst = table.worstRead;
                break;
            case 3:
                list = quantity("basic_measuredValue", "Reading", table.read) +
                       quantity("", "Error of indication", table.errors, u);
                worst = table.worstRead;
                break;
            case 4:
                list = quantity("basic_referenceValue", "Applied", table.applied) +
                       quantity("", "Indicated", table.read, u);
                break;
            case 5:
                list = percent + quantity("basic_referenceValue", "Applied", table.applied, u);
                break;
            default:
                list = quantity("basic_referenceValue", "Applied", table.applied, u) + percent +
                       dccQuantity("", "Frequency", "1000", "\\hertz", "0.001", "2");
        }
        DccText dcc;
        dcc.results = dccResult("Voltage", list);
        const auto found = read({dcc.text()});
        ASSERT_TRUE(found) << found.error().message << " seed " << seed;
        EXPECT_NEAR(*found->certificate.gain_pct / (100 * worst), 1, 1e-9) << "seed " << seed;
        EXPECT_FALSE(found->certificate.timeBase_ppm) << "the frequency at which volts were measured";
    }
}

/// Tables that leave a doubt are refused, and then the figure that is given counts.
TEST(DccCertificates, LeaveWhatIsInDoubtToThePerson) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 200, .ci = 1000, .campaign = 50'000});
         ++seed) {
        std::mt19937_64 random(seed);
        const Table table(random);
        const auto u = listed(table.us);
        const auto with = [&](const char* refType, const char* name, const std::vector<double>& values) {
            return dccQuantity(refType, name, listed(values), "\\volt", u, "2");
        };
        const auto twice = table.applied.size() + 1;
        const std::string sound = kGain;
        const std::pair<std::string, const char*> all[] = {
            {with("basic_measuredValue", "Indicated", table.read), "without their error"},
            {with("", "Reading", table.read), "without their error"},
            {with("", "Applied", table.applied) + with("basic_measuredValue", "Indicated", table.read),
             "without their error"},
            {with("basic_measuredValue", "Indicated", table.read) +
                 dccQuantity("basic_measurementError", "Error", listed(std::vector<double>(twice, 0.1)), "\\volt"),
             "as many are expected"},
            {with("basic_measuredValue", "Indicated", table.read) +
                 dccQuantity("basic_referenceValue", "Applied", listed(std::vector<double>(twice, 5)), "\\volt"),
             "as many are expected"},
            {with("basic_measuredValue", "Indicated", table.read) +
                 dccQuantity("basic_referenceValue", "Applied", listed(table.applied), "\\volt") +
                 dccQuantity("basic_referenceValue", "Second", listed(table.read), "\\volt"),
             "several reference or nominal"},
            {with("basic_measuredValue", "Indicated", table.read) +
                 dccQuantity("basic_measurementError", "Error", listed(table.errors), "\\decibel\\one"),
             "the error \"Error\" is in"},
            {dccQuantity("basic_measurementError", "Error", listed(table.errors), "\\volt"),
             "an error without its uncertainty"},
            {dccQuantity("basic_referenceValue", "Applied", listed(table.applied), "\\volt") +
                 dccQuantity("basic_measuredValue", "Indicated", listed(table.read), "\\volt"),
             "an error without its uncertainty"}};
        const auto& [list, why] = all[seed % std::size(all)];
        DccText dcc;
        // Beside a figure that is sound, and before or after it.
        dcc.results = random() % 2 == 0 ? sound + dccResult("DC", list) : dccResult("DC", list) + sound;
        expectRefusedDcc(dcc.text(), {"K-17", why, "voltage gain may be given"});
        Certificate given;
        given.gain_pct = 12.5;
        const auto found = read({dcc.text()}, given);
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_EQ(found->certificate.gain_pct, 12.5);
        EXPECT_THAT(found->notes, Contains(AllOf(HasSubstr("voltage gain is as given"), HasSubstr(why))));
    }
}

/// Items with their own figures; the reference to the item stands at the result, the list or the quantity.
TEST(DccCertificates, OfSeveralItemsTakeOnlyWhatIsOfTheChosen) {
    RecordProperty("hazard", "H9");
    for (std::uint64_t seed = 1; seed <= trials<std::uint64_t>({.local = 100, .ci = 500, .campaign = 20'000}); ++seed) {
        std::mt19937_64 random(seed);
        const auto put = [](std::string text, const std::string& before, const std::string& attribute) {
            return text.insert(text.find(before) + before.size(), attribute);
        };
        const auto count = 2 + random() % 3;
        DccText dcc;
        std::vector<double> gains, times;
        std::string unowned;
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0)
                dcc.items += fmt::format(
                    R"(<dcc:item id="i{0}"><dcc:model>M{0}</dcc:model><dcc:identifications><dcc:identification )"
                    R"(refType="basic_serialNumber"><dcc:value>S{0}</dcc:value></dcc:identification>)"
                    "</dcc:identifications>"
                    "</dcc:item>",
                    i);
            gains.push_back(std::uniform_real_distribution(0.1, 5.0)(random));
            times.push_back(random() % 2 == 0 ? 0 : std::uniform_real_distribution(0.1, 50.0)(random));
            auto result = dccResult(
                "Voltage",
                dccReal("", "Gain error", "0", "\\percent", listed({gains[i]}), "2") +
                    (times[i] > 0 ? dccReal("", "Time base error", "0", "\\ppm", listed({times[i]}), "2") : ""));
            unowned += result;
            const auto id = fmt::format(" refId=\"other i{}\"", i);
            switch (random() % 3) {
                case 0:
                    result = put(result, "<dcc:result", id);
                    break;
                case 1:
                    result = put(result, "<dcc:list", id);
                    break;
                default:
                    for (std::size_t at = 0; (at = result.find("<dcc:quantity", at)) != std::string::npos; ++at)
                        result.insert(at + std::string("<dcc:quantity").size(), id);
            }
            dcc.results += result;
        }
        auto text = dcc.text();
        text.insert(text.find("<dcc:item>") + std::string("<dcc:item").size(), " id=\"i0\"");
        const auto chosen = random() % count;
        Certificate given;
        given.serial = chosen == 0 ? "DS1ZA1" : fmt::format("S{}", chosen);
        const auto found = read({text}, given);
        ASSERT_TRUE(found) << found.error().message << " seed " << seed;
        EXPECT_EQ(found->certificate.serial, given.serial);
        EXPECT_NEAR(*found->certificate.gain_pct, gains[chosen], 1e-9) << "seed " << seed;
        EXPECT_NEAR(found->certificate.timeBase_ppm.value_or(0), times[chosen], 1e-9) << "seed " << seed;
        dcc.results = unowned;
        expectRefusedDcc(dcc.text(), {fmt::format("about {} items", count), "refId"}, given);
        text.replace(text.find("refId=\"other i0\""), 16, "refId=\"i0 i1\"");
        if (chosen < 2) expectRefusedDcc(text, {"refId"}, given);
    }
}

TEST(DccCertificates, ThatStateTheSameFigureAreRefusedByName) {
    RecordProperty("hazard", "H9");
    DccText one, two;
    one.results = kGain;
    two.number = "K-18";
    two.results = dccResult("Voltage", dccReal("", "Gain error", "0", "\\percent", "0.3", "2"));
    const auto refused = read({one.text(), two.text()});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, AllOf(HasSubstr("K-17"), HasSubstr("K-18"), HasSubstr("both state")));
    Certificate given;
    given.gain_pct = 0.5;
    EXPECT_EQ(read({one.text(), two.text()}, given)->certificate.gain_pct, 0.5);
    // What was measured at a shunt or a probe is no gain of the oscilloscope.
    DccText shunt;
    shunt.number = "S-4";
    shunt.model = "Shunt";
    shunt.results = dccResult("Shunt", dccReal("", "Value", "0.1", "\\ohm", "0.0002", "2") +
                                           dccReal("", "Voltage drop", "1", "\\volt", "0.1", "2"));
    const auto both = read({one.text(), shunt.text()});
    ASSERT_TRUE(both) << both.error().message;
    EXPECT_EQ(both->certificate.gain_pct, 0.5);
    EXPECT_TRUE(statesGain(*dccFrom(one.text(), "file.xml")));
    EXPECT_FALSE(statesGain(*dccFrom(shunt.text(), "file.xml")));
}

TEST(DccCertificates, PassOverWhatIsNoFigure) {
    RecordProperty("hazard", "H9");
    for (const auto& [name, value, unit, u] :
         std::vector<std::array<const char*, 4>>{{"Frequency", "1000", "\\hertz", "0.001"},
                                                 {"Frequency response at 20 MHz", "0.7", "\\volt", "0.01"},
                                                 {"Frequency response at 20 MHz", "-3", "\\decibel", "0.1"},
                                                 {"Flatness of the gain", "0.9", "\\one", "0.01"},
                                                 {"Supply voltage", "230", "\\volt", "12"},
                                                 {"Mains voltage", "230", "\\volt", "12"},
                                                 {"Rise time", "3.5", "\\nano\\second", "1"},
                                                 {"Temperature error", "23", "\\degreecelsius", "1"}}) {
        DccText dcc;
        const auto other = dccReal("", name, value, unit, u, "2");
        const auto sound = dccReal("", "Gain error", "0", "\\percent", "0.5", "2");
        for (const auto& results :
             {dccResult("DC", other + sound), kGain + dccResult("Other", other), dccResult(name, other) + kGain}) {
            dcc.results = results;
            const auto found = read({dcc.text()});
            ASSERT_TRUE(found) << found.error().message;
            EXPECT_EQ(found->certificate.gain_pct, 0.5) << name;
            EXPECT_FALSE(found->certificate.timeBase_ppm) << name;
        }
    }
}

TEST(DccCertificates, AreDueOnTheEarliestOfTheirDays) {
    RecordProperty("hazard", "H9");
    std::mt19937 random(3);
    for (int trial = 0; trial < 50; ++trial) {
        DccText dcc;
        dcc.results = kGain;
        std::string earliest = dcc.due;
        for (auto count = random() % 4; count > 0; --count) {
            const auto day = fmt::format("20{}-0{}-1{}", 27 + random() % 9, 1 + random() % 9, random() % 10);
            earliest = std::min(earliest, day);
            dcc.statements += fmt::format(
                R"(<dcc:statement refType="basic_recalibration"><dcc:date>{}</dcc:date></dcc:statement>)", day);
        }
        EXPECT_EQ(dateText(read({dcc.text()})->certificate.due), earliest);
        dcc.statements += R"(<dcc:statement refType="basic_recalibration"><dcc:date>zz</dcc:date></dcc:statement>)";
        expectRefusedDcc(dcc.text(), {"recalibration", "zz"});
    }
}

TEST(DccCertificates, SayWhichCoverageFactorCounts) {
    DccText dcc;
    dcc.results = dccResult("DC", dccReal("", "Gain", "1", "\\one", "0.033", "3.3"));
    const auto found = read({dcc.text()});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(*found->certificate.gain_pct, 3.3, 1e-9);
    EXPECT_THAT(found->notes, Contains(HasSubstr("U (k = 3.3, taken as it is stated) 3.3 %")));
}

TEST(DccCertificates, AreReadQuicklyOrRefusedHoweverManyQuantitiesTheyHave) {
    RecordProperty("hazard", "H10");
    const auto began = std::chrono::steady_clock::now();
    DccText dcc;
    std::string list = dccReal("basic_referenceValue", "Applied", "10", "\\volt", "0.01", "2");
    for (std::size_t i = 1; i < kDccMostQuantities; ++i)
        list += dccReal("basic_measuredValue", "Indicated", "10.1", "\\volt", "0.01", "2");
    dcc.results = dccResult("DC", list);
    const auto found = read({dcc.text()});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(*found->certificate.gain_pct, 1.1, 1e-9);
    for (int i = 0; i < 36'000; ++i) list += dccReal("", "", "1", "\\volt", "1", "2");
    dcc.results = dccResult("DC", list);
    expectRefusedDcc(dcc.text(), {"more than 4096 quantities"});
    dcc.results = dccResult(std::string(10'000, 'n'), list);
    expectRefusedDcc(dcc.text(), {"10000 bytes", "n…"});
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(30));
    // What is foreign is cut in messages.
    dcc.results = kGain;
    for (auto* text : {&dcc.laboratory, &dcc.number, &dcc.ended}) {
        const auto before = std::exchange(*text, std::string(20'000, 'x'));
        Certificate given;
        given.by = "Other";
        const auto refused = read({dcc.text()}, given);
        ASSERT_FALSE(refused);
        EXPECT_LT(refused.error().message.size(), 400U);
        *text = before;
    }
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
