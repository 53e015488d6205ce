// The laboratory's instruments by name: what is kept, what is refused, and what becomes part of an address.
#include <fstream>
#include <gmock/gmock.h>

#include "app/run/InstrumentPresets.h"
#include "core/devices/DeviceUri.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const auto kToday = parseDate("2026-11-23").value();

InstrumentPreset scope() {
    return {InstrumentKind::Oscilloscope,
            "bench DS2072A",
            "DS2D1",
            "sigrok:rigol-ds:conn=x?voltage=CH1&current=CH2",
            {},
            2.0,
            50.0,
            parseDate("2027-03-01")};
}
InstrumentPreset shunt() { return {InstrumentKind::Shunt, "R100", "R7", "", 100.0, 0.1, {}, parseDate("2027-03-01")}; }
InstrumentPreset probe() { return {InstrumentKind::Probe, "10:1", "", "", {}, 1.0, {}, {}}; }

class Presets : public testing::Test {
protected:
    [[nodiscard]] InstrumentPresets open() const { return InstrumentPresets::open(file).value(); }
    ScratchDir folder;
    std::filesystem::path file = folder.path() / "lab" / "instruments.json";
};

TEST_F(Presets, AreSavedOnceAndReplacedByName) {
    auto presets = open();
    EXPECT_TRUE(presets.all().empty());
    ASSERT_TRUE(presets.save(scope()));
    ASSERT_TRUE(presets.save(shunt()));
    auto better = shunt();
    better.accuracy_pct = 0.05;
    ASSERT_TRUE(presets.save(better));
    const auto again = open();
    ASSERT_EQ(again.all().size(), 2U);
    EXPECT_EQ(again.all()[0].address, scope().address);
    EXPECT_EQ(again.all()[0].timeBase_ppm, 50.0);
    EXPECT_EQ(again.all()[0].due, scope().due);
    EXPECT_EQ(again.all()[1].accuracy_pct, 0.05);
    EXPECT_EQ(again.all()[1].ohms, 100.0);
    EXPECT_FALSE(again.all()[1].timeBase_ppm);
    ASSERT_TRUE(presets.remove(InstrumentKind::Shunt, "R100"));
    EXPECT_EQ(open().all().size(), 1U);
    EXPECT_EQ(presets.remove(InstrumentKind::Probe, "R100").error().code, ErrorCode::NotFound);
}

TEST_F(Presets, AreRefusedInOneSentence) {
    RecordProperty("hazard", "H9");
    auto presets = open();
    const auto refusal = [&](InstrumentPreset preset) {
        const auto saved = presets.save(preset);
        return saved ? std::string("accepted") : saved.error().message;
    };
    auto one = shunt();
    one.ohms.reset();
    EXPECT_THAT(refusal(one), HasSubstr("above 0 to 1000000 ohm"));
    one = shunt();
    one.accuracy_pct = 51;
    EXPECT_THAT(refusal(one), HasSubstr("50 %"));
    one = shunt();
    one.accuracy_pct = std::nan("");
    EXPECT_NE(refusal(one), "accepted");
    one = scope();
    one.address = "no address";
    EXPECT_NE(refusal(one), "accepted");
    one = scope();
    one.address += "&gain_pct=1";
    EXPECT_THAT(refusal(one), HasSubstr("states gain_pct"));
    one = probe();
    one.name = "";
    EXPECT_NE(refusal(one), "accepted");
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(Presets, ADamagedFileIsSaidAndLeftAlone) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(open().save(shunt()));
    std::ofstream(file) << R"({"instruments": [{"kind": "shunt", "name": "R100", "ohms": -1}]})";
    const auto read = InstrumentPresets::open(file);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("instruments.json"));
    EXPECT_THAT(read.error().message, HasSubstr("-1"));
}

TEST(ComposedAddress, StatesWhatIsChosen) {
    const auto address = composed({scope(), shunt(), probe()}, kToday);
    EXPECT_EQ(address.text,
              "sigrok:rigol-ds:conn=x?voltage=CH1&current=CH2&shunt=100ohm&gain_pct=2&timebase_ppm=50&shunt_pct=0.1"
              "&probe_pct=1");
    EXPECT_TRUE(address.said.empty());
    auto uri = DeviceUri::parse(address.text).value();
    const auto stated = takeStatement(uri).value();
    ASSERT_TRUE(stated);
    EXPECT_DOUBLE_EQ(stated->voltage.gain.value, 0.02);
    EXPECT_DOUBLE_EQ(stated->current.probe.value, 0.001);
}

TEST(ComposedAddress, AnExpiredInstrumentIsNeitherSilentNorUsed) {
    RecordProperty("hazard", "H9");
    auto old = shunt();
    old.due = parseDate("2026-11-22");
    const auto address = composed({scope(), old, probe()}, kToday);
    EXPECT_THAT(address.text, HasSubstr("shunt=100ohm")) << "its value is what is wired";
    EXPECT_THAT(address.text, testing::Not(HasSubstr("shunt_pct")));
    EXPECT_THAT(address.said,
                ElementsAre("The certificate of the shunt R100 expired on 2026-11-22: its tolerance is not "
                            "used, and currents have no uncertainty."));
    old.due = kToday;
    EXPECT_THAT(composed({scope(), old, probe()}, kToday).text, HasSubstr("shunt_pct")) << "the last day counts";
}

TEST(ComposedAddress, WhatIsNotStatedIsSaidAndNeverZero) {
    RecordProperty("hazard", "H9");
    auto bare = scope();
    bare.accuracy_pct.reset();
    bare.timeBase_ppm.reset();
    const auto address = composed({bare, {}, {}}, kToday);
    EXPECT_EQ(address.text, bare.address);
    EXPECT_EQ(address.said.size(), 4U);
    EXPECT_TRUE(composed({{}, shunt(), {}}, kToday).text.empty());
}

TEST(ComposedAddress, ASimulatedOscilloscopeHasNoShunt) {
    auto simulated = scope();
    simulated.address = "sim:oscilloscope";
    EXPECT_EQ(composed({simulated, shunt(), {}}, kToday).text,
              "sim:oscilloscope?gain_pct=2&timebase_ppm=50&shunt_pct=0.1");
}

}  // namespace
}  // namespace tacto::test
