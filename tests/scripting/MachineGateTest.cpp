// Tests which stimulator may be used on a person today.
#include <cstdlib>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/run/LoadSafetyRecord.h"
#include "app/run/MachineGate.h"
#include "app/run/PilotRun.h"
#include "app/run/StudyProgram.h"
#include "app/scripting/engine/ProtocolLibrary.h"
#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceUri.h"
#include "core/session/SessionReader.h"
#include "drivers/simulated/SimulatedDriver.h"
#include "tests/scripting/DataHome.h"
#include "tests/scripting/Technician.h"
#include "tests/support/Support.h"

namespace tacto::test {
namespace {

using testing::HasSubstr;

constexpr const char* kSource = "mode=current&step=0.5mA";

/// A simulated massager that reports that it is real.
class RealLookingMassager final : public Massager {
public:
    explicit RealLookingMassager(std::unique_ptr<Massager> inner)
        : inner_(std::move(inner)), identity_(inner_->identity()) {
        identity_.simulated = false;
    }
    [[nodiscard]] const DeviceIdentity& identity() const noexcept override { return identity_; }
    [[nodiscard]] Result<void> vibrate(ApprovedBurst&& burst) override { return inner_->vibrate(std::move(burst)); }
    [[nodiscard]] double step() const noexcept override { return inner_->step(); }
    void forceOff() noexcept override { inner_->forceOff(); }

private:
    const std::unique_ptr<Massager> inner_;
    DeviceIdentity identity_;
};

/// The serial number of the stimulators in this process; tests in other processes have their own.
const std::string& serial() {
    static const OwnSerial own("LAB");
    return own.text();
}

/// Opens simulated stimulators and massagers that report that they are real.
class LabDriver final : public Driver {
public:
    [[nodiscard]] std::string_view scheme() const noexcept override { return "lab"; }
    [[nodiscard]] std::vector<DeviceIdentity> list() const override { return {}; }
    [[nodiscard]] bool runsOnVirtualClock() const noexcept override { return true; }
    [[nodiscard]] Result<void> open(const DeviceUri& uri, const std::set<Role>&, const OpenContext& context,
                                    DeviceSet& into) override {
        auto simulated = uri;
        simulated.scheme = "sim";
        if (auto opened = twin_->open(simulated, {Role::Stimulator}, context, into); !opened) return opened;
        if (uri.path == "massager") {
            into.massager = std::make_unique<RealLookingMassager>(std::move(into.massager));
            return {};
        }
        into.stimulator = std::make_unique<RealLookingStimulator>(std::move(into.stimulator), serial());
        into.load.reset();
        return {};
    }

private:
    std::unique_ptr<Driver> twin_ = makeSimulatedDriver();
};

Registry labRegistry() {
    std::vector<std::unique_ptr<Driver>> drivers;
    drivers.push_back(makeSimulatedDriver());
    drivers.push_back(std::make_unique<LabDriver>());
    return Registry(std::move(drivers));
}

/// A person who is present and does nothing.
class SilentPerson final : public PilotParticipant {
public:
    void show(const PilotScreen&) override {}
    [[nodiscard]] Result<PilotAnswer> ask(const PilotPrompt& prompt) override {
        return fail(ErrorCode::NotFound, "no answer to {}", prompt.name);
    }
    void delivered(const FeltPresentation&) override {}
    [[nodiscard]] std::vector<EarlyPress> takeEarly() override { return {}; }
    void cancel() noexcept override {}
    [[nodiscard]] bool holding() const noexcept override { return true; }
    [[nodiscard]] bool answersInRealTime() const noexcept override { return false; }
};

class MachineGate : public DataHome {
protected:
    MachineGate() {
        limits_ = shippedLimits().value();
        study_.title = "Four conditions";
        study_.approval.reference = "EC-2026-17";
        study_.approval.from = std::chrono::year(2026) / 1 / 1;
        study_.approval.expires = std::chrono::year(2099) / 12 / 31;
        study_.consentVersion = "2";
        for (std::size_t i = 0; i < limits_.sets.size(); ++i)
            study_.limits.push_back({limits_.sets[i].id, limits_.sha256[i]});
        profile_.electrodeArea = study_.electrode.area;
    }

