#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include "core/base/Statistics.h"
#include "core/calibration/CertificateStore.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

CalibrationDate dayOf(const char* text) { return parseDate(text).value(); }

Certificate certificateOf(const std::string& serial, const std::string& number = "4711",
                          const char* date = "2026-01-05", const char* due = "2027-01-05") {
    return {"Rigol DS1054Z", serial, number, "DAkkS Lab", dayOf(date), dayOf(due), 0.5, 2.0, 0.1, 1.0};
}

std::string contentsOf(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

class CertificateStoreFile : public testing::Test {
protected:
    [[nodiscard]] CertificateStore store() const { return CertificateStore::open(path).value(); }
    /// Returns the state of the certificate with that number.
    [[nodiscard]] CertificateState stateOf(const char* number, const char* day) const {
        const auto kept = store();
        for (std::size_t i = 0; i < kept.all().size(); ++i) {
            if (kept.all()[i].certificate.number == number) return kept.state(i, dayOf(day));
        }
        ADD_FAILURE() << number << " is not there";
        return CertificateState::Withdrawn;
    }
    ScratchDir folder;
    std::filesystem::path path = folder.path() / "lab" / "certificates.jsonl";
    CalibrationDate today = dayOf("2026-11-23");
};

TEST_F(CertificateStoreFile, KeepsEveryCertificateAsItWasEntered) {
    auto first = store();
    auto bare = certificateOf("B2", "12");
    bare.timeBase_ppm = bare.shunt_pct = bare.probe_pct = std::nullopt;
    ASSERT_TRUE(first.add(certificateOf("A1"), today));
    const auto before = contentsOf(path);
    ASSERT_TRUE(first.add(bare, today));
    EXPECT_TRUE(contentsOf(path).starts_with(before));
    const auto again = store();
    ASSERT_EQ(again.all().size(), 2U);
    EXPECT_EQ(again.all()[0].certificate, certificateOf("A1"));
    EXPECT_EQ(again.all()[1].certificate, bare);
    EXPECT_EQ(again.all()[1].entered, today);
    EXPECT_EQ(stateOf("4711", "2026-11-23"), CertificateState::Counts);
    EXPECT_FALSE(again.newest("A", today));
    EXPECT_FALSE(again.newest("", today));
}

TEST_F(CertificateStoreFile, CountsFromItsDateUntilItIsDue) {
    RecordProperty("hazard", "H9");
    ASSERT_TRUE(store().add(certificateOf("A1"), today));
    EXPECT_EQ(stateOf("4711", "2026-01-04"), CertificateState::NotYet);
    EXPECT_EQ(stateOf("4711", "2026-01-05"), CertificateState::Counts);
    EXPECT_EQ(stateOf("4711", "2027-01-05"), CertificateState::Counts);
    EXPECT_EQ(stateOf("4711", "2027-01-06"), CertificateState::Expired);
}

TEST_F(CertificateStoreFile, TheLatestDateCountsWhateverWasEnteredLast) {
    RecordProperty("hazard", "H9");
    auto kept = store();
    ASSERT_TRUE(kept.add(certificateOf("A1", "new", "2026-06-01", "2026-12-01"), today));
    ASSERT_TRUE(kept.add(certificateOf("A1", "old", "2025-06-01", "2030-06-01"), today));
    ASSERT_TRUE(kept.add(certificateOf("A1", "next", "2027-06-01", "2028-06-01"), today));
    EXPECT_EQ(stateOf("new", "2026-11-23"), CertificateState::Counts);
    EXPECT_EQ(stateOf("old", "2026-11-23"), CertificateState::Superseded);
    EXPECT_EQ(stateOf("next", "2026-11-23"), CertificateState::NotYet);
    // An expired certificate does not make the older one valid again.
    EXPECT_EQ(stateOf("new", "2026-12-02"), CertificateState::Expired);
    EXPECT_EQ(stateOf("old", "2026-12-02"), CertificateState::Superseded);
    EXPECT_EQ(stateOf("next", "2027-06-01"), CertificateState::Counts);
}

TEST_F(CertificateStoreFile, AWithdrawnOneStaysAndTheOneBeforeCounts) {
    auto kept = store();
    ASSERT_TRUE(kept.add(certificateOf("A1", "1", "2026-01-05"), today));
    ASSERT_TRUE(kept.add(certificateOf("A1", "2", "2026-02-05"), today));
    EXPECT_THAT(kept.add(certificateOf("A1", "2"), today).error().message, HasSubstr("entered already"));
    ASSERT_TRUE(kept.withdraw("2", "", today));
    EXPECT_EQ(kept.all()[1].withdrawn, today);
    EXPECT_EQ(stateOf("2", "2026-11-23"), CertificateState::Withdrawn);
    EXPECT_EQ(stateOf("1", "2026-11-23"), CertificateState::Counts);
    EXPECT_EQ(kept.withdraw("2", "", today).error().code, ErrorCode::NotFound);
    ASSERT_TRUE(kept.add(certificateOf("A1", "2"), today));  // the corrected certificate
    ASSERT_TRUE(kept.add(certificateOf("B1", "2"), today));
    EXPECT_THAT(kept.withdraw("2", "", today).error().message, HasSubstr("A1, B1"));
    ASSERT_TRUE(kept.withdraw("2", "B1", today));
    EXPECT_EQ(store().all().size(), 4U);
}

TEST_F(CertificateStoreFile, WhatWasChangedOrTakenOutIsFound) {
    RecordProperty("hazard", "H8");
    auto kept = store();
    ASSERT_TRUE(kept.add(certificateOf("A1"), today));
    const auto endOfFirst = contentsOf(path.string() + ".end");
    ASSERT_TRUE(kept.add(certificateOf("B2"), today));
    const auto sound = contentsOf(path);
    const auto why = [&](const std::string& text) {
        std::ofstream(path) << text;
        const auto read = CertificateStore::open(path);
        return read ? std::string("read") : read.error().message;
    };
    auto changed = sound;
    changed.replace(changed.find("0.5"), 3, "0.1");
    EXPECT_THAT(why(changed), HasSubstr("certificates.jsonl:1: its digest"));
    EXPECT_THAT(why(sound.substr(sound.find('\n') + 1)), HasSubstr(":1: the line before it"));
    EXPECT_THAT(why("{}\n"), HasSubstr("this is not a certificate"));
    EXPECT_THAT(why(sound.substr(0, sound.size() - 5)), HasSubstr("lines are missing"));
    std::ofstream(path.string() + ".end") << endOfFirst;
    EXPECT_EQ(why(sound.substr(0, sound.size() - 5)), "read");  // cut short by a crash, before the note on its end
    EXPECT_TRUE(store().lastLineCut());
    EXPECT_EQ(store().all().size(), 1U);
}

TEST_F(CertificateStoreFile, RefusesWhatNoCertificateSays) {
    RecordProperty("hazard", "H9");
    const auto why = [&](auto change) {
        auto c = certificateOf("A1");
        change(c);
        const auto added = store().add(c, today);
        return added ? std::string("taken") : added.error().message;
    };
    for (const double u : {kNaN, 0.0, -1.0, 50.1, std::numeric_limits<double>::infinity()}) {
        EXPECT_THAT(why([&](Certificate& c) { c.gain_pct = u; }), HasSubstr("above 0 to 50 %")) << u;
        EXPECT_THAT(why([&](Certificate& c) { c.probe_pct = u; }), HasSubstr("U of the probe")) << u;
    }
    EXPECT_THAT(why([](Certificate& c) { c.timeBase_ppm = 2e5; }), HasSubstr("100000 ppm"));
    EXPECT_THAT(why([](Certificate& c) { c.gain_pct.reset(); }), HasSubstr("missing"));
    EXPECT_THAT(why([](Certificate& c) { c.serial = "  "; }), HasSubstr("serial number is empty"));
    EXPECT_THAT(why([](Certificate& c) { c.number.clear(); }), HasSubstr("certificate number is empty"));
    EXPECT_THAT(why([](Certificate& c) { c.by = "Lab\x1b[2J"; }), HasSubstr("printable"));
    EXPECT_THAT(why([](Certificate& c) { c.by = "\xff"; }), HasSubstr("printable"));
    EXPECT_THAT(why([](Certificate& c) { c.due = dayOf("2026-01-04"); }), HasSubstr("before its date 2026-01-05"));
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_EQ(why([](Certificate&) {}), "taken");
}

TEST(Certificate, StatesHalfWidthsWhose95PercentAreItsU) {
    RecordProperty("hazard", "H9");
    auto certificate = certificateOf("A1");
    const auto all = statementOf(certificate);
    EXPECT_NEAR(0.95 * all.voltage.gain.value, 0.005, 1e-15);
    EXPECT_DOUBLE_EQ(all.current.gain.value, all.voltage.gain.value);
    EXPECT_NEAR(all.timeBase.value, 2e-6 / 0.95, 1e-13);
    EXPECT_NEAR(all.current.probe.value, 0.001 / 0.95, 1e-11);
    EXPECT_NEAR(all.voltage.probe.value, 0.01 / 0.95, 1e-10);
    EXPECT_EQ(all.timeBase.by, "certificate 4711 (DAkkS Lab, 2026-01-05, due 2027-01-05)");
    EXPECT_FALSE(all.voltage.offset.known());
    EXPECT_FALSE(all.stamp_s.known());
    certificate.timeBase_ppm = certificate.shunt_pct = certificate.probe_pct = std::nullopt;
    const auto gain = statementOf(certificate);
    EXPECT_TRUE(gain.voltage.gain.known());
    EXPECT_FALSE(gain.timeBase.known() || gain.current.probe.known() || gain.voltage.probe.known());
}

}  // namespace
}  // namespace tacto::test
