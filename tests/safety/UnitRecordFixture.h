// UnitRecordFixture.h - programs that drive one unit, each with its own clock and gate, and the record that these
// programs share.
//
// Thread-safety: the test's own thread.
#pragma once

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>

#include "core/safety/UnitRecord.h"
#include "tests/safety/GateFixtures.h"

namespace tacto::test {

inline constexpr const char* kUnit = "sciencemode 1234";

/// The computer's time, set by the test.
struct FakeTime final : SystemTime {
    [[nodiscard]] Instant sinceBoot() const noexcept override { return now; }
    [[nodiscard]] std::string boot() const override { return id; }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override { return walls; }
    Instant now = std::chrono::hours(1);
    std::string id = "boot-1";
    std::chrono::sys_seconds walls = SystemTime::real().wall();
};

/// 40 V into 100 ohm: 1e-4 A²s per train at the low end of the load range, so that the limit allows four in 5 s.
inline GateSetup strongSetup() {
    GateSetup setup = benchSetup(Load::resistor(Ohms(100)));
    setup.limits = limitSets();
    return setup;
}

class UnitRecordFile : public testing::Test {
protected:
    /// A program that drives the unit, with its own clock and gate.
    struct Run {
        Run(const UnitRecordFile& test, const GateSetup& setup) : time(test.time_) {
            auto opened = UnitRecord::open(test.folders(), kUnit, clock, test.time_);
            if (!opened) {
                ADD_FAILURE() << opened.error().message;
                return;
            }
            record = std::move(*opened);
            gate.continueFrom(*record);
            EXPECT_TRUE(gate.configure(setup));
        }
        Result<ApprovedTrain> ask() { return gate.approve({volts(40), Seconds(10), clock.now()}); }
        void pass(double seconds) {
            clock.advanceTo(clock.now() + toInstant(seconds));
            time.now += toInstant(seconds);
        }
        FakeTime& time;
        VirtualClock clock;
        std::unique_ptr<UnitRecord> record;
        SafetyGate gate{clock};
    };
    std::unique_ptr<Run> run() { return std::make_unique<Run>(*this, strongSetup()); }
    /// Returns how many of the strong trains are approved in a row.
    static int approvedAtOnce(Run& running) {
        int approved = 0;
        while (approved < 100 && running.ask()) ++approved;
        return approved;
    }
    [[nodiscard]] std::filesystem::path file() const {
        return std::filesystem::directory_iterator(folder_.path())->path();
    }
    void spoil(std::size_t at, char byte = 0x5a) const {
        std::fstream out(file(), std::ios::in | std::ios::out | std::ios::binary);
        out.seekp(static_cast<std::streamoff>(at));
        out.put(byte);
    }

    [[nodiscard]] UnitFolders folders() const { return {folder_.path(), claims_.path()}; }
    /// Empties the claims, as a start of the computer does.
    void emptyClaims() const {
        for (const auto& claim : std::filesystem::directory_iterator(claims_.path())) std::filesystem::remove(claim);
    }

    ScratchDir folder_;
    ScratchDir claims_;
    mutable FakeTime time_;
};

}  // namespace tacto::test