    /// Prepares a session of the study in the folder "study".
    [[nodiscard]] auto prepared(const ProtocolSource& script, const std::map<std::string, std::string>& given,
                                const std::string& uri) {
        RunOrder order;
        order.script = script;
        order.declaration = readDeclaration(script).value();
        order.settings = applySettings(order.declaration, given).value();
        order.uris = {DeviceUri::parse(uri).value()};
        order.limits = limits_;
        PilotOrder pilot;
        pilot.study = folder_.path() / "study";
        pilot.passphrase = Passphrase::from("correct horse 4711").value();
        pilot.people = &person_;
        pilot.codeConfirmed = true;
        pilot.exclusions = nothingExcludes();
        return PilotRun::prepare(std::move(order), std::move(pilot), registry_);
    }
    [[nodiscard]] DeviceSet open(const std::string& uri) {
        auto registry = labRegistry();
        const std::vector<DeviceUri> uris{DeviceUri::parse(uri).value()};
        return registry.open(uris, {Role::Stimulator}, OpenContext{clock_, 1, "1 kohm"}).value();
    }
    /// Returns the gate's error, or an empty text if the gate agrees.
    [[nodiscard]] std::string said(const std::string& uri = std::string("lab:stimulator?") + kSource) {
        const auto devices = open(uri);
        const auto holds = machineGate(study_, profile_, limits_, devices, today_);
        if (holds) return "";
        EXPECT_EQ(holds.error().code, kGateRefused);
        return holds.error().message;
    }
    void calibrate() const {
        StoredCalibration c;
        c.serial = serial();
        c.device = "stimulator";
        c.unit = "mA";
        c.amplitude = {{1, 0, 0.5, 130}, 0.5, 0.02};
        c.interval = {{1, 0, 0.05, 5}, 0.01, 1e-6};
        c.phaseWidth = {{1, 0, 50e-6, 500e-6}, 0.2, 1e-7};
        c.gap = {{1, 0, 10e-6, 400e-6}, 0.3, 1e-7};
        c.made = today_;
        c.validUntil = std::chrono::sys_days(today_) + std::chrono::days(30);
        c.session = "run.tacto";
        c.sessionHead = std::string(64, '0');
        c.readings = 440;
        c.instruments = {{"oscilloscope", "S1", std::nullopt, 0.01, "the instrument"}};
        const auto added = CalibrationStore::open(calibrationFile()).value().add(c);
        ASSERT_TRUE(added) << added.error().message;
    }
    void keep(CheckVerdict verdict, int daysAgo = 0, bool simulated = false) const {
        LoadSafetyCheck check;
        check.serial = serial();
        check.device = "stimulator";
        check.made = std::chrono::sys_days(today_) - std::chrono::days(daysAgo);
        check.verdict = verdict;
        check.simulated = simulated;
        check.area = study_.electrode.area;
        check.reach = reachOf(profile_);
        check.reach.highest_ohm = 50'000;  // more than that of the study; a test changes the profile
        check.tolerances = {.load_pct = 5, .amplitude_pct = tolerated_pct_};
        check.limits = study_.limits;
        check.scriptSha256 = shippedLoadSafetySha256();
        check.session = "check.tacto";
        check.sessionHead = std::string(64, '1');
        const auto kept = keepCheck(check);
        ASSERT_TRUE(kept) << kept.error().message;
    }

