// StudySupport.h - shared by the study tests: a clock set by hand, a study in a scratch folder, its session files.
//
// Thread-safety: only the test's thread.
#pragma once

#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <set>
#include <string>

#include "core/base/Clock.h"
#include "core/session/SessionReader.h"
#include "core/session/SessionWriter.h"
#include "core/study/Study.h"
#include "tests/support/Support.h"

namespace tacto::test {

/// Wall time that the test sets.
class HandTime final : public SystemTime {
public:
    [[nodiscard]] Instant sinceBoot() const noexcept override { return Instant(0); }
    [[nodiscard]] std::string boot() const override { return "boot"; }
    [[nodiscard]] std::chrono::sys_seconds wall() const noexcept override { return now; }
    /// Noon in UTC: the same date in most of the world.
    std::chrono::sys_seconds now = std::chrono::sys_days(std::chrono::year(2026) / 11 / 23) + std::chrono::hours(12);
};

inline constexpr const char* kPassphraseText = "correct horse 4711";

inline Passphrase somePassphrase(std::string_view text = kPassphraseText) { return Passphrase::from(text).value(); }

inline StudySettings someStudy() {
    StudySettings settings;
    settings.title = "Four conditions";
    settings.approval.reference = "EC-2026-17";
    settings.approval.from = std::chrono::year(2026) / 11 / 1;
    settings.approval.expires = std::chrono::year(2027) / 10 / 31;
    settings.consentVersion = "2";
    settings.scripts = {{"pilot-identification", std::string(64, 'a')}};
    return settings;
}

inline SessionRequest someRequest(const std::string& code) {
    SessionRequest request;
    request.code = code;
    request.script = {"pilot-identification", std::string(64, 'a')};
    request.encoding = "standard";
    request.codeConfirmed = true;
    request.devicesSimulated = true;
    request.exclusions = nothingExcludes();
    return request;
}

/// A study with one virtual participant who has consented.
class StudyDesk : public testing::Test {
protected:
    [[nodiscard]] Study::Surroundings around() const {
        return {&time, scratch.path() / "home" / "keys", PassphraseCost::least()};
    }
    [[nodiscard]] std::filesystem::path folder() const { return scratch.path() / "study"; }
    [[nodiscard]] Study make(StudySettings settings = someStudy()) const {
        auto study = Study::create(folder(), std::move(settings), somePassphrase(), around());
        EXPECT_TRUE(study) << study.error().message;
        return std::move(*study);
    }
    [[nodiscard]] Result<Study> open(Study::Access access = Study::Access::Change,
                                     std::string_view passphrase = kPassphraseText) const {
        const auto words = somePassphrase(passphrase);
        return Study::open(folder(), &words, access, around());
    }
    [[nodiscard]] Result<Study> openWithoutKey() const {
        return Study::open(folder(), nullptr, Study::Access::Read, around());
    }
    /// Enrols a participant who consents; returns the code.
    static std::string enrolled(Study& study, std::uint64_t seed = 1) {
        Participant participant;
        participant.virtualSeed = seed;
        const auto made = study.enrol(participant);
        EXPECT_TRUE(made) << made.error().message;
        const auto given = study.consent(made->code, {"2", std::chrono::year(2026) / 11 / 20, "KL"});
        EXPECT_TRUE(given) << given.error().message;
        return made->code;
    }
    /// Writes a session file as a pilot session does; returns its chain head.
    static std::string record(const BegunSession& begun, const std::function<void()>& beforeClosing = {}) {
        VirtualClock clock;
        SessionAbout about;
        about.protocol = "pilot-identification";
        about.parameters = {{"participant", begun.session.code}};
        about.seed = 4711;
        about.devices = {{"sim:", "stimulator", "Simulated stimulator", "SIM-1", "1.0", true}};
        about.mode = "person";
        about.wallStart = "2026-11-23T12:00:00Z";
        auto writer = SessionWriter::create(begun.path, about, clock, begun.seal);
        EXPECT_TRUE(writer) << writer.error().message;
        auto& session = **writer;
        const auto stream = session.addStream(SessionStream{"telemetry", "telemetry", "", {"current_ma"}, 0});
        EXPECT_TRUE(session.event(clock.now(), "plan", {{"order", {"rough-high", "smooth-low"}}}));
        for (int trial = 0; trial < 3; ++trial) {
            clock.advanceTo(toInstant(1.25 + 9.5 * trial));
            EXPECT_TRUE(
                session.event(clock.now(), "trial-begin", {{"number", trial + 1}, {"condition", "rough-high"}}));
            EXPECT_TRUE(session.command(clock.now(), "delivered", {{"amplitude_ma", 4.5}}));
            SampleBlock block;
            block.t_s = {1.0 + trial, 1.7 + trial};
            block.values = {4.5, 4.5};
            EXPECT_TRUE(session.append(*stream, block));
            EXPECT_TRUE(session.event(clock.now() + std::chrono::milliseconds(873), "answer",
                                      {{"number", trial + 1}, {"response", trial == 1 ? "none" : "rough-high"}}));
        }
        EXPECT_TRUE(session.event(clock.now(), "refused", {{"text", "6.5 mA is above the discomfort limit of 6 mA"}}));
        EXPECT_TRUE(session.event(clock.now(), "level-too-strong", {{"current_ma", 6.5}}));
        EXPECT_TRUE(session.trial(clock.now(), "rough-high", {{"n", 1}}));
        Capture capture;
        capture.rate_hz = 1e6;
        capture.channels = {{"voltage", "V", std::vector<float>(2000, 12.5F), -50, 50, 0.4, 0.01, 0.2}};
        EXPECT_TRUE(session.capture(clock.now(), capture, 1));
        EXPECT_TRUE(session.measurement(clock.now(), "impedance of rough-high", {{"ohm", 3412.5}}));
        EXPECT_TRUE(session.verdict(clock.now(), "rough-high", "none", {}, {}));
        EXPECT_TRUE(session.reportItem(clock.now(), {{"kind", "notes"}, {"note", "talked of rough-high"}}));
        EXPECT_TRUE(session.log(clock.now(), "info", "rough-high next"));
        EXPECT_TRUE(session.flush());
        if (beforeClosing) beforeClosing();
        EXPECT_TRUE(session.close());
        return session.chainHead();
    }
    /// Returns the bytes of all files in a folder, in the order of their names.
    static std::string everythingBelow(const std::filesystem::path& below) {
        std::set<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(below)) {
            if (entry.is_regular_file()) files.insert(entry.path());
        }
        std::string all;
        for (const auto& file : files) {
            std::ifstream in(file, std::ios::binary);
            all.append(std::istreambuf_iterator<char>(in), {});
        }
        return all;
    }

    HandTime time;
    ScratchDir scratch;
};

/// A study and its only participant, ready for a test.
template <typename Desk>
class WithPerson : public Desk {
protected:
    Study study = Desk::make();
    std::string code = Desk::enrolled(study);
};

}  // namespace tacto::test
