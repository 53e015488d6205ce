// Which program may drive a unit, and which of its records knows its past: several programs, accounts, data folders and
// copies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/safety/UnitRecordFixture.h"

namespace tacto::test {

using testing::HasSubstr;

class UnitClaim : public UnitRecordFile {};

TEST_F(UnitClaim, OneUnitIsDrivenByOneProgram) {
    RecordProperty("hazard", "H1");
    auto first = run();
    VirtualClock clock;
    const auto second = UnitRecord::open(folders(), kUnit, clock, time_);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::Device);
    EXPECT_THAT(second.error().message, HasSubstr(fmt::format("(process {})", ::getpid())));
    EXPECT_THAT(second.error().message, HasSubstr(kUnit));
    first.reset();
    EXPECT_TRUE(UnitRecord::open(folders(), kUnit, clock, time_));
}

TEST_F(UnitClaim, OnlyTheLastRecordOfAUnitOnThisComputerKnowsItsPast) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    // The records of two accounts or data folders, both of which have long been there.
    const auto drive = [&](const std::filesystem::path& records, std::size_t expected, const char* why) {
        const VirtualClock clock;
        SafetyGate gate(clock);
        const auto record = UnitRecord::open({records, claims_.path()}, kUnit, clock, time_);
        ASSERT_TRUE(record) << record.error().message;
        EXPECT_THAT(std::string((*record)->whyQuiet()), HasSubstr(why));
        gate.continueFrom(**record);
        ASSERT_TRUE(gate.configure(strongSetup()));
        std::size_t approved = 0;
        while (approved < 100 && gate.approve({volts(40), Seconds(10), clock.now()})) ++approved;
        EXPECT_EQ(approved, expected);
        EXPECT_EQ(gate.approveCheck(clock.now()).has_value(), std::string_view(why).empty()) << "not even a check";
    };
    drive(folder_.path(), 4, "");
    time_.now += std::chrono::seconds(20);
    drive(other.path(), 0, "from another record");
    time_.now += std::chrono::seconds(20);
    drive(other.path(), 4, "");
    drive(folder_.path(), 0, "from another record");
    time_.now += std::chrono::seconds(3);
    drive(folder_.path(), 0, "did not know it either");
    time_.now += std::chrono::seconds(6);
    drive(folder_.path(), 4, "");
    drive(folder_.path() / "a new one", 0, "from another record");
    time_.now += std::chrono::seconds(20);
    drive(folder_.path() / "a new one", 4, "");
    std::filesystem::remove_all(folder_.path() / "a new one");
    drive(folder_.path() / "a new one", 0, "from another record");
}

TEST_F(UnitClaim, ACopyOfARecordIsAnotherRecord) {
    RecordProperty("hazard", "H1");
    const ScratchDir copy;
    const auto from = [&](const std::filesystem::path& records) {
        const VirtualClock clock;
        SafetyGate gate(clock);
        const auto record = UnitRecord::open({records, claims_.path()}, kUnit, clock, time_).value();
        gate.continueFrom(*record);
        EXPECT_TRUE(gate.configure(strongSetup()));
        std::size_t approved = 0;
        while (approved < 100 && gate.approve({volts(40), Seconds(10), clock.now()})) ++approved;
        return approved;
    };
    EXPECT_EQ(from(folder_.path()), 4U);
    std::filesystem::copy(folder_.path(), copy.path(), std::filesystem::copy_options::recursive);
    time_.now += std::chrono::seconds(20);
    EXPECT_EQ(from(folder_.path()), 4U);
    EXPECT_EQ(from(copy.path()), 0U) << "it knows nothing of the last four";
    time_.now += std::chrono::seconds(20);
    EXPECT_EQ(from(copy.path()), 4U);
    EXPECT_EQ(from(folder_.path()), 0U);
}

TEST_F(UnitClaim, AFaultIsFoundInAnEarlierCopyOfTheRecordToo) {
    RecordProperty("hazard", "H3");
    const ScratchDir copy;
    const VirtualClock clock;
    { const auto before = run(); }
    std::filesystem::copy(folder_.path(), copy.path(), std::filesystem::copy_options::recursive);
    run()->record->keepFault(FaultCause::OpenElectrode, "the electrode is open");
    EXPECT_TRUE(UnitRecord::open({copy.path(), claims_.path()}, kUnit, clock, time_).value()->fault());
}

TEST_F(UnitClaim, WithoutAPlaceForClaimsAUnitAlwaysRests) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    const auto rests = [&](const std::filesystem::path& claims) {
        const VirtualClock clock;
        const auto record = UnitRecord::open({folder_.path(), claims}, kUnit, clock, time_);
        if (!record) return record.error().message;
        time_.now += std::chrono::seconds(20);
        return std::string((*record)->whyQuiet());
    };
    EXPECT_EQ(rests(claims_.path()), "");
    EXPECT_EQ(rests(claims_.path()), "");
    EXPECT_THAT(rests(claims_.path() / "none"), HasSubstr("no place"));
    const auto claim = std::filesystem::directory_iterator(claims_.path())->path();
    EXPECT_EQ(std::filesystem::status(claim).permissions(), std::filesystem::perms(0666)) << "for every account";
    const auto evidence = other.write("evidence.tacto", "a session");
    std::filesystem::remove(claim);
    std::filesystem::create_symlink(evidence, claim);
    EXPECT_THAT(rests(claims_.path()), HasSubstr("no place"));
    EXPECT_EQ(std::filesystem::file_size(evidence), 9U) << "it was written over";
    std::filesystem::remove(claim);
    EXPECT_EQ(rests(claims_.path()), "") << "the computer was started";
    std::filesystem::resize_file(claim, 3);
    EXPECT_THAT(rests(claims_.path()), HasSubstr("from another record")) << "a damaged claim belongs to no program";
    EXPECT_EQ(rests(claims_.path()), "");
}

TEST_F(UnitClaim, TwoAccountsNeverDriveOneUnitAtOnce) {
    RecordProperty("hazard", "H1");
    const ScratchDir other;
    const auto first = run();
    const VirtualClock clock;
    const auto second = UnitRecord::open({other.path(), claims_.path()}, kUnit, clock, time_);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::Device);
    EXPECT_THAT(second.error().message, HasSubstr(fmt::format("(process {})", ::getpid())));
}

TEST_F(UnitClaim, AFaultIsFoundFromEveryAccount) {
    RecordProperty("hazard", "H3");
    const ScratchDir other;
    const VirtualClock clock;
    const auto elsewhere = [&] {
        return UnitRecord::open({other.path(), claims_.path()}, kUnit, clock, time_).value();
    };
    run()->record->keepFault(FaultCause::OpenElectrode, "the electrode is open");
    const auto fault = elsewhere()->fault();
    ASSERT_TRUE(fault);
    EXPECT_THAT(std::string(fault->reason.view()), HasSubstr("of another account or data folder"));
    elsewhere()->clearFault();
    EXPECT_FALSE(elsewhere()->fault());
    EXPECT_THAT(std::string(run()->record->fault().value().reason.view()), HasSubstr("the electrode is open"))
        << "a record forgets nothing that it saw itself";
}

}  // namespace tacto::test