    double tolerated_pct_ = 2;
    VirtualClock clock_;
    const CalibrationDate today_ = utcToday();
    SilentPerson person_;
    Registry registry_ = labRegistry();
    ShippedLimits limits_;
    StudySettings study_;
    Profile profile_;
};

TEST_F(MachineGate, HoldsForACalibratedCurrentSourceWhoseCheckPassed) {
    RecordProperty("hazard", "H9");
    EXPECT_THAT(said(), HasSubstr("the stimulator is not calibrated"));
    calibrate();
    EXPECT_THAT(said(), HasSubstr("stimulator " + serial() +
                                  " has no load-safety check; one that passed at most 30 days ago on "
                                  "the real bench is expected"));
    tolerated_pct_ = 2.5;
    keep(CheckVerdict::Pass);
    EXPECT_THAT(said(), HasSubstr("allows 2.5 % for an amplitude over the command; at most 2 % is expected"));
    tolerated_pct_ = 2;
    keep(CheckVerdict::Pass, 30);
    EXPECT_EQ(said(), "");
    keep(CheckVerdict::Fail);
    EXPECT_THAT(said(), HasSubstr("ended with the verdict \"fail\""));
    keep(CheckVerdict::Pass);
    EXPECT_EQ(said(), "");
}

TEST_F(MachineGate, ASimulatedCheckIsNone) {
    RecordProperty("hazard", "H9");
    calibrate();
    keep(CheckVerdict::Pass, 0, true);
    EXPECT_THAT(said(), HasSubstr("has no load-safety check but a simulated one"));
}

TEST_F(MachineGate, AnOldCheckIsNone) {
    RecordProperty("hazard", "H9");
    calibrate();
    keep(CheckVerdict::Pass, 31);
    EXPECT_THAT(said(), HasSubstr("passed 31 days ago"));
}

TEST_F(MachineGate, ATamperedStoreCountsAsNone) {
    RecordProperty("hazard", "H9");
    calibrate();
    keep(CheckVerdict::Pass);
    std::ofstream(loadSafetyFile(), std::ios::app) << "{}\n";
    EXPECT_THAT(said(), HasSubstr("no load-safety check counts, because their records are damaged: "));
}

TEST_F(MachineGate, OnlyACurrentSourceWithBiphasicTrainsIsAccepted) {
    RecordProperty("hazard", "H11");
    calibrate();
    keep(CheckVerdict::Pass);
    EXPECT_THAT(said("lab:stimulator?mode=voltage"), HasSubstr("a current source is expected"));
    profile_.encoding.train.shape = PulseShape::Monophasic;
    EXPECT_THAT(said(), HasSubstr("a biphasic one is expected"));
    profile_.encoding.train.shape = PulseShape::SymmetricBiphasic;
    profile_.electrodeArea.reset();
    EXPECT_THAT(said(), HasSubstr("the area of the electrodes is not stated"));
}

TEST_F(MachineGate, LimitsAreTheApprovals) {
    RecordProperty("hazard", "H1");
    calibrate();
    keep(CheckVerdict::Pass);
    auto& set = study_.limits.front();
    set.sha256[0] = set.sha256[0] == 'a' ? 'b' : 'a';
    EXPECT_THAT(said(), HasSubstr("changed limits need an amendment"));
    set.id = "lab-x";
    EXPECT_THAT(said(), HasSubstr("the limit set lab-x of approval EC-2026-17 is not in force in this program"));
    study_.limits.clear();
    EXPECT_THAT(said(), HasSubstr("the study names no limit sets"));
}

TEST_F(MachineGate, ASimulatedStimulatorNeedsNoCheck) { EXPECT_EQ(said(std::string("sim:stimulator?") + kSource), ""); }

TEST_F(MachineGate, AMassagerIsAskedForItsStepsAndForBeingAlone) {
    RecordProperty("hazard", "H12");
    study_.modality = Modality::Massager;
    study_.limits.clear();
    profile_.electrodeArea.reset();
    const auto saidOf = [this](std::vector<const char*> uris) {
        auto registry = labRegistry();
        std::vector<DeviceUri> parsed;
        for (const char* uri : uris) parsed.push_back(DeviceUri::parse(uri).value());
        const auto devices = registry.open(parsed, {}, OpenContext{clock_, 1, "1 kohm"}).value();
        const auto holds = machineGate(study_, profile_, limits_, devices, today_);
        return holds ? std::string() : holds.error().message;
    };
    EXPECT_EQ(saidOf({"sim:massager"}), "") << "no calibration, load safety or limits: it delivers no current";
    EXPECT_EQ(saidOf({"sim:massager?step=0.05"}), "");
    EXPECT_EQ(saidOf({"sim:massager?step=0.2"}),
              "the massager tells intensities apart that are 0.2 from each other; 0.05 is expected");
    EXPECT_EQ(saidOf({"sim:massager", "lab:stimulator?mode=current&step=0.5mA"}),
              "a stimulator is connected; a massager alone is expected");
    EXPECT_EQ(saidOf({"sim:finger"}), "no massager is connected; one is expected");
}

TEST_F(MachineGate, APersonsSessionBeginsBehindItAndNothingIsMadeBeforeIt) {
    RecordProperty("hazard", "H11");
    const auto passphrase = Passphrase::from("correct horse 4711").value();
    const auto script = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find("pilot-thresholds").value();
    study_.scripts = {{script.name, script.sha256}};
    const auto at = folder_.path() / "study";
    std::string code;
    {
        auto study = Study::create(at, study_, passphrase).value();
        code = study.enrol({}).value().code;
        ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    }
    const auto prepare = [&](const std::map<std::string, std::string>& more = {}) {
        auto given = more;
        given["participant"] = code;
        return prepared(script, given, std::string("lab:stimulator?") + kSource);
    };
    const auto sessions = [&] { return Study::open(at, nullptr, Study::Access::Read).value().sessions().size(); };
    calibrate();
    auto refused = prepare();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, kGateRefused);
    EXPECT_THAT(refused.error().message, HasSubstr("has no load-safety check"));
    EXPECT_EQ(sessions(), 0U);
    EXPECT_TRUE(std::filesystem::is_empty(at / "sessions"));
    keep(CheckVerdict::Pass);
    auto accepted = prepare();
    ASSERT_TRUE(accepted) << accepted.error().message;
    EXPECT_EQ((*accepted)->run().bench().mode(), OutputMode::Person);
    accepted->reset();
    EXPECT_EQ(sessions(), 1U);

