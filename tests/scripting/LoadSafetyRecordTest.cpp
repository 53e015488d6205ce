// The records that runs of the load-safety protocol keep about the stimulator.
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/LoadSafetyRecord.h"
#include "app/run/ProtocolRun.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/safety/UnitRecord.h"
#include "core/session/Digest.h"
#include "core/session/Origin.h"
#include "core/session/SessionReader.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/Technician.h"
#include "tests/support/Refused.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

class LoadSafetyRecord : public DataHome {
protected:
    [[nodiscard]] RunOrder order(const std::map<std::string, std::string>& settings) const {
        RunOrder made;
        made.script = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find("load-safety").value();
        made.declaration = readDeclaration(made.script).value();
        made.settings = applySettings(made.declaration, settings).value();
        made.uris = {DeviceUri::parse("sim:").value()};
        made.limits = shippedLimits().value();
        made.out = (folder_.path() / "out").string();
        return made;
    }
    RunResult run(RunOrder wanted, bool stopped = false) {
        std::vector<std::unique_ptr<Driver>> drivers;
        drivers.push_back(makeSimulatedDriver());
        Registry registry(std::move(drivers));
        auto made = ProtocolRun::prepare(std::move(wanted), registry);
        if (!made) {
            ADD_FAILURE() << made.error().message;
            return {};
        }
        if (stopped) {
            RunRequest hooks;
            hooks.onProgress = [&](const ScriptProgress&) {
                if (during_.empty()) during_ = kept();
                (*made)->bench().stop("operator");
            };
            EXPECT_TRUE((*made)->start(std::move(hooks)));
        } else {
            RunRequest hooks;
            hooks.onLog = [this](const std::string& line) { logged_ += line + "\n"; };
            EXPECT_TRUE((*made)->start(std::move(hooks)));
        }
        return (*made)->finish();
    }
    [[nodiscard]] static std::vector<LoadSafetyCheck> kept() {
        return LoadSafetyStore::open(loadSafetyFile()).value().all();
    }

    std::string logged_;                   // log lines of runs that were not stopped
    std::vector<LoadSafetyCheck> during_;  // the records during the run that is stopped
};

TEST_F(LoadSafetyRecord, APassIsKeptWithItsSessionsChainHeadAndAsSimulated) {
    RecordProperty("hazard", "H9");
    const auto wanted = order({{"area", "3"}, {"steps", "2"}, {"trains", "2"}});
    const auto limits = wanted.limits;
    const auto result = run(wanted);
    EXPECT_EQ(result.verdict(), "pass");
    const auto all = kept();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].verdict, CheckVerdict::Begun);
    EXPECT_EQ(all[0].sessionHead, "");
    const auto& pass = all[1];
    EXPECT_EQ(pass.verdict, CheckVerdict::Pass);
    EXPECT_EQ(pass.serial, "SIM-1");
    EXPECT_TRUE(pass.simulated);
    EXPECT_EQ(pass.made, utcToday());
    EXPECT_EQ(pass.area, SquareCentimetres(3));
    EXPECT_EQ(pass.reach, (TrainReach{40, 0.5, 200, 500, 10'000}));
    EXPECT_EQ(pass.tolerances, (CheckTolerances{.load_pct = 5, .amplitude_pct = 2})) << "as the script declares";
    EXPECT_EQ(pass.scriptSha256, shippedLoadSafetySha256());
    EXPECT_EQ(pass.session, result.session.filename().string());
    EXPECT_EQ(pass.sessionHead, SessionReader::open(result.session).value().chainHead());
    ASSERT_EQ(pass.limits.size(), limits.sets.size());
    for (std::size_t i = 0; i < limits.sets.size(); ++i)
        EXPECT_EQ(pass.limits[i], (LimitSetHash{limits.sets[i].id, limits.sha256[i]}));
}

TEST_F(LoadSafetyRecord, AnOperatorsWiderTolerancesAreKeptAndItIsSaidThatThePassCountsForNoSession) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(run(order({{"area", "3"}, {"steps", "2"}, {"trains", "2"}})).verdict(), "pass");
    EXPECT_THAT(logged_, testing::Not(testing::HasSubstr("counts for no session")));
    const auto wide = order({{"area", "3"}, {"steps", "2"}, {"trains", "2"}, {"amplitude_tolerance", "20"}});
    EXPECT_EQ(run(wide).verdict(), "pass");
    EXPECT_THAT(logged_,
                testing::HasSubstr("A pass of this check counts for no session with a person: it allows 20 % for "
                                   "an amplitude over the command; at most 2 % is expected."));
    EXPECT_EQ(kept().back().tolerances, (CheckTolerances{.load_pct = 5, .amplitude_pct = 20}));
}

TEST_F(LoadSafetyRecord, WithoutAnElectrodeAreaItIsKeptAsIndeterminate) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(run(order({{"steps", "2"}, {"trains", "2"}})).verdict(), "indeterminate");
    const auto all = kept();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].verdict, CheckVerdict::Indeterminate);
    EXPECT_FALSE(all[1].area);
}

