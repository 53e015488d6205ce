// The built-in instrument profiles (hazards H1 and H9): each figure has a source, no instrument belongs to two series,
// and no folder of the user adds or changes a profile.
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/Shipped.h"
#include "core/base/Csv.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

// Names from libsigrok 0.5 and its master branch of 2026 (src/hardware/*/api.c and protocol.c).
const std::vector<std::string> kDrivenByLibsigrok{
    "Rigol VS5022",          "Rigol VS5202D",         "Rigol DS1052E",      "Rigol DS1152E-EDU",
    "Rigol DS1102D",         "Rigol DS2072",          "Rigol DS2102",       "Rigol DS2202",
    "Rigol DS2302",          "Rigol DS2072A",         "Rigol DS2302A",      "Rigol MSO2072A",
    "Rigol MSO2302A",        "Agilent DSO1002A",      "Agilent DSO1004A",   "Agilent DSO1012A",
    "Agilent DSO1014A",      "Agilent DSO1022A",      "Agilent DSO1024A",   "Agilent DSO1052B",
    "Agilent DSO1152B",      "Rigol DS1054Z",         "Rigol DS1074Z",      "Rigol DS1104Z",
    "Rigol DS1104Z-S",       "Rigol DS1104Z Plus",    "Rigol DS1102Z-E",    "Rigol DS1202Z-E",
    "Rigol MSO1104Z-S",      "Rigol DS4014",          "Rigol DS4024",       "Rigol MSO5072",
    "Rigol MSO5354",         "Agilent MSO7034A",      "Siglent SDS1152CML", "Siglent SDS1202CNL",
    "Siglent SDS1052DL+",    "Siglent SDS1102X",      "Siglent SDS1102X+",  "Siglent SDS1202X-E",
    "Siglent SDS1104X-E",    "Siglent SDS2304X",      "HAMEG HMO722",       "HAMEG HMO1002",
    "Rohde&Schwarz HMO1002", "Rohde&Schwarz HMO1202", "HAMEG HMO3524",      "Rohde&Schwarz RTB2004",
    "Rohde&Schwarz RTM3004", "Yokogawa DLM2022",      "Yokogawa DL9040",    "Hantek DSO-2090",
    "Hantek 6022BL",         "Hung-Chang DSO-2100"};

TEST(ShippedInstruments, EachReadsAndHasASourceForEachFigure) {
    const auto profiles = shippedInstruments();
    ASSERT_TRUE(profiles) << profiles.error().message;
    ASSERT_FALSE(profiles->empty());
    std::set<std::string> ids;
    for (const auto& profile : *profiles) {
        EXPECT_TRUE(ids.insert(profile.id).second) << profile.id << " is there twice";
        int known = 0;
        for (const auto* figure : {&profile.gain, &profile.timeBase}) {
            if (!std::isfinite(figure->value)) continue;
            ++known;
            EXPECT_FALSE(figure->source.empty()) << profile.id;
            EXPECT_TRUE(figure->address.starts_with("http")) << profile.id << ": " << figure->address;
        }
        EXPECT_GT(known, 0) << profile.id << " states nothing and would promise something";
        // A stated 0 would mean a perfect instrument.
        EXPECT_FALSE(profile.gain.value == 0 || profile.timeBase.value == 0) << profile.id;
        const auto statement = profile.statement();
        EXPECT_FALSE(statement.voltage.probe.known() || statement.current.probe.known()) << profile.id;
        EXPECT_FALSE(statement.stamp_s.known()) << profile.id;
    }
}

TEST(ShippedInstruments, AreNamedAsTheirFiles) {
    const auto profiles = shippedInstruments().value();
    for (const auto& profile : profiles) {
        const auto file = sourceDir() / "resources" / "instruments" / (profile.id + ".json");
        const auto text = readTextFile(file);
        ASSERT_TRUE(text) << text.error().message;
        EXPECT_EQ(parseInstrumentProfile(*text, file.string()).value().title, profile.title);
    }
}

TEST(ShippedInstruments, NoInstrumentIsOfTwoSeriesAndEachSeriesHasOne) {
    const auto profiles = shippedInstruments().value();
    std::set<std::string> met;
    for (const auto& name : kDrivenByLibsigrok) {
        std::vector<std::string> of;
        for (const auto& profile : profiles) {
            if (profile.matches(name)) of.push_back(profile.id);
        }
        EXPECT_LE(of.size(), 1U) << name << ": " << testing::PrintToString(of);
        met.insert(of.begin(), of.end());
    }
    for (const auto& profile : profiles) EXPECT_TRUE(met.contains(profile.id)) << profile.id << " is of no instrument";
}

TEST(ShippedInstruments, AMakersOtherSeriesStatesNothing) {
    const auto profiles = shippedInstruments().value();
    EXPECT_DOUBLE_EQ(statementOf(profiles, "Rigol DS2072").voltage.linearity.value, 0.02);
    EXPECT_DOUBLE_EQ(statementOf(profiles, "Rigol DS2072").timeBase.value, 75e-6);
    for (const char* other : {"Rigol DS2072A", "Rigol MSO2072A", "Rigol DS1054Z", "Rigol MSO5072", "Siglent SDS1104X-E",
                              "HAMEG HMO722", "demo Demo device", ""}) {
        const auto statement = statementOf(profiles, other);
        EXPECT_FALSE(statement.voltage.gain.known() || statement.current.gain.known() || statement.timeBase.known())
            << other;
    }
}

TEST(ShippedInstruments, NoFolderOfResourcesAddsOrChangesOne) {
    ScratchDir folder;
    std::filesystem::create_directories(folder.path() / "instruments");
    auto text = readTextFile(sourceDir() / "resources" / "instruments" / "rigol-ds2000.json").value();
    const std::string figure = "\"pct\": 2,";
    const auto at = text.find(figure);
    ASSERT_NE(at, std::string::npos);
    folder.write("instruments/rigol-ds2000.json", text.replace(at, figure.size(), "\"pct\": 0.01,"));
    ::setenv("TACTOSCOPE_RESOURCES", folder.path().c_str(), 1);
    const auto statement = statementOf(shippedInstruments().value(), "Rigol DS2072");
    ::unsetenv("TACTOSCOPE_RESOURCES");
    EXPECT_DOUBLE_EQ(statement.voltage.linearity.value, 0.02);
}

}  // namespace
}  // namespace tacto::test