    // The session delivered no train, so the next session may begin at once and end it.
    const auto next = prepare({{"unfinished", "end"}});
    ASSERT_TRUE(next) << next.error().message;
    const auto left = Study::open(at, nullptr, Study::Access::Read).value().sessions();
    ASSERT_EQ(left.size(), 2U);
    EXPECT_NE(left[0].state, StudySessionState::Unfinished);
}

TEST_F(MachineGate, AProfileThatWasChangedAfterTheApprovalBeginsNoSession) {
    RecordProperty("hazard", "H11");
    calibrate();
    keep(CheckVerdict::Pass);
    const auto script = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find("pilot-thresholds").value();
    Profile profile;
    study_.procedure.emplace().method = DetectionMethod::Staircase;
    ASSERT_TRUE(stateProgram(study_, profile));
    study_.scripts = {{script.name, script.sha256}};
    const auto at = folder_.path() / "study";
    std::string code;
    {
        auto study = Study::create(at, study_, Passphrase::from("correct horse 4711").value()).value();
        code = study.enrol({}).value().code;
        ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    }
    SilentPerson person;
    auto registry = labRegistry();
    const auto prepare = [&](const Profile& with, std::map<std::string, std::string> given = {}) {
        given["participant"] = code;
        RunOrder order;
        order.script = script;
        order.declaration = readDeclaration(script).value();
        order.settings = applySettings(order.declaration, given).value();
        order.uris = {DeviceUri::parse(std::string("lab:stimulator?") + kSource).value()};
        order.limits = limits_;
        order.profile = with;
        PilotOrder pilot;
        pilot.study = at;
        pilot.passphrase = Passphrase::from("correct horse 4711").value();
        pilot.people = &person;
        pilot.codeConfirmed = true;
        pilot.exclusions = nothingExcludes();
        return PilotRun::prepare(std::move(order), std::move(pilot), registry);
    };
    const auto refusal = [&](const Profile& with, std::map<std::string, std::string> given = {}) {
        const auto refused = prepare(with, std::move(given));
        if (refused) return std::string();
        EXPECT_EQ(refused.error().code, kGateRefused);
        EXPECT_TRUE(std::filesystem::is_empty(at / "sessions"));
        return refused.error().message;
    };
    auto changed = profile;
    changed.encoding.intervalMax = Seconds(3);
    EXPECT_THAT(refusal(changed), HasSubstr("longest interval is 3 s, and approval EC-2026-17 is for 2 s"));
    const auto conditions = HasSubstr("the profile's conditions, assignment, polarity, load range and ceilings hash");
    for (const auto& change : std::vector<std::function<void(Profile&)>>{
             [](Profile& one) { one.encoding.conditions[1].P = 0.5; },
             [](Profile& one) { one.encoding.assignment = Assignment::Swapped; },
             [](Profile& one) { one.encoding.train.polarity = Polarity::Negative; },
             [](Profile& one) { one.encoding.train.rate = Hertz(90); },
             [](Profile& one) { one.loadHigh = Ohms(50'000); },
             [](Profile& one) {
                 one.ceilings = {{Quantity::PeakCurrent, 20}};
             }}) {
        changed = profile;
        change(changed);
        EXPECT_THAT(refusal(changed), conditions);
    }
    EXPECT_THAT(refusal(profile, {{"method", "quest"}}), HasSubstr("quest, and approval EC-2026-17 is for staircase"));
    changed = profile;
    changed.name = "another name";
    changed.encoding.train.phaseWidth = Micros(300);  // the study's phase width is used instead
    const auto accepted = prepare(changed);
    ASSERT_TRUE(accepted) << accepted.error().message;
    const auto& begun = (*accepted)->study();
    const auto file = begun.sessions().front().parts.front().file;
    const auto about = SessionReader::open(begun.pathOf(file), begun.sealOf(file).value()).value().about();
    EXPECT_EQ(about.parameters["method"], "staircase") << "asked as approved";
}

TEST_F(MachineGate, AShapeThatIsNotBiphasicIsNotPresented) {
    RecordProperty("hazard", "H12");
    calibrate();
    keep(CheckVerdict::Pass);
    for (const char* shape : {"monophasic", "asymmetric", "Biphasic"}) {
        study_.train.shape = shape;
        fitProfile(profile_, study_);
        EXPECT_THAT(said(), HasSubstr("a biphasic one is expected")) << shape;
    }
    study_.train.shape = "biphasic";
    fitProfile(profile_, study_);
    EXPECT_EQ(said(), "");
}

TEST_F(MachineGate, APersonAtAMassagerPassesEveryGateButThoseOfCurrent) {
    RecordProperty("hazard", "H11");
    const auto script = ProtocolLibrary(sourceDir() / "resources" / "protocols", {}).find("pilot-thresholds").value();
    study_.scripts = {{script.name, script.sha256}};
    study_.modality = Modality::Massager;
    const auto at = folder_.path() / "study";
    std::string code;
    {
        auto study = Study::create(at, study_, Passphrase::from("correct horse 4711").value()).value();
        code = study.enrol({}).value().code;
    }
    const auto prepare = [&](const char* uri) { return prepared(script, {{"participant", code}}, uri); };
    const auto refusal = [&](const char* uri) {
        const auto refused = prepare(uri);
        if (refused) return std::string();
        EXPECT_EQ(refused.error().code, kGateRefused);
        EXPECT_TRUE(std::filesystem::is_empty(at / "sessions"));
        return refused.error().message;
    };
    EXPECT_THAT(refusal("lab:massager"), HasSubstr("has given no consent"));
    {
        const auto passphrase = Passphrase::from("correct horse 4711").value();
        auto study = Study::open(at, &passphrase, Study::Access::Change).value();
        ASSERT_TRUE(study.consent(code, {"2", study.today(), "KL"}));
    }
    EXPECT_THAT(refusal("sim:massager"), HasSubstr("the devices are simulated"));
    auto accepted = prepare("lab:massager");
    ASSERT_TRUE(accepted) << accepted.error().message;
    EXPECT_EQ((*accepted)->run().bench().mode(), OutputMode::Person);
    EXPECT_TRUE((*accepted)->run().bench().outputIsReal());
}

}  // namespace
}  // namespace tacto::test