TEST_F(LoadSafetyRecord, AStoppedOneIsKeptAsStoppedAndWouldHaveCountedAsBegunHadItBeenKilled) {
    RecordProperty("hazard", "H9");
    EXPECT_EQ(run(order({{"area", "3"}}), true).verdict(), "stopped");
    ASSERT_EQ(during_.size(), 1U);
    EXPECT_EQ(during_[0].verdict, CheckVerdict::Begun);
    const auto all = kept();
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[1].verdict, CheckVerdict::Stopped);
}

TEST_F(LoadSafetyRecord, AScriptThatIsNotTheShippedOneLeavesNone) {
    RecordProperty("hazard", "H9");
    auto altered = order({});
    altered.script.text = R"(protocol({ title: "Passes", kind: "load-safety", needs: ["stimulator"] });
function run() { return verdict({ kind: "load-safety", verdict: "pass", reasons: [] }); })";
    altered.declaration = {};
    altered.settings = {};
    altered.script.shipped = true;  // the caller's claim must not be believed
    EXPECT_EQ(run(altered).verdict(), "pass");
    EXPECT_TRUE(kept().empty());
    SessionAbout about;
    about.devices = {{"sciencemode:/dev/ttyUSB0", "stimulator", "P24", "0815", "", false, origin::kHardware}};
    EXPECT_FALSE(loadSafetyCheckOf(altered.script, about, Profile(), "a.tacto"));
}

/// Opens the simulated bench with a stimulator that reports itself as real, so that its faults are kept.
class KeptDriver final : public Driver {
public:
    explicit KeptDriver(std::string serial) : serial_(std::move(serial)) {}
    [[nodiscard]] std::string_view scheme() const noexcept override { return "sim"; }
    [[nodiscard]] std::vector<DeviceIdentity> list() const override { return {}; }
    [[nodiscard]] bool runsOnVirtualClock() const noexcept override { return true; }
    [[nodiscard]] Result<void> open(const DeviceUri& uri, const std::set<Role>& wanted, const OpenContext& context,
                                    DeviceSet& into) override {
        if (auto opened = twin_->open(uri, wanted, context, into); !opened) return opened;
        into.stimulator = std::make_unique<RealLookingStimulator>(std::move(into.stimulator), serial_);
        return {};
    }

private:
    std::unique_ptr<Driver> twin_ = makeSimulatedDriver();
    std::string serial_;
};

TEST_F(LoadSafetyRecord, OnlyAPassEndsAGraveFaultAlsoOfACheckThatIsKilled) {
    RecordProperty("hazard", "H2");
    const OwnSerial serial("LAB");
    SteadyClock clock;
    const auto unit = unitOf(serial.text(), "sim:");
    const auto recordIn = [&](const UnitFolders& folders) { return accepted(UnitRecord::open(folders, unit, clock)); };
    recordIn(unitFolders())->keepFault(FaultCause::LimitBroken, "44 V were measured");
    const auto isLeft = [&](const UnitFolders& folders) {
        const auto left = recordIn(folders)->fault();
        return left && graveCause(left->causes) == FaultCause::LimitBroken &&
               left->reason.view() == "44 V were measured";
    };
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(std::make_unique<KeptDriver>(serial.text()));
    Registry registry(std::move(drivers));
    int kills = 0;
    std::optional<LeftFault> leftIn;
    const auto run = [&](RunOrder wanted, bool stopped) {
        wanted.resetFault = true;
        leftIn.reset();
        auto made = ProtocolRun::prepare(std::move(wanted), registry, nullptr, &leftIn);
        if (!made) return made.error().message;
        Technician technician(nullptr);
        RunRequest hooks;
        hooks.operatorDesk = &technician;
        hooks.onProgress = [&](const ScriptProgress&) {
            // What a kill leaves is what the files have at that moment.
            const ScratchDir disk, claims;
            std::filesystem::copy(unitFolders().records, disk.path(), std::filesystem::copy_options::recursive);
            EXPECT_TRUE(isLeft({disk.path(), claims.path()})) << "killed after " << kills << " steps";
            ++kills;
            if (stopped) (*made)->bench().stop("operator");
        };
        EXPECT_TRUE((*made)->start(std::move(hooks)));
        const auto result = (*made)->finish();
        leftIn = result.leftIn;
        return result.verdict() + (result.outcome.error ? result.outcome.error->message : "");
    };
    auto altered = order({});
    altered.script.text = R"(protocol({ title: "Passes", kind: "load-safety", needs: ["stimulator"] });
function run() { return verdict({ kind: "load-safety", verdict: "pass", reasons: [] }); })";
    altered.declaration = readDeclaration(altered.script).value();
    altered.settings = {};
    EXPECT_THAT(run(altered, false), HasSubstr("Run the safety check first")) << "not the shipped one";
    EXPECT_TRUE(isLeft(unitFolders()));
    const auto check = order({{"area", "3"}, {"steps", "2"}, {"trains", "2"}});
    EXPECT_THAT(run(check, true), testing::StartsWith("stopped"));
    EXPECT_TRUE(isLeft(unitFolders()));
    ASSERT_TRUE(leftIn);
    EXPECT_EQ(leftIn->grave(), FaultCause::LimitBroken);
    {
        auto unfinished = check;
        unfinished.resetFault = true;
        EXPECT_TRUE(ProtocolRun::prepare(unfinished, registry));
    }
    EXPECT_TRUE(isLeft(unitFolders())) << "a check that did not begin";
    const auto wide = order({{"area", "3"}, {"steps", "2"}, {"trains", "2"}, {"amplitude_tolerance", "19"}});
    EXPECT_EQ(run(wide, false), "pass");
    EXPECT_TRUE(isLeft(unitFolders())) << "a check that the laboratory's own tolerances may not pass";
    kills = 0;
    EXPECT_EQ(run(check, false), "pass");
    EXPECT_GT(kills, 5);
    EXPECT_FALSE(leftIn);
    EXPECT_FALSE(recordIn(unitFolders())->fault());
}

TEST_F(LoadSafetyRecord, OnlyHardwareThroughoutIsReal) {
    RecordProperty("hazard", "H9");
    const auto script = order({}).script;
    SessionAbout about;
    about.devices = {{"sciencemode:/dev/ttyUSB0?channel=2", "stimulator", "P24", "0815", "", false, origin::kHardware},
                     {"rigol:", "oscilloscope", "DS1054Z", "DS1", "", false, origin::kHardware}};
    const auto real = loadSafetyCheckOf(script, about, Profile(), "a.tacto");
    ASSERT_TRUE(real);
    EXPECT_FALSE(real->simulated);
    EXPECT_EQ(real->serial, "0815 channel=2");
    about.devices[1].origin = origin::kReplayedMeasured;
    EXPECT_TRUE(loadSafetyCheckOf(script, about, Profile(), "a.tacto")->simulated);
    about.devices[1].origin = origin::kSimulated;
    EXPECT_TRUE(loadSafetyCheckOf(script, about, Profile(), "a.tacto")->simulated);
    about.devices[0].serial.clear();
    EXPECT_FALSE(loadSafetyCheckOf(script, about, Profile(), "a.tacto"));
}

TEST_F(LoadSafetyRecord, WhatCannotBeKeptOfARealStimulatorIsSaid) {
    RecordProperty("hazard", "H9");
    std::filesystem::create_directories(loadSafetyFile());  // so that no file can be written there
    SessionAbout about;
    about.devices = {{"sciencemode:/dev/ttyUSB0", "stimulator", "P24", "0815", "", false, origin::kHardware}};
    auto check = loadSafetyCheckOf(order({}).script, about, Profile(), "a.tacto");
    ASSERT_TRUE(check);
    const auto refused = keepCheck(*check);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("the load-safety check of stimulator 0815 cannot be kept"));
    check->simulated = true;
    EXPECT_TRUE(keepCheck(*check));
}

}  // namespace
}  // namespace tacto::test
